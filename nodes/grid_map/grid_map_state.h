#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <osg/Program>
#include <osg/StateSet>
#include <osg/Texture2D>
#include <osg/Uniform>
#include <osg/ref_ptr>

#include "nodes/coloring_state.h"
#include "nodes/grid_map/grid_map_settings.h"
#include "nodes/points/value_range.h"

namespace stillframe::nodes {

/// What the cells take their colour from; the numbers are the shader's.
enum class MapColorMode : std::uint8_t { Flat = 0, Rgb = 1, Value = 2 };

/// Program, texture and uniforms of one layer of grid maps. GUI thread.
class GridMapState {
 public:
  /// The shader's a_normal.
  static constexpr unsigned kNormalAttribute = 7;

  GridMapState();
  [[nodiscard]] osg::StateSet* stateSet() const noexcept { return state_.get(); }

  /// `is_translucent`: the cells' own alpha counts.
  void apply(const GridMapSettings& settings, bool is_surface, bool is_translucent);
  /// How many steps it lies behind lines in its plane, when flat (flat_order.h); 0 for a surface.
  void setDepthStep(float step);
  void setCells(const glm::dvec2& cell_size_m, std::uint32_t columns, std::uint32_t rows);
  /// The texture of Rgb and Value; nullptr for Flat.
  void setColor(MapColorMode mode, osg::Texture2D* texture, const RangeMap& map);

 private:
  void setBin();

  osg::ref_ptr<osg::StateSet> state_;
  osg::ref_ptr<osg::Program> surface_program_;
  osg::ref_ptr<osg::Program> flat_program_;
  osg::ref_ptr<osg::Uniform> depth_step_;
  ColoringState coloring_;
  osg::ref_ptr<osg::Uniform> cell_size_;
  osg::ref_ptr<osg::Uniform> cell_count_;
  osg::ref_ptr<osg::Uniform> missing_is_hole_;
  osg::ref_ptr<osg::Uniform> shading_;
  osg::ref_ptr<osg::Uniform> opacity_;
  bool is_blended_ = false;
};

}  // namespace stillframe::nodes
