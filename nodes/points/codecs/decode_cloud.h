#pragma once

#include <expected>

#include "nodes/points/codecs/codec_error.h"
#include "scenegraph/objects/compressed_point_cloud.h"
#include "scenegraph/objects/point_cloud.h"

namespace stillframe::nodes {

/// Decodes a compressed cloud by its format, "draco" or "cloudini", and gives it its stamp, frame and pose. Any thread.
[[nodiscard]] std::expected<scenegraph::PointCloud, CodecError> decodeCloud(
    const scenegraph::CompressedPointCloud& cloud);

}  // namespace stillframe::nodes
