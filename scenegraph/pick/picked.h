#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// A value of what was picked; a float stays one, so that its text is that of the number in the message.
using PickValue = std::variant<bool, std::int64_t, std::uint64_t, float, double, std::string>;

/// Without a loss: shortest digits that read back to the same number.
[[nodiscard]] std::string pickText(const PickValue& value);

/// What lies at a pixel, as its layer knows it (Layer::describe).
struct Picked {
  std::string kind;  ///< "point", "voxel", "cell", "marker", "link", "pose", "pixel", "triangle", "frame"
  std::string id;    ///< which one, within its topic: a number, a name
  /// By the data where a number leads to it, else where the ray meets the surface; in PickHit::frame.
  glm::dvec3 point_in_frame{0.0};
  std::optional<tf::TimePoint> stamp;  ///< of the data's header
  std::vector<std::pair<std::string, PickValue>> fields;
  double radius_m = 1.0;  ///< of a ball round it that is worth a look

  template <typename Value>
  void add(std::string name, Value value) {
    if constexpr (std::is_integral_v<Value> && !std::is_same_v<Value, bool>) {
      if constexpr (std::is_signed_v<Value>) {
        fields.emplace_back(std::move(name), static_cast<std::int64_t>(value));
      } else {
        fields.emplace_back(std::move(name), static_cast<std::uint64_t>(value));
      }
    } else {
      fields.emplace_back(std::move(name), std::move(value));
    }
  }
  /// Its translation as "NAME_x", ... and its rotation as "NAME_qx", ... "NAME_qw"; without a name "x", ... "qw".
  void addPose(const std::string& name, const tf::RigidTransform& pose);

  friend bool operator==(const Picked&, const Picked&) = default;
};

}  // namespace stillframe::scenegraph
