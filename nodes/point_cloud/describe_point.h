#pragma once

#include <cstddef>
#include <optional>

#include "nodes/point_cloud/cloud_points.h"
#include "scenegraph/pick/picked.h"

namespace stillframe::nodes {

/// Point `index` of those drawn, with every field of the message and its colour, in the cloud's frame and in double.
/// Its id is the number of the point in the message. Nullopt when there are not so many.
[[nodiscard]] std::optional<scenegraph::Picked> describePoint(const CloudPoints& cloud, std::size_t index);

}  // namespace stillframe::nodes
