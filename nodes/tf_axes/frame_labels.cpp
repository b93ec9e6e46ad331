#include "nodes/tf_axes/frame_labels.h"

#include <algorithm>
#include <filesystem>
#include <osg/BlendFunc>
#include <osg/BufferObject>
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

/// The driver is told that names change; it says so itself otherwise.
void expectChanges(osgText::Text& text) {
  if (osg::VertexBufferObject* const vertices = text.getCoords()->getVertexBufferObject()) {
    vertices->setUsage(GL_DYNAMIC_DRAW);
  }
  for (const auto& [texture, quads] : text.getTextureGlyphQuadMap()) {
    if (quads._primitives.valid() && quads._primitives->getElementBufferObject() != nullptr) {
      quads._primitives->getElementBufferObject()->setUsage(GL_DYNAMIC_DRAW);
    }
  }
}

}  // namespace

osg::ref_ptr<osg::Node> FrameLabels::make(const std::string& name, double height_px, const scenegraph::Color& color) {
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
    // Over everything else: half a name is none.
    state_->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    state_->setRenderBinDetails(100, "DepthSortedBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
  }
  osg::ref_ptr<osgText::Text> text = new osgText::Text;
  text->setName("label");
  text->setUseDisplayList(false);
  text->setUseVertexBufferObjects(true);
  text->setUseVertexArrayObject(false);
  if (font_.valid()) {
    text->setFont(font_);
  }
  text->setCharacterSizeMode(osgText::TextBase::SCREEN_COORDS);
  text->setCharacterSize(static_cast<float>(height_px));
  text->setAxisAlignment(osgText::TextBase::SCREEN);
  text->setAlignment(osgText::TextBase::LEFT_BOTTOM);
  text->setText(name, osgText::String::ENCODING_UTF8);
  text->setColor(toOsg(color));
  expectChanges(*text);
  // Its true size depends on the camera: a bound from the text would cull it wrongly.
  text->setCullingActive(false);
  osg::ref_ptr<osg::Group> label = new osg::Group;
  label->setStateSet(state_);
  label->addChild(text);
  return label;
}

void FrameLabels::setText(osg::Node& label, const std::string& text, const scenegraph::Color& color) {
  osg::Group* const group = label.asGroup();
  auto* const shown = group == nullptr ? nullptr : dynamic_cast<osgText::Text*>(group->getChild(0));
  if (shown == nullptr) {
    return;
  }
  osgText::String wanted;
  wanted.set(text, osgText::String::ENCODING_UTF8);
  if (!std::equal(wanted.begin(), wanted.end(), shown->getText().begin(), shown->getText().end())) {
    shown->setText(wanted);
  }
  if (shown->getColor() != toOsg(color)) {
    shown->setColor(toOsg(color));
  }
}

}  // namespace stillframe::nodes
