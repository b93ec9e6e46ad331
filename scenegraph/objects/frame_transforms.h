#pragma once

#include <string>
#include <vector>

#include "scenegraph/objects/object.h"
#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// One edge sample: p_parent = parent_from_child * p_child. The rotation is as sent, not yet normalised.
struct FrameTransform {
  tf::TimePoint stamp;  ///< the transform's own header stamp
  std::string parent_frame_id;
  std::string child_frame_id;
  tf::RigidTransform parent_from_child;
};

/// tf2_msgs/TFMessage, geometry_msgs/TransformStamped, foxglove.FrameTransform(s).
struct FrameTransforms {
  static constexpr ObjectType kType = ObjectType::FrameTransforms;
  std::vector<FrameTransform> transforms;
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + transforms.size() * sizeof(FrameTransform); }
};

}  // namespace stillframe::scenegraph
