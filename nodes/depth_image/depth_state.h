#pragma once

#include <cstdint>
#include <osg/StateSet>
#include <osg/Uniform>
#include <osg/ref_ptr>

#include "nodes/coloring_state.h"
#include "nodes/depth_image/depth_image_settings.h"
#include "nodes/points/value_range.h"

namespace stillframe::nodes {

/// What the pixels take their colour from; the numbers are the shader's.
enum class DepthColor : std::uint8_t { Flat = 0, Rgb = 1, Depth = 2 };

/// Program and uniforms of one layer of depth images: everything that settings change. GUI thread.
class DepthState {
 public:
  /// The shader's a_depth; OSG's other arrays keep clear of it.
  static constexpr unsigned kDepthAttribute = 6;

  DepthState();
  [[nodiscard]] osg::StateSet* stateSet() const noexcept { return state_.get(); }

  void apply(const DepthImageSettings& settings);
  /// t = depth * scale + bias.
  void setColor(DepthColor mode, const RangeMap& map);
  /// What depths are multiplied by before the node's matrix takes it back.
  void setUnit(float unit);

 private:
  osg::ref_ptr<osg::StateSet> state_;
  ColoringState coloring_;
  osg::ref_ptr<osg::Uniform> point_size_;
  osg::ref_ptr<osg::Uniform> max_depth_;
  osg::ref_ptr<osg::Uniform> unit_;
};

/// Greatest depth that is drawn with these settings, a float as the shader compares it.
[[nodiscard]] float depthLimit(const DepthImageSettings& settings) noexcept;

}  // namespace stillframe::nodes
