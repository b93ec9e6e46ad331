#include "nodes/tf_axes/frame_labels.h"

#include <algorithm>
#include <osg/BufferObject>
#include <osg/Group>
#include <osgText/Text>

#include "nodes/osg_math.h"
#include "nodes/text/visual_order.h"

namespace stillframe::nodes {
namespace {

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
  const osg::ref_ptr<osgText::Text> text = parts_.makeText(name);
  text->setCharacterSizeMode(osgText::TextBase::SCREEN_COORDS);
  text->setCharacterSize(static_cast<float>(height_px));
  text->setAxisAlignment(osgText::TextBase::SCREEN);
  text->setAlignment(osgText::TextBase::LEFT_BOTTOM);
  text->setColor(toOsg(color));
  expectChanges(*text);
  return parts_.makeLabel(text);
}

void FrameLabels::setHeight(osg::Node& label, double height_px) {
  osg::Group* const group = label.asGroup();
  auto* const shown = group == nullptr ? nullptr : dynamic_cast<osgText::Text*>(group->getChild(0));
  const auto height = static_cast<float>(height_px);
  if (shown != nullptr && shown->getCharacterHeight() != height) {
    shown->setCharacterSize(height);
  }
}

void FrameLabels::setText(osg::Node& label, const std::string& text, const scenegraph::Color& color) {
  osg::Group* const group = label.asGroup();
  auto* const shown = group == nullptr ? nullptr : dynamic_cast<osgText::Text*>(group->getChild(0));
  if (shown == nullptr) {
    return;
  }
  const osgText::String wanted = visualOrder(text);
  if (!std::equal(wanted.begin(), wanted.end(), shown->getText().begin(), shown->getText().end())) {
    shown->setText(wanted);
  }
  if (shown->getColor() != toOsg(color)) {
    shown->setColor(toOsg(color));
  }
}

}  // namespace stillframe::nodes
