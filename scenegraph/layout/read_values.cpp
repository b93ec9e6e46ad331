#include "scenegraph/layout/read_values.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace stillframe::scenegraph {
namespace {

constexpr std::size_t kLongestQuote = 80;

/// The attribute that `spec` describes, or `absent` where there is none.
template <typename Value>
std::expected<Value, Status> readAs(const XmlElement& element, const SettingSpec& spec, Value absent) {
  const std::string* const text = element.attribute(spec.key);
  if (text == nullptr) {
    return absent;
  }
  const auto value = parseSetting(spec, text->substr(0, kLongestQuote));
  return value ? std::expected<Value, Status>(std::get<Value>(*value))
               : std::unexpected(badElement(element, value.error().message));
}

}  // namespace

Status badElement(const XmlElement& element, const std::string& why) {
  std::string quoted = "<" + element.name;
  for (const char* const key : {"id", "name", "key"}) {
    if (const std::string* const value = element.attribute(key)) {
      quoted += " " + std::string(key) + "=\"" + value->substr(0, kLongestQuote) + "\"";
    }
  }
  std::string line = quoted + ">: " + why;
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < 0x20; }, ' ');  // what is quoted may hold ends of lines
  return {StatusLevel::Error, "BadLayout", std::move(line)};
}

std::expected<void, Status> checkVersion(const XmlElement& element, int version) {
  const std::string* const text = element.attribute("version");
  const std::string reads = "; this program reads version " + std::to_string(version);
  if (text == nullptr) {
    return std::unexpected(
        Status{StatusLevel::Error, "WrongVersion", "<" + element.name + "> tells no version" + reads});
  }
  if (*text != std::to_string(version)) {
    return std::unexpected(
        Status{StatusLevel::Error, "WrongVersion",
               "<" + element.name + "> has version '" + text->substr(0, kLongestQuote) + "'" + reads});
  }
  return {};
}

std::expected<bool, Status> readBool(const XmlElement& element, const std::string& key, bool absent) {
  return readAs<bool>(element, {.key = key, .label = {}, .help = {}, .kind = SettingKind::Bool}, absent);
}

std::expected<int, Status> readInt(const XmlElement& element, const std::string& key, int absent, int minimum,
                                   int maximum) {
  const auto value = readAs<std::int64_t>(element,
                                          {.key = key,
                                           .label = {},
                                           .help = {},
                                           .kind = SettingKind::Int,
                                           .minimum = static_cast<double>(minimum),
                                           .maximum = static_cast<double>(maximum)},
                                          absent);
  return value ? std::expected<int, Status>(static_cast<int>(*value)) : std::unexpected(value.error());
}

std::expected<std::int64_t, Status> readInt64(const XmlElement& element, const std::string& key, std::int64_t absent) {
  return readAs<std::int64_t>(element, {.key = key, .label = {}, .help = {}, .kind = SettingKind::Int}, absent);
}

std::expected<double, Status> readDouble(const XmlElement& element, const std::string& key, double absent,
                                         double minimum, double maximum) {
  return readAs<double>(
      element,
      {.key = key, .label = {}, .help = {}, .kind = SettingKind::Double, .minimum = minimum, .maximum = maximum},
      absent);
}

std::string readText(const XmlElement& element, const std::string& key) {
  const std::string* const text = element.attribute(key);
  return text == nullptr ? std::string() : *text;
}

void keepUnknown(XmlElement& fresh, const XmlElement& source, std::span<const KnownElement> known) {
  const auto schema = std::ranges::find(known, fresh.name, &KnownElement::name);
  if (schema == known.end()) {
    return;
  }
  std::set<std::string, std::less<>> there(schema->attributes.begin(), schema->attributes.end());
  for (const auto& [key, value] : fresh.attributes) {
    there.insert(key);
  }
  for (const auto& [key, value] : source.attributes) {
    if (!there.contains(key)) {
      fresh.set(key, value);
    }
  }
  const auto nameOf = [&](const XmlElement& element) {
    const auto kind = std::ranges::find(known, element.name, &KnownElement::name);
    const bool has_key = kind != known.end() && !kind->key.empty();
    return std::pair(element.name, has_key ? readText(element, std::string(kind->key)) : std::string());
  };
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> places;  // the last first
  for (std::size_t i = fresh.children.size(); i-- > 0;) {
    places[nameOf(fresh.children[i])].push_back(i);
  }
  std::vector<std::pair<std::size_t, XmlElement>> comments;  // and which child each stands before
  std::vector<XmlElement> waiting;                           // comments, for the child that follows
  for (const XmlElement& child : source.children) {
    std::size_t place = fresh.children.size();
    if (child.isComment()) {
      waiting.push_back(child);
      continue;
    }
    if (std::ranges::find(schema->children, child.name) == schema->children.end()) {
      fresh.children.push_back(child);
    } else if (const auto same = places.find(nameOf(child)); same != places.end() && !same->second.empty()) {
      place = same->second.back();
      same->second.pop_back();
      keepUnknown(fresh.children[place], child, known);
    } else {
      continue;  // it is gone
    }
    for (XmlElement& comment : std::exchange(waiting, {})) {
      comments.emplace_back(place, std::move(comment));
    }
  }
  std::ranges::stable_sort(comments, {}, [](const auto& comment) { return comment.first; });
  std::vector<XmlElement> merged;
  auto comment = comments.begin();
  for (std::size_t i = 0; i < fresh.children.size(); ++i) {
    for (; comment != comments.end() && comment->first == i; ++comment) {
      merged.push_back(std::move(comment->second));
    }
    merged.push_back(std::move(fresh.children[i]));
  }
  std::ranges::move(waiting, std::back_inserter(merged));
  fresh.children = std::move(merged);
}

}  // namespace stillframe::scenegraph
