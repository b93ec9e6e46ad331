#include "nodes/text/find_font.h"

#include <filesystem>
#include <system_error>

namespace stillframe::nodes {

osg::ref_ptr<osgText::Font> findFont() {
  for (const char* path : {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                           "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
                           "/usr/share/fonts/truetype/liberation2/LiberationSans-Regular.ttf"}) {
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored)) {
      if (osg::ref_ptr<osgText::Font> font = osgText::readRefFontFile(path)) {
        return font;
      }
    }
  }
  return nullptr;
}

}  // namespace stillframe::nodes
