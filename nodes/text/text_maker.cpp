#include "nodes/text/text_maker.h"

#include <string>

#include "nodes/osg_math.h"

namespace stillframe::nodes {
namespace {

/// At most so many bytes, ending between two characters.
std::string_view cutUtf8(std::string_view text, std::size_t most) {
  if (text.size() <= most) {
    return text;
  }
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U) {
    --most;
  }
  return text.substr(0, most);
}

}  // namespace

osg::ref_ptr<osg::Node> TextMaker::make(std::string_view utf8, const TextStyle& style) {
  const osg::ref_ptr<osgText::Text> text = parts_.makeText(std::string(cutUtf8(utf8, kMostBytes)),
                                                           style.is_in_pixels ? TextParts::kUsualTexels : kGlyphTexels);
  text->setCharacterSizeMode(style.is_in_pixels ? osgText::TextBase::SCREEN_COORDS : osgText::TextBase::OBJECT_COORDS);
  text->setCharacterSize(static_cast<float>(style.height));
  text->setAxisAlignment(style.faces_viewer ? osgText::TextBase::SCREEN : osgText::TextBase::XY_PLANE);
  text->setAlignment(style.is_centred ? osgText::TextBase::CENTER_CENTER : osgText::TextBase::LEFT_BOTTOM);
  text->setColor(toOsg(style.color));
  return parts_.makeLabel(text);
}

}  // namespace stillframe::nodes
