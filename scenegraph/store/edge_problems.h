#pragma once

#include <cstddef>
#include <vector>

#include "scenegraph/status.h"
#include "tf/transform_buffer.h"

namespace stillframe::scenegraph {

/// What counts as a fault of a dynamic edge.
struct EdgeLimits {
  double gap_intervals = 10.0;   ///< a gap is longer than so many usual intervals (the median of the edge)
  double least_gap_s = 1.0;      ///< and than this
  double jump_steps = 5.0;       ///< a jump is longer than so many large steps (of 20, one is larger)
  double least_jump_m = 0.5;     ///< and than this, or
  double least_jump_rad = 0.35;  ///< turns further than this
  std::size_t most_listed = 8;   ///< of a kind on one edge; the last says how many more there are
};

/// Gaps, jumps and stale ends of the dynamic edges, each with a time to go to: "TransformGap" at the last sample before
/// it, "TransformJump" at the sample that jumped, "StaleTransform" at the last sample of an edge that ends before
/// `end`, the last instant of the data. By edge and time. Reads every sample: for a worker thread, where there are
/// many.
[[nodiscard]] std::vector<Problem> edgeProblems(const tf::TransformBuffer& buffer, tf::TimePoint end,
                                                const EdgeLimits& limits = {});

}  // namespace stillframe::scenegraph
