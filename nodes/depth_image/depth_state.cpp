#include "nodes/depth_image/depth_state.h"

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/images/depth_map.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {
float depthLimit(const DepthImageSettings& settings) noexcept {
  return settings.max_depth_m > 0.0 ? static_cast<float>(settings.max_depth_m) : DepthMap::kReach_m;
}

DepthState::DepthState()
    : state_(new osg::StateSet),
      coloring_(*state_),
      point_size_(new osg::Uniform("u_point_size", 1.0F)),
      max_depth_(new osg::Uniform("u_max_depth", 1.0F)),
      unit_(new osg::Uniform("u_unit", 1.0F)) {
  namespace shaders = shaders::stillframe_nodes;
  state_->setAttributeAndModes(
      scenegraph::makeProgram("depth_image", shaders::k_depth_image_vert, shaders::k_depth_image_frag));
  state_->setMode(kProgramPointSize, osg::StateAttribute::ON);
  for (const auto& uniform : {point_size_, max_depth_, unit_}) {
    state_->addUniform(uniform);
  }
  apply({});
}

void DepthState::apply(const DepthImageSettings& settings) {
  coloring_.setColormap(settings.colormap);
  coloring_.setFlatColor(settings.flat_color);
  point_size_->set(static_cast<float>(settings.point_size));
  max_depth_->set(depthLimit(settings));
}

void DepthState::setColor(DepthColor mode, const RangeMap& map) { coloring_.setMode(static_cast<int>(mode), map); }

void DepthState::setUnit(float unit) { unit_->set(unit); }

}  // namespace stillframe::nodes
