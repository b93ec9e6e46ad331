#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/pick/picked.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// What was picked, whose it is, and where.
struct PickResult {
  std::string topic;  ///< of the layer, or its type's name
  std::string layer;  ///< its type, for people
  std::string frame;  ///< source frame
  Picked picked;      ///< its position is in `frame`
  std::string fixed_frame;
  glm::dvec3 point_in_fixed{0.0};
  tf::TimePoint time;  ///< that the scene showed

  friend bool operator==(const PickResult&, const PickResult&) = default;
};

/// What is picked and measured in a view: names and numbers alone, so that the data may go, and a layout can keep it.
struct PickMarks {
  using Pair = std::pair<PickResult, PickResult>;

  std::optional<PickResult> selected;
  std::vector<Pair> measured;  ///< from the first to the second

  [[nodiscard]] bool isEmpty() const noexcept { return !selected && measured.empty(); }
  friend bool operator==(const PickMarks&, const PickMarks&) = default;
};

}  // namespace stillframe::scenegraph
