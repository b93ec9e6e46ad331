#include "nodes/line_state.h"

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/osg_math.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {

LineState::LineState() : state_(new osg::StateSet), color_(new osg::Uniform("u_color", osg::Vec4(1, 1, 1, 1))) {
  namespace shaders = shaders::stillframe_nodes;
  state_->setAttributeAndModes(scenegraph::makeProgram("line", shaders::k_line_vert, shaders::k_line_frag));
  state_->addUniform(color_);
}

void LineState::setColor(const scenegraph::Color& color) { color_->set(osg::Vec4(color.r, color.g, color.b, 1.0F)); }

}  // namespace stillframe::nodes
