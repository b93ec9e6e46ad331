#pragma once

#include <glm/vec4.hpp>
#include <osg/StateSet>
#include <osg/Uniform>
#include <osg/ref_ptr>

#include "nodes/coloring_state.h"
#include "nodes/point_cloud/cloud_coloring.h"
#include "nodes/point_cloud/point_cloud_settings.h"
#include "nodes/points/value_range.h"

namespace stillframe::nodes {

/// Program and uniforms of one cloud layer: everything that settings change. GUI thread.
class CloudState {
 public:
  /// The shader's a_value; OSG's other arrays keep clear of it.
  static constexpr unsigned kValueAttribute = 6;

  CloudState();
  [[nodiscard]] osg::StateSet* stateSet() const noexcept { return state_.get(); }

  void apply(const PointCloudSettings& settings);
  /// t = value * scale + bias of the array's values.
  void setMode(ColorMode mode, const RangeMap& map);
  /// t = dot(coefficients.xyz, vertex) + coefficients.w.
  void setAxisMap(const glm::dvec4& coefficients);

 private:
  osg::ref_ptr<osg::StateSet> state_;
  ColoringState coloring_;
  osg::ref_ptr<osg::Uniform> axis_;
  osg::ref_ptr<osg::Uniform> opacity_;
  osg::ref_ptr<osg::Uniform> point_size_;
  osg::ref_ptr<osg::Uniform> size_in_metres_;
  osg::ref_ptr<osg::Uniform> round_points_;
};

}  // namespace stillframe::nodes
