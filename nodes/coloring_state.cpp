#include "nodes/coloring_state.h"

#include "nodes/points/colormap.h"
#include "nodes/uniform_value.h"

namespace stillframe::nodes {
namespace {

osg::Vec3 rgb(const scenegraph::Color& color) { return {color.r, color.g, color.b}; }

}  // namespace

ColoringState::ColoringState(osg::StateSet& state)
    : mode_(new osg::Uniform("u_color_mode", 0)),
      value_(new osg::Uniform("u_value", osg::Vec2())),
      colormap_(new osg::Uniform(osg::Uniform::FLOAT_VEC3, "u_colormap", static_cast<int>(Colormap::kAnchors))),
      flat_color_(new osg::Uniform("u_flat_color", osg::Vec3())),
      missing_color_(new osg::Uniform("u_missing_color", osg::Vec3())) {
  for (const auto& uniform : {mode_, value_, colormap_, flat_color_, missing_color_}) {
    state.addUniform(uniform);
  }
}

void ColoringState::setColormap(const std::string& name) {
  const Colormap* const found = findColormap(name);
  const Colormap& map = found != nullptr ? *found : colormaps().front();
  for (unsigned i = 0; i < Colormap::kAnchors; ++i) {
    const SrgbColor& color = map.anchors[i];
    colormap_->setElement(i, osg::Vec3(color[0], color[1], color[2]));
  }
}

void ColoringState::setFlatColor(const scenegraph::Color& color) { flat_color_->set(rgb(color)); }

void ColoringState::setMissingColor(const scenegraph::Color& color) { missing_color_->set(rgb(color)); }

void ColoringState::setMode(int mode, const RangeMap& map) {
  setIfNew(*mode_, mode);
  setIfNew(*value_, osg::Vec2(static_cast<float>(map.scale), static_cast<float>(map.bias)));
}

}  // namespace stillframe::nodes
