#include "tools/ingest/message_definition.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <optional>
#include <utility>

#include "tools/ingest/sentence.h"

namespace stillframe::ingest {

namespace {

constexpr std::string_view kSpace = " \t\r\n\v\f";
constexpr std::size_t kShownCharacters = 80;                 // of a line in a message
constexpr std::size_t kMaxTextBytes = std::size_t{1} << 20;  // the longest definitions known have some 20 kB

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kSpace);
  return begin == std::string_view::npos ? std::string_view{}
                                         : text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

bool isIdentifier(std::string_view name) {
  return !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
         std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

std::optional<WireType> primitive(std::string_view name, DefinitionLanguage language) {
  static const std::map<std::string_view, WireType> kTypes = {
      {"bool", WireType::Bool},       {"int8", WireType::Int8},         {"uint8", WireType::Uint8},
      {"byte", WireType::Uint8},      {"char", WireType::Uint8},        {"int16", WireType::Int16},
      {"uint16", WireType::Uint16},   {"int32", WireType::Int32},       {"uint32", WireType::Uint32},
      {"int64", WireType::Int64},     {"uint64", WireType::Uint64},     {"float32", WireType::Float32},
      {"float64", WireType::Float64}, {"string", WireType::String},     {"wstring", WireType::WString},
      {"time", WireType::Time},       {"duration", WireType::Duration},
  };
  const auto found = kTypes.find(name);
  if (found == kTypes.end() || (found->second == WireType::WString && language == DefinitionLanguage::Ros1)) {
    return std::nullopt;
  }
  return found->second;
}

/// One field as written: its type is resolved when all sections are known.
struct RawField {
  FieldDefinition field;
  std::string type;
};

struct Section {
  std::string name;
  std::vector<RawField> fields;
};

/// `T`, `T[]`, `T[5]`, `T[<=5]`, `string<=10[]`, then a name, then perhaps a constant or default. Constants and empty
/// lines give nullopt.
std::expected<std::optional<RawField>, std::string> parseLine(std::string_view line) {
  const auto bad = [&](std::string_view why) {
    return std::unexpected(sentence("the line '", line.substr(0, kShownCharacters), "' ", why));
  };
  const std::size_t type_end = line.find_first_of(kSpace);
  if (type_end == std::string_view::npos) {
    return bad("has a type but no name");
  }
  std::string_view type = line.substr(0, type_end);
  const std::string_view rest = trimmed(line.substr(type_end));
  const std::size_t name_end = std::min(rest.find_first_of(" \t=#"), rest.size());
  RawField raw;
  raw.field.name = rest.substr(0, name_end);
  if (!isIdentifier(raw.field.name)) {
    return bad("has no valid field name");
  }
  if (trimmed(rest.substr(name_end)).starts_with('=')) {
    return std::optional<RawField>{};  // a constant is not on the wire
  }
  if (type.ends_with(']')) {
    const std::size_t open = type.rfind('[');
    if (open == std::string_view::npos) {
      return bad("has a ']' without a '['");
    }
    const std::string_view bound = type.substr(open + 1, type.size() - open - 2);
    type = type.substr(0, open);
    raw.field.array =
        bound.empty() || bound.starts_with("<=") ? FieldDefinition::Array::Sequence : FieldDefinition::Array::Fixed;
    const std::string_view digits = bound.starts_with("<=") ? bound.substr(2) : bound;
    if (!bound.empty()) {
      const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), raw.field.length);
      if (error != std::errc{} || end != digits.data() + digits.size()) {
        return bad("has an array length that is not a number");
      }
    }
  }
  type = type.substr(0, type.find("<="));  // a bounded string is on the wire as any other
  raw.type = type;
  for (std::string_view left = type; !left.empty();) {
    const std::size_t slash = std::min(left.find('/'), left.size());
    if (!isIdentifier(left.substr(0, slash)) || slash + 1 == left.size()) {
      return bad("has no valid type");
    }
    left = left.substr(std::min(slash + 1, left.size()));
  }
  if (type.empty()) {
    return bad("has no valid type");
  }
  return raw;
}

std::expected<std::vector<Section>, std::string> parseSections(std::string_view name, std::string_view text) {
  std::vector<Section> sections{{normalizedTypeName(name), {}}};
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty() || line.starts_with('#') || line.find_first_not_of('=') == std::string_view::npos) {
      continue;
    }
    if (line.starts_with("MSG:")) {
      sections.push_back({normalizedTypeName(trimmed(line.substr(4))), {}});
      continue;
    }
    // A '#' may be part of the value of a string constant, but there the field is dropped anyway.
    line = trimmed(line.substr(0, line.find('#')));
    auto field = parseLine(line);
    if (!field) {
      return std::unexpected(std::move(field).error());
    }
    if (*field) {
      sections.back().fields.push_back(**std::move(field));
    }
  }
  return sections;
}

/// Turns the type names of all sections into indexes and holds the nesting against its limits.
class Resolver {
 public:
  Resolver(DefinitionLanguage language, std::vector<Section> sections) : sections_(std::move(sections)) {
    definitions_.language = language;
  }

  std::expected<MessageDefinitions, std::string> resolve() {
    for (const char* builtin : {"builtin_interfaces/Time", "builtin_interfaces/Duration"}) {
      Section section{builtin, {}};  // often left out of the schema, as every reader knows them
      section.fields.push_back({{"sec", WireType::Int32}, "int32"});
      section.fields.push_back({{"nanosec", WireType::Uint32}, "uint32"});
      sections_.push_back(std::move(section));
    }
    for (std::size_t i = 0; i < sections_.size(); ++i) {
      by_name_.try_emplace(sections_[i].name, i);  // the first of two sections of a name counts
      const std::size_t slash = sections_[i].name.rfind('/');
      by_short_name_.try_emplace(sections_[i].name.substr(slash == std::string::npos ? 0 : slash + 1), i);
    }
    index_of_.assign(sections_.size(), kUnseen);
    auto root = add(0, 1);
    if (!root) {
      return std::unexpected(std::move(root).error());
    }
    return std::move(definitions_);
  }

 private:
  static constexpr std::size_t kUnseen = ~std::size_t{0};
  static constexpr std::size_t kOpen = kUnseen - 1;  // on the way down: meeting it again is recursion

  /// Index of the message of that section; adds what it holds as well. `depth` bounds only the way down here, so the
  /// depth of what was added earlier is looked up.
  std::expected<std::size_t, std::string> add(std::size_t section, std::size_t depth) {
    const Section& source = sections_[section];
    if (index_of_[section] == kOpen) {
      return std::unexpected(sentence("the type '", source.name, "' holds itself"));
    }
    if (index_of_[section] != kUnseen) {
      return depth + heights_[index_of_[section]] > MessageDefinitions::kMaxDepth ? tooDeep(source)
                                                                                  : index_of_[section];
    }
    if (depth > MessageDefinitions::kMaxDepth) {
      return tooDeep(source);
    }
    index_of_[section] = kOpen;
    const std::size_t index = definitions_.messages.size();
    definitions_.messages.push_back({source.name, {}});
    heights_.push_back(1);
    std::size_t height = 1;
    std::vector<FieldDefinition> fields;
    for (const RawField& raw : source.fields) {
      FieldDefinition field = raw.field;
      if (const auto type = primitive(raw.type, definitions_.language)) {
        field.type = *type;
      } else {
        const auto target = find(raw.type, source.name);
        if (!target) {
          return std::unexpected(sentence("the type '", raw.type, "' of the field '", field.name, "' of ", source.name,
                                          " is not defined"));
        }
        auto message = add(*target, depth + 1);
        if (!message) {
          return message;
        }
        field.type = WireType::Message;
        field.message = *message;
        height = std::max(height, heights_[*message] + 1);
      }
      fields.push_back(std::move(field));
    }
    definitions_.messages[index].fields = std::move(fields);
    heights_[index] = height;
    index_of_[section] = index;
    return index;
  }

  static std::expected<std::size_t, std::string> tooDeep(const Section& section) {
    return std::unexpected(
        sentence("the type '", section.name, "' nests more than ", MessageDefinitions::kMaxDepth, " deep"));
  }

  [[nodiscard]] std::optional<std::size_t> find(const std::string& type, const std::string& holder) const {
    const auto byName = [&](const std::string& name) -> std::optional<std::size_t> {
      const auto found = by_name_.find(name);
      return found == by_name_.end() ? std::nullopt : std::optional(found->second);
    };
    if (type.find('/') != std::string::npos) {
      return byName(normalizedTypeName(type));
    }
    const std::size_t slash = holder.find('/');
    if (const auto sibling = byName(holder.substr(0, slash == std::string::npos ? 0 : slash + 1) + type)) {
      return sibling;
    }
    if (type == "Header") {
      if (const auto header = byName("std_msgs/Header")) {
        return header;
      }
    }
    const auto found = by_short_name_.find(type);
    return found == by_short_name_.end() ? std::nullopt : std::optional(found->second);
  }

  std::vector<Section> sections_;
  std::map<std::string, std::size_t> by_name_;
  std::map<std::string, std::size_t> by_short_name_;
  std::vector<std::size_t> index_of_;  // per section: kUnseen, kOpen or the index of its message
  std::vector<std::size_t> heights_;   // per message: levels from it down
  MessageDefinitions definitions_;
};

}  // namespace

std::string normalizedTypeName(std::string_view name) {
  const std::size_t first = name.find('/');
  const std::size_t last = name.rfind('/');
  if (first == std::string_view::npos || name.substr(first, last - first) != "/msg") {
    return std::string(name);
  }
  return std::string(name.substr(0, first)).append(name.substr(last));
}

std::expected<MessageDefinitions, std::string> parseDefinitions(DefinitionLanguage language, std::string_view name,
                                                                std::string_view text) {
  if (text.size() > kMaxTextBytes) {
    return std::unexpected(sentence("it has ", text.size(), " bytes, more than the ", kMaxTextBytes, " that are read"));
  }
  auto sections = parseSections(name, text);
  if (!sections) {
    return std::unexpected(std::move(sections).error());
  }
  return Resolver(language, *std::move(sections)).resolve();
}

}  // namespace stillframe::ingest
