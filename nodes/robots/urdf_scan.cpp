#include "nodes/robots/urdf_scan.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <ranges>
#include <utility>
#include <vector>

namespace stillframe::nodes {
namespace {

using scenegraph::failure;
using scenegraph::Status;
using scenegraph::StatusLevel;

/// Length of the well-formed UTF-8 sequence at the head of `text`; 0 for none, and for NUL.
std::size_t sequenceLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char head = byte(0);
  const std::size_t length = head < 0x80 ? 1 : head >= 0xC2 && head < 0xE0 ? 2 : head >= 0xE0 && head < 0xF0 ? 3 : 4;
  if (head == 0 || length > text.size() || (length == 4 && (head < 0xF0 || head > 0xF4))) {
    return 0;
  }
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) {
      return 0;
    }
  }
  return length;
}

std::string cleanUtf8(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  text.remove_prefix(text.starts_with(kMark) ? kMark.size() : 0);
  std::string clean;
  clean.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = sequenceLength(text);
    clean += length == 0 ? std::string_view("?") : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return clean;
}

bool isSpace(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// One tag: between '<' and '>'.
struct Tag {
  std::string_view name;
  std::string_view attributes;
  bool is_closing = false;
  bool is_empty = false;
  std::size_t name_at = 0;  ///< offset of the name in the text
};

std::optional<std::string> attribute(std::string_view attributes, std::string_view name) {
  for (std::size_t at = attributes.find(name); at != std::string_view::npos; at = attributes.find(name, at + 1)) {
    std::size_t i = at + name.size();
    const bool is_start = at == 0 || isSpace(attributes[at - 1]);
    while (i < attributes.size() && isSpace(attributes[i])) {
      ++i;
    }
    if (!is_start || i >= attributes.size() || attributes[i] != '=') {
      continue;
    }
    const std::size_t open = attributes.find_first_of("\"'", i);
    const std::size_t close = open == std::string_view::npos ? open : attributes.find(attributes[open], open + 1);
    if (close != std::string_view::npos) {
      return std::string(attributes.substr(open + 1, close - open - 1));
    }
  }
  return std::nullopt;
}

class Scanner {
 public:
  explicit Scanner(std::string text) : text_(std::move(text)) {}

  std::expected<ScannedUrdf, Status> run() {
    std::size_t at = 0;
    while ((at = text_.find('<', at)) != std::string::npos) {
      const std::string_view rest = std::string_view(text_).substr(at);
      if (const auto skipped = skipSpecial(rest)) {
        if (!*skipped) {
          return std::unexpected(skipped->error());
        }
        at += **skipped;
        continue;
      }
      const std::size_t end = tagEnd(rest);
      if (end == 0) {
        return failure("UrdfMalformed", "the XML is not well-formed: a tag is not closed");
      }
      if (auto fault = take(parseTag(rest.substr(1, end - 1), at + 1))) {
        return std::unexpected(std::move(*fault));
      }
      at += end + 1;
    }
    if (elements_ == 0) {
      return failure("NotUrdf", "the text is no XML");
    }
    if (auto fault = judgeTree()) {
      return std::unexpected(std::move(*fault));
    }
    // From the back, so that what is before stays where it is.
    for (const std::size_t capsule : std::views::reverse(capsule_names_)) {
      text_.replace(capsule, std::string_view("capsule").size(), "cylinder");
    }
    return ScannedUrdf{std::move(text_), std::move(capsules_)};
  }

 private:
  /// Bytes of a comment, CDATA, processing instruction or declaration; nullopt for a tag.
  static std::optional<std::expected<std::size_t, Status>> skipSpecial(std::string_view rest) {
    for (const auto& [open, close] : {std::pair{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}}) {
      if (rest.starts_with(open)) {
        const std::size_t end = rest.find(close);
        return end == std::string_view::npos
                   ? std::expected<std::size_t, Status>(failure(
                         "UrdfMalformed", "the XML is not well-formed: '" + std::string(open) + "' is not closed"))
                   : end + std::string_view(close).size();
      }
    }
    if (!rest.starts_with("<!")) {
      return std::nullopt;
    }
    const std::size_t end = rest.find_first_of("[>");
    const std::string_view declaration = rest.substr(0, end);
    if (end == std::string_view::npos || rest[end] == '[' || declaration.find("ENTITY") != std::string_view::npos) {
      return failure("UrdfEntities",
                     "the XML declares entities, which a robot description does not need and which can grow "
                     "without bound when they are expanded");
    }
    return end + 1;
  }

  /// Offset of the '>' that ends the tag at the head of `rest`, outside of quotes; 0 for none.
  static std::size_t tagEnd(std::string_view rest) {
    char quote = '\0';
    for (std::size_t i = 1; i < rest.size(); ++i) {
      const char c = rest[i];
      if (quote != '\0') {
        quote = c == quote ? '\0' : quote;
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '>') {
        return i;
      }
    }
    return 0;
  }

  static Tag parseTag(std::string_view inside, std::size_t at) {
    Tag tag;
    tag.is_closing = inside.starts_with('/');
    if (tag.is_closing) {
      inside.remove_prefix(1);
    }
    tag.name_at = at + (tag.is_closing ? 1 : 0);
    tag.is_empty = inside.ends_with('/');
    if (tag.is_empty) {
      inside.remove_suffix(1);
    }
    const auto end = std::ranges::find_if(inside, isSpace) - inside.begin();
    tag.name = inside.substr(0, static_cast<std::size_t>(end));
    tag.attributes = inside.substr(static_cast<std::size_t>(end));
    return tag;
  }

  std::optional<Status> take(const Tag& tag) {
    if (tag.is_closing) {
      if (open_.empty() || open_.back() != tag.name) {
        return Status{StatusLevel::Error, "UrdfMalformed",
                      "the XML is not well-formed: </" + std::string(tag.name.substr(0, 100)) + "> closes <" +
                          (open_.empty() ? "" : open_.back().substr(0, 100)) + ">"};
      }
      if (tag.name == "capsule" && isGeometry()) {
        capsule_names_.push_back(tag.name_at);
      }
      open_.pop_back();
      return std::nullopt;
    }
    if (++elements_ > kMaxUrdfElements || open_.size() >= kMaxUrdfDepth) {
      return Status{StatusLevel::Error, "UrdfTooLarge",
                    "the XML nests deeper than " + std::to_string(kMaxUrdfDepth) + " elements, or has more than " +
                        std::to_string(kMaxUrdfElements)};
    }
    if (auto fault = judgeElement(tag)) {
      return fault;
    }
    open_.emplace_back(tag.name);
    note(tag);
    if (tag.is_empty) {
      open_.pop_back();
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Status> judgeElement(const Tag& tag) const {
    const auto error = [](const char* code, std::string message) {
      return Status{StatusLevel::Error, code, std::move(message)};
    };
    if (open_.empty() && elements_ == 1) {
      if (tag.name == "sdf") {
        return error("SdfUnsupported", "the description is SDF; robots are drawn from URDF");
      }
      if (tag.name == "mujoco") {
        return error("MjcfUnsupported", "the description is MJCF (MuJoCo); robots are drawn from URDF");
      }
      if (tag.name != "robot") {
        return error("NotUrdf",
                     "the root element is <" + std::string(tag.name.substr(0, 100)) + ">, that of a URDF is <robot>");
      }
    }
    const bool is_expression =
        tag.attributes.find("${") != std::string_view::npos || tag.attributes.find("$(") != std::string_view::npos;
    if (tag.name.starts_with("xacro:") || is_expression) {
      return error("XacroUnexpanded", "the description still holds xacro (<" + std::string(tag.name.substr(0, 100)) +
                                          (is_expression ? " ... ${}" : "") +
                                          ">): run it through 'xacro FILE > FILE.urdf' first");
    }
    return std::nullopt;
  }

  /// Whether the innermost open element is a child of a link's geometry.
  [[nodiscard]] bool isGeometry() const {
    return open_.size() == 5 && open_[1] == "link" && (open_[2] == "visual" || open_[2] == "collision") &&
           open_[3] == "geometry";
  }

  void note(const Tag& tag) {
    if (open_.size() == 2 && tag.name == "link") {
      link_ = attribute(tag.attributes, "name").value_or("");
      links_.push_back(link_);
      visuals_ = collisions_ = 0;
    } else if (open_.size() == 2 && tag.name == "joint") {
      joints_.push_back({attribute(tag.attributes, "name").value_or(""), {}, {}});
    } else if (open_.size() == 3 && open_[1] == "joint" && (tag.name == "parent" || tag.name == "child")) {
      (tag.name == "parent" ? joints_.back().parent : joints_.back().child) =
          attribute(tag.attributes, "link").value_or("");
    } else if (open_.size() == 3 && open_[1] == "link") {
      visuals_ += tag.name == "visual" ? 1 : 0;
      collisions_ += tag.name == "collision" ? 1 : 0;
    } else if (tag.name == "capsule" && isGeometry()) {
      const bool is_visual = open_[2] == "visual";
      capsules_.emplace(link_, is_visual, (is_visual ? visuals_ : collisions_) - 1);
      capsule_names_.push_back(tag.name_at);
    }
  }

  [[nodiscard]] std::optional<Status> judgeTree() const {
    const auto error = [](const char* code, std::string message) {
      return Status{StatusLevel::Error, code, std::move(message)};
    };
    if (links_.size() > kMaxRobotLinks) {
      return error("UrdfTooLarge", "the robot has " + std::to_string(links_.size()) + " links, at most " +
                                       std::to_string(kMaxRobotLinks) + " are drawn");
    }
    if (links_.empty()) {
      return error("UrdfNoRoot", "the robot has no links");
    }
    const std::set<std::string> known_links(links_.begin(), links_.end());
    if (known_links.contains("")) {
      return error("UrdfMalformed", "a link has no name");
    }
    std::vector<std::string> sorted = links_;
    std::ranges::sort(sorted);
    if (const auto twin = std::ranges::adjacent_find(sorted); twin != sorted.end()) {
      return error("UrdfTwoLinks", "two links have the name '" + *twin + "'");
    }
    std::map<std::string, const Joint*> joint_of_child;
    for (const Joint& joint : joints_) {
      for (const std::string& link : {joint.parent, joint.child}) {
        if (!known_links.contains(link)) {
          return error("UrdfUnknownLink",
                       "joint '" + joint.name + "' names the link '" + link + "', which there is not");
        }
      }
      const auto [known, is_new] = joint_of_child.try_emplace(joint.child, &joint);
      if (!is_new) {
        return error("UrdfTwoParents", "link '" + joint.child + "' has two parents: joint '" + known->second->name +
                                           "' puts it on '" + known->second->parent + "', joint '" + joint.name +
                                           "' on '" + joint.parent + "'");
      }
    }
    std::string root;
    for (const std::string& link : links_) {
      if (joint_of_child.contains(link)) {
        continue;
      }
      if (!root.empty()) {
        return error("UrdfTwoRoots", "the links are no tree: neither '" + root + "' nor '" + link + "' has a parent");
      }
      root = link;
    }
    return judgeLoops(joint_of_child, root);
  }

  struct Joint {
    std::string name;
    std::string parent;
    std::string child;
  };

  /// Every chain of parents must end at the root; without one ("") there is a loop.
  static std::optional<Status> judgeLoops(const std::map<std::string, const Joint*>& joint_of_child,
                                          const std::string& root) {
    std::set<std::string> good;
    if (!root.empty()) {
      good.insert(root);
    }
    for (const auto& [child, joint] : joint_of_child) {
      std::vector<std::string> chain;
      std::set<std::string> seen;
      std::string at = child;
      while (!good.contains(at)) {
        if (!seen.insert(at).second) {
          return Status{StatusLevel::Error, "UrdfLoop",
                        "the links are no tree: '" + at + "' is its own ancestor, by joint '" +
                            joint_of_child.at(at)->name + "'"};
        }
        chain.push_back(at);
        at = joint_of_child.at(at)->parent;
      }
      good.insert(chain.begin(), chain.end());
    }
    return std::nullopt;
  }

  std::string text_;
  std::vector<std::string> open_;
  std::size_t elements_ = 0;
  std::vector<std::string> links_;
  std::vector<Joint> joints_;
  std::string link_;  // the last one that began
  std::size_t visuals_ = 0;
  std::size_t collisions_ = 0;
  std::set<std::tuple<std::string, bool, std::size_t>> capsules_;
  std::vector<std::size_t> capsule_names_;  // offsets, ascending
};

}  // namespace

std::expected<ScannedUrdf, Status> scanUrdf(std::string_view text) {
  if (text.size() > kMaxUrdfBytes) {
    return failure("UrdfTooLarge", "the description has " + std::to_string(text.size()) + " bytes, at most " +
                                       std::to_string(kMaxUrdfBytes) + " are read");
  }
  return Scanner(cleanUtf8(text)).run();
}

}  // namespace stillframe::nodes
