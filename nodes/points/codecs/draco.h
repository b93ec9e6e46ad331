#pragma once

#include <expected>

#include "nodes/points/codecs/codec_error.h"
#include "scenegraph/objects/payload.h"
#include "scenegraph/objects/point_cloud.h"

namespace stillframe::nodes {

/// Decodes a Draco blob through libdraco: point clouds and the vertices of meshes, every method, bitstreams back to
/// 0.9. One row of points, the attributes packed one after the other; quantised values come back as floats.
///
/// Fields: the components of a position are x, y, z, of a colour red, green, blue, alpha, of a normal nx, ny, nz;
/// anything else, and an attribute of one component, has the name in its metadata, else generic_N of the N-th
/// attribute, with as many values as components. 64-bit integers become FLOAT64. What the header claims is checked
/// before libdraco makes room for it, points as well as values; a corrupt mesh of texture coordinates can still keep
/// libdraco 1.5.5 busy for some seconds, in bounded memory. The cloud has neither stamp nor frame. Any thread; no
/// state.
[[nodiscard]] std::expected<scenegraph::PointCloud, CodecError> decodeDraco(const scenegraph::Payload& blob);

}  // namespace stillframe::nodes
