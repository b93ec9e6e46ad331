#pragma once

#include <string>
#include <vector>

#include "scenegraph/objects/object.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// A robot as XML text, std_msgs/String on a topic whose last segment is `robot_description`.
struct RobotDescription {
  static constexpr ObjectType kType = ObjectType::RobotDescription;
  std::string format;  ///< "urdf", "sdf", "mjcf" by the root element; "" unknown
  std::string text;
  std::string file = {};  ///< that it was read from, which relative names start at; "": a message
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + text.size() + file.size(); }
};

/// sensor_msgs/JointState: positions by name (rad or m). Shorter position lists leave the rest unknown.
struct JointStates {
  static constexpr ObjectType kType = ObjectType::JointStates;
  tf::TimePoint stamp;
  std::vector<std::string> names;
  std::vector<double> positions;
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + names.size() * 64; }
};

}  // namespace stillframe::scenegraph
