#include "nodes/grid_map/grid_map_state.h"

#include "generated/stillframe_nodes/shaders.h"
#include "nodes/points/colormap.h"
#include "scenegraph/blending.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {
namespace {

osg::Vec3 rgb(const scenegraph::Color& color) { return {color.r, color.g, color.b}; }

}  // namespace

GridMapState::GridMapState()
    : state_(new osg::StateSet),
      mode_(new osg::Uniform("u_color_mode", 0)),
      cell_size_(new osg::Uniform("u_cell_size", osg::Vec2(1, 1))),
      cell_count_(new osg::Uniform("u_cell_count", 1, 1)),
      value_(new osg::Uniform("u_value", osg::Vec2())),
      colormap_(new osg::Uniform(osg::Uniform::FLOAT_VEC3, "u_colormap", static_cast<int>(Colormap::kAnchors))),
      flat_color_(new osg::Uniform("u_flat_color", osg::Vec3())),
      missing_color_(new osg::Uniform("u_missing_color", osg::Vec3())),
      missing_is_hole_(new osg::Uniform("u_missing_is_hole", false)),
      shading_(new osg::Uniform("u_shading", false)),
      opacity_(new osg::Uniform("u_opacity", 1.0F)) {
  namespace shaders = shaders::stillframe_nodes;
  state_->setAttributeAndModes(scenegraph::makeProgram("grid_map", shaders::k_grid_map_vert, shaders::k_grid_map_frag));
  state_->addUniform(new osg::Uniform("u_cells", 0));
  for (const auto& uniform : {mode_, cell_size_, cell_count_, value_, colormap_, flat_color_, missing_color_,
                              missing_is_hole_, shading_, opacity_}) {
    state_->addUniform(uniform);
  }
  apply({}, false, false);
}

void GridMapState::apply(const GridMapSettings& settings, bool is_surface, bool is_translucent) {
  const Colormap* const found = findColormap(settings.colormap);
  const Colormap& map = found != nullptr ? *found : colormaps().front();
  for (unsigned i = 0; i < Colormap::kAnchors; ++i) {
    const Rgb& color = map.anchors[i];
    colormap_->setElement(i, osg::Vec3(color[0], color[1], color[2]));
  }
  flat_color_->set(rgb(settings.flat_color));
  missing_color_->set(rgb(settings.missing_color));
  missing_is_hole_->set(!is_surface);
  shading_->set(settings.shading && is_surface);
  opacity_->set(static_cast<float>(settings.opacity));
  scenegraph::setBlended(*state_, settings.opacity < 1.0 || is_translucent);
}

void GridMapState::setCells(const glm::dvec2& cell_size_m, std::uint32_t columns, std::uint32_t rows) {
  cell_size_->set(osg::Vec2(static_cast<float>(cell_size_m.x), static_cast<float>(cell_size_m.y)));
  cell_count_->set(static_cast<int>(columns), static_cast<int>(rows));
}

void GridMapState::setColor(MapColorMode mode, osg::Texture2D* texture, const RangeMap& map) {
  mode_->set(static_cast<int>(mode));
  value_->set(osg::Vec2(static_cast<float>(map.scale), static_cast<float>(map.bias)));
  if (texture == nullptr) {
    state_->removeTextureAttribute(0, osg::StateAttribute::TEXTURE);
  } else if (state_->getTextureAttribute(0, osg::StateAttribute::TEXTURE) != texture) {
    state_->setTextureAttribute(0, texture);
  }
}

}  // namespace stillframe::nodes
