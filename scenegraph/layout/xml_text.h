#pragma once

#include <string>
#include <string_view>

namespace stillframe::scenegraph {

/// Appends text as it stands between tags. What XML cannot hold (control characters, broken UTF-8) becomes U+FFFD.
void appendXmlText(std::string_view text, std::string& out);
/// The same between double quotes, where space must be told as it is.
void appendXmlAttribute(std::string_view text, std::string& out);
/// The same between the marks of a comment, in which nothing is escaped and no two hyphens may stand together.
void appendXmlComment(std::string_view text, std::string& out);

}  // namespace stillframe::scenegraph
