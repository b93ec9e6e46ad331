#include "nodes/text/visual_order.h"

#include <fribidi.h>

#include <algorithm>
#include <string>
#include <vector>

namespace stillframe::nodes {
namespace {

constexpr unsigned kFirstFromRightToLeft = 0x0590;  // Hebrew; all that is before is from left to right

/// Appends a line without its end.
void appendLine(const std::vector<FriBidiChar>& line, osgText::String& text) {
  std::vector<FriBidiChar> visual(line.size() + 1);
  FriBidiParType direction = FRIBIDI_PAR_ON;  // that of its first letter
  auto count = static_cast<FriBidiStrIndex>(line.size());
  const bool is_ordered =
      count > 0 && fribidi_log2vis(line.data(), count, &direction, visual.data(), nullptr, nullptr, nullptr) != 0;
  if (!is_ordered) {
    text.insert(text.end(), line.begin(), line.end());
    return;
  }
  // With the places of letters that a ligature has taken.
  count = fribidi_remove_bidi_marks(visual.data(), count, nullptr, nullptr, nullptr);
  text.insert(text.end(), visual.begin(), visual.begin() + count);
}

}  // namespace

osgText::String visualOrder(std::string_view utf8) {
  const osgText::String logical(std::string(utf8), osgText::String::ENCODING_UTF8);
  if (std::ranges::all_of(logical, [](unsigned code) { return code < kFirstFromRightToLeft; })) {
    return logical;
  }
  osgText::String visual;
  std::vector<FriBidiChar> line;
  for (const unsigned code : logical) {
    if (code == '\n') {
      appendLine(line, visual);
      line.clear();
      visual.push_back(code);
    } else {
      line.push_back(code);
    }
  }
  appendLine(line, visual);
  return visual;
}

}  // namespace stillframe::nodes
