#include "scenegraph/pick/picked.h"

#include <array>
#include <charconv>

namespace stillframe::scenegraph {

std::string pickText(const PickValue& value) {
  return std::visit(
      [](const auto& held) -> std::string {
        using Held = std::decay_t<decltype(held)>;
        if constexpr (std::is_same_v<Held, std::string>) {
          return held;
        } else if constexpr (std::is_same_v<Held, bool>) {
          return held ? "true" : "false";
        } else {
          std::array<char, 32> digits{};
          const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), held).ptr;
          return {digits.data(), end};
        }
      },
      value);
}

void Picked::addPose(const std::string& name, const tf::RigidTransform& pose) {
  const std::string prefix = name.empty() ? "" : name + "_";
  const char* const axes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    add(prefix + axes[axis], pose.translation[axis]);
  }
  add(prefix + "qx", pose.rotation.x);
  add(prefix + "qy", pose.rotation.y);
  add(prefix + "qz", pose.rotation.z);
  add(prefix + "qw", pose.rotation.w);
}

}  // namespace stillframe::scenegraph
