#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/points/packed_cells.h"
#include "scenegraph/objects/grid_map.h"
#include "scenegraph/status.h"

namespace stillframe::nodes {

/// A grid map whose sizes fit its data, with its cells seen as the points of a cloud, row by row, so that layers and
/// colours are read by the conversions of clouds.
using MapCells = PackedCells;

/// A side beyond this is no texture everywhere; cells in all are bounded by kMaxMapCells.
inline constexpr std::uint32_t kMaxMapSide = 16384;
inline constexpr std::size_t kMaxMapCells = std::size_t{1} << 24;

/// "MalformedGrid": cell size or origin make no sense, or the data is too short; "TooManyCells". A map without cells is
/// well-formed. The bytes stay those of `map`, which must outlive the result.
[[nodiscard]] std::expected<MapCells, scenegraph::Status> readMapCells(const scenegraph::GridMap& map);

/// A surface through the centres of the cells.
///
/// Vertices: x, y, z each cell, z being the height less `z_origin`, 0 where there is none. Normals: x, y, z, 0 in
/// steps of 1/127, by the slopes to those neighbours that have a height. Triangles: two between four neighbours with
/// heights, one between three.
struct SurfaceSinks {
  std::span<float> positions;      ///< 3 a cell
  std::span<std::int8_t> normals;  ///< 4 a cell
  std::vector<std::uint32_t>& triangles;
};
void buildSurface(const scenegraph::GridMap& map, std::span<const float> heights, double heights_offset,
                  double z_origin, const SurfaceSinks& sinks);

}  // namespace stillframe::nodes
