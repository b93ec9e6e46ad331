#pragma once

#include <expected>

#include "nodes/points/codecs/codec_error.h"
#include "scenegraph/objects/payload.h"
#include "scenegraph/objects/point_cloud.h"

namespace stillframe::nodes {

/// Decodes a Cloudini blob: versions 3, 4 and 5, either header, every encoding, compression and field type.
///
/// Lossy fields come back within half a resolution. A field of 64-bit integers, or one that leaves its point, is
/// read to stay in step and is not among the cloud's fields; its bytes keep counting in the point step. Memory grows
/// with what is really decoded, and a header that claims more than its bytes can hold is refused first. The cloud has
/// neither stamp nor frame. Any thread; no state.
[[nodiscard]] std::expected<scenegraph::PointCloud, CodecError> decodeCloudini(const scenegraph::Payload& blob);

}  // namespace stillframe::nodes
