#include "nodes/text/text_maker.h"

#include <filesystem>
#include <osg/BlendFunc>
#include <osg/Group>
#include <osgText/Text>

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/osg_math.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {
namespace {

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
  if (!has_looked_) {
    font_ = findFont();
    has_looked_ = true;
    // Text has a state of its own for each font, which knows nothing of a scene-linear target.
    namespace shaders = shaders::stillframe_nodes;
    state_ = new osg::StateSet;
    state_->setAttributeAndModes(scenegraph::makeProgram("label", shaders::k_label_vert, shaders::k_label_frag),
                                 osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
    // Its own blending would leave holes in the target's alpha, which says what is data.
    state_->setAttribute(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA),
                         osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
    state_->addUniform(new osg::Uniform("u_glyphs", 0));
  }
  osg::ref_ptr<osgText::Text> text = new osgText::Text;
  text->setName("label");
  text->setUseDisplayList(false);
  text->setUseVertexBufferObjects(true);
  text->setUseVertexArrayObject(false);
  if (font_.valid()) {
    text->setFont(font_);
  }
  if (!style.is_in_pixels) {
    text->setFontResolution(kGlyphTexels, kGlyphTexels);
  }
  text->setCharacterSizeMode(style.is_in_pixels ? osgText::TextBase::SCREEN_COORDS : osgText::TextBase::OBJECT_COORDS);
  text->setCharacterSize(static_cast<float>(style.height));
  text->setAxisAlignment(style.faces_viewer ? osgText::TextBase::SCREEN : osgText::TextBase::XY_PLANE);
  text->setAlignment(style.is_centred ? osgText::TextBase::CENTER_CENTER : osgText::TextBase::LEFT_BOTTOM);
  text->setText(std::string(cutUtf8(utf8, kMostBytes)), osgText::String::ENCODING_UTF8);
  text->setColor(toOsg(style.color));
  // Its true size depends on the camera: a bound from the text would cull it wrongly.
  text->setCullingActive(false);
  osg::ref_ptr<osg::Group> label = new osg::Group;
  label->setStateSet(state_);
  label->addChild(text);
  return label;
}

}  // namespace stillframe::nodes
