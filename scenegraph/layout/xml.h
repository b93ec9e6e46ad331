#pragma once

#include <cstddef>
#include <expected>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenegraph/status.h"

namespace stillframe::scenegraph {

/// Names of comments. Those outside of the root element are the first and the last of its children.
inline constexpr std::string_view kComment = "!--";
inline constexpr std::string_view kCommentBefore = "!--<";
inline constexpr std::string_view kCommentAfter = "!-->";

/// An element of an XML file as a plain value; a run of text when it has no name, a comment when it has one of theirs.
struct XmlElement {
  std::string name;  ///< "" for text
  std::string text = {};
  std::vector<std::pair<std::string, std::string>> attributes = {};  ///< in the order of the file
  std::vector<XmlElement> children = {};

  /// nullptr when there is no such attribute.
  [[nodiscard]] const std::string* attribute(std::string_view key) const;
  /// The first child of that name; nullptr when there is none.
  [[nodiscard]] const XmlElement* child(std::string_view child_name) const;
  [[nodiscard]] bool isComment() const { return name.starts_with(kComment); }
  void set(std::string key, std::string value) { attributes.emplace_back(std::move(key), std::move(value)); }
  friend bool operator==(const XmlElement&, const XmlElement&) = default;
};

/// What parseXml() takes at most: layouts are small, and whoever writes more means harm.
struct XmlLimits {
  std::size_t bytes = std::size_t{16} << 20;
  std::size_t depth = 64;
  std::size_t elements = 200'000;
};

/// Reads a whole XML text: UTF-8, or what its declaration says of ISO-8859-1 and UTF-16. Entities that the text
/// declares itself are refused, and space between elements is left out. Codes "MalformedLayout" (with the line) and
/// "LayoutTooLarge".
[[nodiscard]] std::expected<XmlElement, Status> parseXml(std::string_view text, const XmlLimits& limits = {});

/// UTF-8, two spaces an indent, so that parsing and writing again gives the same bytes. What XML cannot hold (control
/// characters, broken UTF-8) becomes U+FFFD.
[[nodiscard]] std::string writeXml(const XmlElement& root);

}  // namespace stillframe::scenegraph
