#include "nodes/text/find_font.h"

#include <filesystem>
#include <initializer_list>
#include <system_error>

namespace stillframe::nodes {
namespace {

osg::ref_ptr<osgText::Font> firstOf(std::initializer_list<const char*> paths) {
  for (const char* path : paths) {
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored)) {
      if (osg::ref_ptr<osgText::Font> font = osgText::readRefFontFile(path)) {
        return font;
      }
    }
  }
  return nullptr;
}

}  // namespace

osg::ref_ptr<osgText::Font> findFont() {
  return firstOf({"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                  "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
                  "/usr/share/fonts/truetype/liberation2/LiberationSans-Regular.ttf"});
}

osg::ref_ptr<osgText::Font> findEastAsianFont() {
  return firstOf(
      {"/usr/share/fonts/truetype/wqy/wqy-microhei.ttc", "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc"});
}

bool isEastAsian(unsigned code) noexcept {
  return (code >= 0x2E80 && code <= 0x9FFF) || (code >= 0xAC00 && code <= 0xD7FF) ||
         (code >= 0xF900 && code <= 0xFAFF) || (code >= 0xFF00 && code <= 0xFFFF) || code >= 0x20000;
}

bool isEastAsian(std::string_view utf8) noexcept {
  // By the first bytes of what UTF-8 makes of U+2E80 to U+9FFF, U+AC00 to U+D7FF, U+F900 to U+FAFF, U+FF00 to U+FFFF
  // and the planes of ideographs from U+20000 on.
  for (std::size_t i = 0; i + 1 < utf8.size(); ++i) {
    const auto first = static_cast<unsigned char>(utf8[i]);
    const auto second = static_cast<unsigned char>(utf8[i + 1]);
    const bool is_here = (first == 0xE2 && second >= 0xBA) || (first >= 0xE3 && first <= 0xE9) ||
                         (first == 0xEA && second >= 0xB0) || (first >= 0xEB && first <= 0xED) ||
                         (first == 0xEF && ((second >= 0xA4 && second <= 0xAB) || second >= 0xBC)) ||
                         (first == 0xF0 && second >= 0xA0);
    if (is_here) {
      return true;
    }
  }
  return false;
}

}  // namespace stillframe::nodes
