#include "nodes/depth_image/depth_state.h"

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/images/depth_map.h"
#include "nodes/points/colormap.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {
namespace {

// OSG's headers name it only for some profiles.
constexpr GLenum kProgramPointSize = 0x8642;

}  // namespace

float depthLimit(const DepthImageSettings& settings) noexcept {
  return settings.max_depth_m > 0.0 ? static_cast<float>(settings.max_depth_m) : DepthMap::kReach_m;
}

DepthState::DepthState()
    : state_(new osg::StateSet),
      mode_(new osg::Uniform("u_color_mode", 0)),
      value_(new osg::Uniform("u_value", osg::Vec2())),
      colormap_(new osg::Uniform(osg::Uniform::FLOAT_VEC3, "u_colormap", static_cast<int>(Colormap::kAnchors))),
      flat_color_(new osg::Uniform("u_flat_color", osg::Vec3())),
      point_size_(new osg::Uniform("u_point_size", 1.0F)),
      max_depth_(new osg::Uniform("u_max_depth", 1.0F)),
      unit_(new osg::Uniform("u_unit", 1.0F)) {
  namespace shaders = shaders::stillframe_nodes;
  state_->setAttributeAndModes(
      scenegraph::makeProgram("depth_image", shaders::k_depth_image_vert, shaders::k_depth_image_frag));
  state_->setMode(kProgramPointSize, osg::StateAttribute::ON);
  for (const auto& uniform : {mode_, value_, colormap_, flat_color_, point_size_, max_depth_, unit_}) {
    state_->addUniform(uniform);
  }
  apply({});
}

void DepthState::apply(const DepthImageSettings& settings) {
  const Colormap* const found = findColormap(settings.colormap);
  const Colormap& map = found != nullptr ? *found : colormaps().front();
  for (unsigned i = 0; i < Colormap::kAnchors; ++i) {
    const Rgb& color = map.anchors[i];
    colormap_->setElement(i, osg::Vec3(color[0], color[1], color[2]));
  }
  flat_color_->set(osg::Vec3(settings.flat_color.r, settings.flat_color.g, settings.flat_color.b));
  point_size_->set(static_cast<float>(settings.point_size));
  max_depth_->set(depthLimit(settings));
}

void DepthState::setColor(DepthColor mode, const RangeMap& map) {
  mode_->set(static_cast<int>(mode));
  value_->set(osg::Vec2(static_cast<float>(map.scale), static_cast<float>(map.bias)));
}

void DepthState::setUnit(float unit) { unit_->set(unit); }

}  // namespace stillframe::nodes
