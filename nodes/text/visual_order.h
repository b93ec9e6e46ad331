#pragma once

#include <osgText/String>
#include <string_view>

namespace stillframe::nodes {

/// The characters of a text as a font that draws one after the other, from left to right, is to have them: what is
/// written from right to left is turned round, line by line, by Unicode's bidirectional algorithm, and letters of
/// Arabic are replaced by their joined forms. Marks above and below letters stand where the font has them, and scripts
/// that need more of a shaper (as those of India) stay as they are. Text without any of this comes back as it is. Any
/// thread.
[[nodiscard]] osgText::String visualOrder(std::string_view utf8);

}  // namespace stillframe::nodes
