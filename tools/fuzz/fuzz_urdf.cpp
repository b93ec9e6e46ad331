// A robot description from the fuzzer: reading must end, print nothing, and give a tree whose indices are within it.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "nodes/robots/joint_poses.h"
#include "nodes/robots/urdf_reader.h"

namespace {

using namespace stillframe;

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto robot = nodes::readUrdf({reinterpret_cast<const char*>(data), size});
  if (!robot) {
    require(!robot.error().code.empty() && !robot.error().message.empty());
    return 0;
  }
  require(!robot->links.empty() && robot->links.front().parent_joint == -1);
  for (std::size_t i = 1; i < robot->links.size(); ++i) {
    const auto joint = static_cast<std::size_t>(robot->links[i].parent_joint);
    require(joint < robot->joints.size() && robot->joints[joint].child_link == i &&
            robot->joints[joint].parent_link < i);
  }
  require(nodes::poseJoints(*robot, {}, true).parent_from_child.size() == robot->joints.size());
  return 0;
}
