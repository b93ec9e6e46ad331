#include "nodes/grid_map/grid_map_state.h"

#include "generated/stillframe_nodes/shaders.h"
#include "scenegraph/blending.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {
GridMapState::GridMapState()
    : state_(new osg::StateSet),
      surface_program_(scenegraph::makeProgram("grid_map", shaders::stillframe_nodes::k_grid_map_vert,
                                               shaders::stillframe_nodes::k_grid_map_frag)),
      flat_program_(scenegraph::makeProgram("grid_map_flat", shaders::stillframe_nodes::k_grid_map_vert,
                                            shaders::stillframe_nodes::k_grid_map_flat_frag)),
      depth_step_(new osg::Uniform("u_depth_step", 0.0F)),
      coloring_(*state_),
      cell_size_(new osg::Uniform("u_cell_size", osg::Vec2(1, 1))),
      cell_count_(new osg::Uniform("u_cell_count", 1, 1)),
      missing_is_hole_(new osg::Uniform("u_missing_is_hole", false)),
      shading_(new osg::Uniform("u_shading", false)),
      opacity_(new osg::Uniform("u_opacity", 1.0F)) {
  state_->setAttributeAndModes(surface_program_);
  state_->addUniform(new osg::Uniform("u_cells", 0));
  for (const auto& uniform : {cell_size_, cell_count_, missing_is_hole_, shading_, opacity_}) {
    state_->addUniform(uniform);
  }
  apply({}, false, false);
}

void GridMapState::apply(const GridMapSettings& settings, bool is_surface, bool is_translucent) {
  coloring_.setColormap(settings.colormap);
  coloring_.setFlatColor(settings.flat_color);
  coloring_.setMissingColor(settings.missing_color);
  missing_is_hole_->set(!is_surface);
  shading_->set(settings.shading && is_surface);
  opacity_->set(static_cast<float>(settings.opacity));
  is_blended_ = settings.opacity < 1.0 || is_translucent;
  setBin();
}

/// Flat maps write depth, by which what is blended cannot be put in order: they go before it, after occupancy grids.
void GridMapState::setBin() {
  scenegraph::setBlended(*state_, is_blended_);
  if (is_blended_ && state_->getAttribute(osg::StateAttribute::PROGRAM) == flat_program_) {
    constexpr int kBeforeBlended = 9;
    state_->setRenderBinDetails(kBeforeBlended, "RenderBin");
  }
}

void GridMapState::setDepthStep(float step) {
  osg::Program* const program = step > 0.0F ? flat_program_ : surface_program_;
  if (state_->getAttribute(osg::StateAttribute::PROGRAM) != program) {
    state_->setAttributeAndModes(program);
    if (step > 0.0F) {
      state_->addUniform(depth_step_);
    } else {
      state_->removeUniform(depth_step_);
    }
    setBin();
  }
  depth_step_->set(step);
}

void GridMapState::setCells(const glm::dvec2& cell_size_m, std::uint32_t columns, std::uint32_t rows) {
  cell_size_->set(osg::Vec2(static_cast<float>(cell_size_m.x), static_cast<float>(cell_size_m.y)));
  cell_count_->set(static_cast<int>(columns), static_cast<int>(rows));
}

void GridMapState::setColor(MapColorMode mode, osg::Texture2D* texture, const RangeMap& map) {
  coloring_.setMode(static_cast<int>(mode), map);
  if (texture == nullptr) {
    state_->removeTextureAttribute(0, osg::StateAttribute::TEXTURE);
  } else if (state_->getTextureAttribute(0, osg::StateAttribute::TEXTURE) != texture) {
    state_->setTextureAttribute(0, texture);
  }
}

}  // namespace stillframe::nodes
