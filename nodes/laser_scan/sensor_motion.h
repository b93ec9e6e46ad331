#pragma once

#include <cstddef>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/objects/point_cloud.h"
#include "scenegraph/status.h"
#include "tf/transform_buffer.h"

namespace stillframe::nodes {

/// How a sensor moved through an inertial frame over a short span, by the samples of the edges between the two.
///
/// Lookups hold a sample until the next; over the tenth of a second of a scan that moves a wall in steps of
/// angular rate / TF rate * range (10 cm at 1 rad/s, 50 Hz and 5 m). Here each edge is interpolated between its
/// samples, rotation at constant rate and translation on a straight line: it models how the sensor moved, and places
/// nothing in the view, which stays with the tree's own answer. Before an edge's first sample there is no answer, past
/// its last that one holds.
class SensorMotion {
 public:
  /// Motion of `sensor` in `inertial`, one of its ancestors, from `begin` to `end`; costs a lookup for each sample in
  /// the span, of each edge kMaxKnots at most. Fails with the code of a placement or "NotAnAncestor".
  [[nodiscard]] static std::expected<SensorMotion, scenegraph::Status> sample(const tf::TransformBuffer& buffer,
                                                                              std::string_view inertial,
                                                                              std::string_view sensor,
                                                                              tf::TimePoint begin, tf::TimePoint end);
  static constexpr std::size_t kMaxKnots = 1024;

  /// inertial_from_sensor; meaningful within the span.
  [[nodiscard]] tf::RigidTransform at(tf::TimePoint time) const;
  /// Whether the sensor did not move at all.
  [[nodiscard]] bool isStill() const;

  friend bool operator==(const SensorMotion& a, const SensorMotion& b);

 private:
  struct Knot {
    tf::TimePoint stamp;
    tf::RigidTransform parent_from_child;
  };
  using Edge = std::vector<Knot>;  // at least one, by stamp
  [[nodiscard]] static tf::RigidTransform interpolate(const Edge& edge, tf::TimePoint time);

  std::vector<Edge> edges_;  // from the sensor upwards
};

/// "odom" where that is an ancestor of `sensor`, because it moves smoothly, else the root above it; `sensor` itself
/// when the buffer does not know it.
[[nodiscard]] std::string inertialFrame(const tf::TransformBuffer& buffer, std::string_view sensor);

/// The cloud of convertScan() with each point moved to where the sensor of `first_beam` sees it: point p of time t
/// becomes inverse(motion(first_beam)) * motion(first_beam + t) * p. All else stays. Any thread.
[[nodiscard]] scenegraph::PointCloud deskew(const scenegraph::PointCloud& cloud, const SensorMotion& motion,
                                            tf::TimePoint first_beam);

}  // namespace stillframe::nodes
