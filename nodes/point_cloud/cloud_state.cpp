#include "nodes/point_cloud/cloud_state.h"

#include <osg/PointSprite>

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/points/colormap.h"
#include "scenegraph/blending.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {
namespace {

// OSG's headers name it only for some profiles.
constexpr GLenum kProgramPointSize = 0x8642;

osg::Vec3 rgb(const scenegraph::Color& color) { return {color.r, color.g, color.b}; }

}  // namespace

CloudState::CloudState()
    : state_(new osg::StateSet),
      mode_(new osg::Uniform("u_color_mode", 0)),
      axis_(new osg::Uniform("u_axis", osg::Vec4())),
      value_(new osg::Uniform("u_value", osg::Vec2())),
      colormap_(new osg::Uniform(osg::Uniform::FLOAT_VEC3, "u_colormap", static_cast<int>(Colormap::kAnchors))),
      flat_color_(new osg::Uniform("u_flat_color", osg::Vec3())),
      missing_color_(new osg::Uniform("u_missing_color", osg::Vec3())),
      opacity_(new osg::Uniform("u_opacity", 1.0F)),
      point_size_(new osg::Uniform("u_point_size", 1.0F)),
      size_in_metres_(new osg::Uniform("u_size_in_metres", false)),
      round_points_(new osg::Uniform("u_round_points", false)) {
  namespace shaders = shaders::stillframe_nodes;
  state_->setAttributeAndModes(
      scenegraph::makeProgram("point_cloud", shaders::k_point_cloud_vert, shaders::k_point_cloud_frag));
  state_->setMode(kProgramPointSize, osg::StateAttribute::ON);
  for (const auto& uniform : {mode_, axis_, value_, colormap_, flat_color_, missing_color_, opacity_, point_size_,
                              size_in_metres_, round_points_}) {
    state_->addUniform(uniform);
  }
  apply({});
}

void CloudState::apply(const PointCloudSettings& settings) {
  setColormap(settings.colormap);
  flat_color_->set(rgb(settings.flat_color));
  missing_color_->set(rgb(settings.missing_color));
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

void CloudState::setColormap(const std::string& name) {
  const Colormap* const found = findColormap(name);
  const Colormap& map = found != nullptr ? *found : colormaps().front();
  for (unsigned i = 0; i < Colormap::kAnchors; ++i) {
    const Rgb& color = map.anchors[i];
    colormap_->setElement(i, osg::Vec3(color[0], color[1], color[2]));
  }
}

void CloudState::setMode(ColorMode mode) { mode_->set(static_cast<int>(mode)); }

void CloudState::setValueMap(const RangeMap& map) {
  value_->set(osg::Vec2(static_cast<float>(map.scale), static_cast<float>(map.bias)));
}

void CloudState::setAxisMap(const osg::Vec4d& coefficients) { axis_->set(osg::Vec4(coefficients)); }

}  // namespace stillframe::nodes
