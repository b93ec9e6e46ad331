#include "nodes/points/codecs/draco_bounded.h"

#include <draco/core/varint_decoding.h>

#include <algorithm>

namespace stillframe::nodes {
namespace {

/// Plain numbers up to the bitstream that brought varints there.
std::optional<std::uint32_t> readCount(draco::DecoderBuffer& buffer, int major, int minor) {
  std::uint32_t count = 0;
  const bool is_plain = buffer.bitstream_version() < DRACO_BITSTREAM_VERSION(major, minor);
  const bool is_there = is_plain ? buffer.Decode(&count) : draco::DecodeVarint(&count, &buffer);
  return is_there ? std::optional(count) : std::nullopt;
}

}  // namespace

bool DracoBudget::allows(const std::optional<DracoClaim>& claim) {
  if (!claim) {
    return false;
  }
  // A position at least, and the corner tables of a mesh.
  constexpr std::uint64_t kPointBytes = 12;
  constexpr std::uint64_t kFaceBytes = 64;
  if (claim->points > max_bytes_ / kPointBytes || claim->faces > max_bytes_ / kFaceBytes) {
    refused_ = claim;
    return false;
  }
  return true;
}

bool DracoBudget::allowsOrientations(draco::PredictionSchemeMethod method, draco::DecoderBuffer buffer,
                                     std::uint64_t faces) {
  std::optional<std::uint32_t> count;
  if (std::uint32_t plain = 0; method == draco::MESH_PREDICTION_TEX_COORDS_PORTABLE && buffer.Decode(&plain)) {
    count = plain;
  } else if (method == draco::MESH_PREDICTION_TEX_COORDS_DEPRECATED) {
    count = readCount(buffer, 2, 2);
  }
  if (count && *count > 3 * faces) {
    refused_ = DracoClaim{.points = 0, .faces = faces, .orientations = *count};
    return false;
  }
  return true;  // another prediction; or cut off, which libdraco notices
}

bool DracoBudget::allowsTree(draco::DecoderBuffer buffer, std::uint64_t points) {
  std::uint8_t method = 0;
  std::uint8_t level = 0;
  std::uint32_t count = 0;
  if (buffer.bitstream_version() >= DRACO_BITSTREAM_VERSION(2, 3) || !buffer.Decode(&method) ||
      !buffer.Decode(&level) || !buffer.Decode(&count) || count <= points) {
    return true;  // or cut off, which libdraco notices
  }
  refused_ = DracoClaim{.points = count};
  return false;
}

bool DracoBudget::allowsValues(const draco::PointCloud& cloud) {
  std::uint64_t point_bytes = 0;
  for (int i = 0; i < cloud.num_attributes(); ++i) {
    const draco::PointAttribute& attribute = *cloud.attribute(i);
    // Integers of 32 bits stand in for values while they are decoded.
    point_bytes += std::uint64_t{attribute.num_components()} *
                   static_cast<std::uint64_t>(std::max(4, draco::DataTypeLength(attribute.data_type())));
  }
  if (point_bytes > 0 && cloud.num_points() > max_bytes_ / point_bytes) {
    refused_ = DracoClaim{.points = cloud.num_points()};
    return false;
  }
  return true;
}

std::optional<DracoClaim> peekPointCloud(draco::DecoderBuffer buffer) {
  std::uint32_t points = 0;
  if (!buffer.Decode(&points)) {
    return std::nullopt;
  }
  return DracoClaim{.points = points};
}

std::optional<DracoClaim> peekSequentialMesh(draco::DecoderBuffer buffer) {
  const auto faces = readCount(buffer, 2, 2);
  const auto points = faces ? readCount(buffer, 2, 2) : std::nullopt;
  return points ? std::optional(DracoClaim{.points = *points, .faces = *faces}) : std::nullopt;
}

std::optional<DracoClaim> peekEdgebreakerMesh(draco::DecoderBuffer buffer) {
  if (buffer.bitstream_version() < DRACO_BITSTREAM_VERSION(2, 2) && !readCount(buffer, 2, 0)) {
    return std::nullopt;  // new vertices, a number of its own then
  }
  const auto vertices = readCount(buffer, 2, 0);
  const auto faces = vertices ? readCount(buffer, 2, 0) : std::nullopt;
  return faces ? std::optional(DracoClaim{.points = *vertices, .faces = *faces}) : std::nullopt;
}

}  // namespace stillframe::nodes
