#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "nodes/lines/line_arrays.h"
#include "nodes/points/value_range.h"
#include "scenegraph/objects/poses.h"

namespace stillframe::nodes {

/// What a line through poses is coloured by.
enum class PoseValue : std::uint8_t { None, Time, Order, X, Y, Z };

/// By the name that settings use; "flat" is None.
[[nodiscard]] PoseValue poseValueOf(std::string_view name);

/// Poses in the form that is drawn: judged now, lines and fills made when first asked for.
///
/// Made on a worker, cached, shared by all views. line() and fill() convert on first use and remember; any thread may
/// call them.
class PoseSet {
 public:
  /// Poses that are not as they should be.
  struct Faults {
    std::size_t not_finite = 0;      ///< a NaN or infinite coordinate: not drawn
    std::size_t out_of_reach = 0;    ///< beyond LineBuilder::kReach: not drawn
    std::size_t bad_rotations = 0;   ///< a NaN or infinite rotation: on the line, without a shape
    std::size_t zero_rotations = 0;  ///< 0 0 0 0: drawn unturned, as RViz does
    std::size_t unnormalised = 0;    ///< a norm that is not 1 within a hundredth: drawn normalised
  };
  /// A line through the poses in order, broken where one cannot be drawn; round a polygon.
  struct Line {
    LineArrays arrays;  ///< with values unless they are by None
    ValueRange limits;  ///< of the values
    double offset = 0.0;
  };

  explicit PoseSet(std::shared_ptr<const scenegraph::PosesInFrame> source);
  PoseSet(PoseSet&&) noexcept;
  PoseSet& operator=(PoseSet&&) noexcept;
  ~PoseSet();

  [[nodiscard]] const scenegraph::PosesInFrame& source() const noexcept { return *source_; }
  [[nodiscard]] const Faults& faults() const noexcept { return faults_; }
  /// What lines and shapes are made relative to: zero, or the box centre when that is far away.
  [[nodiscard]] const glm::dvec3& origin() const noexcept { return origin_; }
  /// Whether the poses have times of their own, not all the same.
  [[nodiscard]] bool hasTimes() const noexcept { return has_times_; }

  /// nullopt when it cannot be drawn.
  [[nodiscard]] std::optional<glm::dvec3> point(std::size_t index) const;
  /// With a unit rotation; nullopt when it cannot be drawn.
  [[nodiscard]] std::optional<tf::RigidTransform> pose(std::size_t index) const;
  [[nodiscard]] const Line& line(PoseValue by) const;
  /// Triangles over the source's poses; nullptr when they are too many or one of them cannot be drawn.
  [[nodiscard]] const std::vector<std::uint32_t>* fill() const;

  /// Frees what is on the GPU, in every context. GUI thread.
  void releaseGlObjects() const;
  /// Source, and one line with values.
  [[nodiscard]] std::size_t byteSize() const noexcept;

 private:
  struct Lazy;
  [[nodiscard]] double value(PoseValue by, std::size_t index) const;

  std::shared_ptr<const scenegraph::PosesInFrame> source_;
  Faults faults_;
  glm::dvec3 origin_{0.0};
  bool has_times_ = false;
  std::unique_ptr<Lazy> lazy_;
};

}  // namespace stillframe::nodes
