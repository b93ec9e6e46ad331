#include "nodes/text/text_parts.h"

#include <osg/BlendFunc>
#include <osg/Group>
#include <osgText/Glyph>

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/text/find_font.h"
#include "nodes/text/visual_order.h"
#include "scenegraph/geometry.h"
#include "scenegraph/own_texture.h"

namespace stillframe::nodes {

void TextParts::look() {
  if (state_ != nullptr) {
    return;
  }
  font_ = findFont();
  // Text has a state of its own for each font, which knows nothing of a scene-linear target.
  namespace shaders = shaders::stillframe_nodes;
  state_ = new osg::StateSet;
  state_->setAttributeAndModes(scenegraph::makeProgram("label", shaders::k_label_vert, shaders::k_label_frag),
                               osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
  // Its own blending would leave holes in the target's alpha, which says what is data.
  state_->setAttribute(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA),
                       osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
  state_->addUniform(new osg::Uniform("u_glyphs", 0));
  if (place_ == Place::OverAll) {
    state_->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    state_->setRenderBinDetails(100, "DepthSortedBin", osg::StateSet::OVERRIDE_RENDERBIN_DETAILS);
  }
}

void TextParts::placeAscii(osgText::Font& font, unsigned texels) {
  if (!placed_.insert({&font, texels}).second) {
    return;
  }
  const osgText::ShaderTechnique technique = osg::ref_ptr(new osgText::Text)->getShaderTechnique();
  for (unsigned code = ' '; code <= '~'; ++code) {
    if (osgText::Glyph* const glyph = font.getGlyph({texels, texels}, code)) {
      glyph->getOrCreateTextureInfo(technique);
    }
  }
}

osg::ref_ptr<osgText::Font> TextParts::fontFor(const osgText::String& characters) {
  if (isEastAsian(characters)) {
    if (!has_looked_east_) {
      east_asian_ = findEastAsianFont();
      has_looked_east_ = true;
    }
    if (east_asian_.valid()) {
      return east_asian_;
    }
  }
  return font_.valid() ? font_ : osgText::Font::getDefaultFont();
}

osg::ref_ptr<osgText::Text> TextParts::makeText(const std::string& utf8, unsigned texels) {
  look();
  const osgText::String characters = visualOrder(utf8);
  const osg::ref_ptr<osgText::Font> font = fontFor(characters);
  placeAscii(*font, kUsualTexels);
  placeAscii(*font, texels);
  osg::ref_ptr<osgText::Text> text = new osgText::Text;
  text->setFontResolution(texels, texels);
  text->setName("label");
  text->setUseDisplayList(false);
  text->setUseVertexBufferObjects(true);
  text->setUseVertexArrayObject(false);
  text->setFont(font);
  text->setText(characters);
  if (osgText::Glyph* const glyph = font->getGlyph({texels, texels}, ' ')) {
    text->setUserData(new scenegraph::OwnTexture(glyph->getOrCreateTextureInfo(text->getShaderTechnique())->texture));
  }
  // What its quads cover is not all glyph: depth of them would leave holes in what is blended behind, by the order
  // drawn.
  text->setEnableDepthWrites(false);
  // Its true size depends on the camera: a bound from the text would cull it wrongly.
  text->setCullingActive(false);
  return text;
}

osg::ref_ptr<osg::Node> TextParts::makeLabel(const osg::ref_ptr<osgText::Text>& text) {
  look();
  osg::ref_ptr<osg::Group> label = new osg::Group;
  label->setStateSet(state_);
  label->addChild(text);
  return label;
}

}  // namespace stillframe::nodes
