#pragma once

#include <string>

#include "scenegraph/objects/object.h"
#include "scenegraph/objects/payload.h"
#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

/// A self-describing compressed cloud: point_cloud_interfaces/CompressedPointCloud2, foxglove.CompressedPointCloud.
struct CompressedPointCloud {
  static constexpr ObjectType kType = ObjectType::CompressedPointCloud;
  tf::TimePoint stamp;
  std::string frame_id;
  tf::RigidTransform pose;  ///< frame_from_points
  std::string format;       ///< lower case: "draco", "cloudini"; others are refused by the layer
  Payload data;
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + data.bytes.size(); }
};

}  // namespace stillframe::scenegraph
