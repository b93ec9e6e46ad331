#include "nodes/text/find_font.h"

#include <algorithm>
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

bool isEastAsian(const osgText::String& text) noexcept {
  return std::ranges::any_of(text, [](unsigned code) { return isEastAsian(code); });
}

}  // namespace stillframe::nodes
