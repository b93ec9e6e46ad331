#include "nodes/point_cloud/cloud_state.h"

#include <osg/PointSprite>

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/uniform_value.h"
#include "scenegraph/blending.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {
CloudState::CloudState()
    : state_(new osg::StateSet),
      coloring_(*state_),
      axis_(new osg::Uniform("u_axis", osg::Vec4())),
      opacity_(new osg::Uniform("u_opacity", 1.0F)),
      point_size_(new osg::Uniform("u_point_size", 1.0F)),
      size_in_metres_(new osg::Uniform("u_size_in_metres", false)),
      round_points_(new osg::Uniform("u_round_points", false)) {
  namespace shaders = shaders::stillframe_nodes;
  state_->setAttributeAndModes(
      scenegraph::makeProgram("point_cloud", shaders::k_point_cloud_vert, shaders::k_point_cloud_frag));
  state_->setMode(kProgramPointSize, osg::StateAttribute::ON);
  for (const auto& uniform : {axis_, opacity_, point_size_, size_in_metres_, round_points_}) {
    state_->addUniform(uniform);
  }
  apply({});
}

void CloudState::apply(const PointCloudSettings& settings) {
  coloring_.setColormap(settings.colormap);
  coloring_.setFlatColor(settings.flat_color);
  coloring_.setMissingColor(settings.missing_color);
  opacity_->set(static_cast<float>(settings.opacity));
  point_size_->set(static_cast<float>(settings.point_size));
  size_in_metres_->set(settings.size_unit == "m");
  round_points_->set(settings.round_points);
  if (settings.round_points) {
    // gl_PointCoord of the compatibility profile is only there with point sprites on.
    state_->setTextureAttributeAndModes(0, new osg::PointSprite, osg::StateAttribute::ON);
  } else {
    state_->removeTextureAttribute(0, osg::StateAttribute::POINTSPRITE);
    state_->removeMode(GL_POINT_SPRITE_ARB);  // OSG leaves it behind
  }
  scenegraph::setBlended(*state_, settings.opacity < 1.0);
}

void CloudState::setMode(ColorMode mode, const RangeMap& map) { coloring_.setMode(static_cast<int>(mode), map); }

void CloudState::setAxisMap(const glm::dvec4& coefficients) {
  setIfNew(*axis_, osg::Vec4(osg::Vec4d(coefficients.x, coefficients.y, coefficients.z, coefficients.w)));
}

}  // namespace stillframe::nodes
