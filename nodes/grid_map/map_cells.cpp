#include "nodes/grid_map/map_cells.h"

#include <algorithm>
#include <cmath>

namespace stillframe::nodes {
namespace {

using scenegraph::GridMap;
using scenegraph::Status;
using scenegraph::StatusLevel;

Status malformed(std::string message) { return {StatusLevel::Error, "MalformedGrid", std::move(message)}; }

std::string sizeText(const GridMap& map) {
  return std::to_string(map.column_count) + " x " + std::to_string(map.row_count) + " cells";
}

std::optional<Status> findFault(const GridMap& map) {
  const auto isSize = [](double size, std::uint32_t count) {
    return size > 0.0 && size * count < ConvertedCloud::kReach;
  };
  if (!isSize(map.cell_size_m.x, std::max(map.column_count, 1U)) ||
      !isSize(map.cell_size_m.y, std::max(map.row_count, 1U)) || !tf::isFinite(map.origin)) {
    return malformed("cells of " + std::to_string(map.cell_size_m.x) + " x " + std::to_string(map.cell_size_m.y) +
                     " m cannot be placed, or the origin is not finite");
  }
  if (map.column_count > kMaxMapSide || map.row_count > kMaxMapSide ||
      std::uint64_t{map.column_count} * map.row_count > kMaxMapCells) {
    return Status{StatusLevel::Error, "TooManyCells",
                  "the map has " + sizeText(map) + ": at most " + std::to_string(kMaxMapSide) + " a side and " +
                      std::to_string(kMaxMapCells) + " in all are drawn"};
  }
  const auto record = recordBytes(map.fields);
  const std::uint64_t needed = map.column_count == 0 || map.row_count == 0 || !record
                                   ? 0
                                   : std::uint64_t{map.row_count - 1} * map.row_stride +
                                         std::uint64_t{map.column_count - 1} * map.cell_stride + *record;
  if (!record || needed > map.data.bytes.size()) {
    return malformed("the map of " + sizeText(map) + " with strides of " + std::to_string(map.row_stride) + " and " +
                     std::to_string(map.cell_stride) + " bytes needs " +
                     (record ? std::to_string(needed) : "more than 2^32") + " bytes, it has " +
                     std::to_string(map.data.bytes.size()));
  }
  return std::nullopt;
}

}  // namespace

std::expected<MapCells, Status> readMapCells(const GridMap& map) {
  if (auto fault = findFault(map)) {
    return std::unexpected(std::move(*fault));
  }
  MapCells cells = readPackedCells(map.fields, map.data);
  cells.records.width = map.column_count;
  cells.records.height = map.row_count;
  cells.records.point_step = map.cell_stride;
  cells.records.row_step = map.row_stride;
  if (map.column_count > 0) {
    cells.all.points = std::size_t{map.column_count} * map.row_count;
    cells.all.point_step = map.cell_stride;
    for (std::size_t row = 0; row < map.row_count; ++row) {
      cells.all.runs.push_back({row * map.row_stride, map.column_count});
    }
  }
  return cells;
}

void buildSurface(const GridMap& map, std::span<const float> heights, double heights_offset, double z_origin,
                  const SurfaceSinks& sinks) {
  const std::size_t columns = map.column_count;
  const std::size_t rows = map.row_count;
  const auto has = [&](std::size_t i) { return std::abs(heights[i]) <= ConvertedCloud::kReach; };
  const auto shift = static_cast<float>(heights_offset - z_origin);
  /// Slope at cell i between the neighbours `step` away, on the sides where there are any.
  const auto slope = [&](std::size_t i, std::size_t step, bool has_before, bool has_after, double size) {
    const bool before = has_before && has(i - step);
    const bool after = has_after && has(i + step);
    const double rise = (after ? heights[i + step] : heights[i]) - (before ? heights[i - step] : heights[i]);
    return before || after ? rise / (size * (before && after ? 2.0 : 1.0)) : 0.0;
  };
  for (std::size_t row = 0, i = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column, ++i) {
      const bool is_drawn = has(i);
      sinks.positions[3 * i] = static_cast<float>((static_cast<double>(column) + 0.5) * map.cell_size_m.x);
      sinks.positions[3 * i + 1] = static_cast<float>((static_cast<double>(row) + 0.5) * map.cell_size_m.y);
      sinks.positions[3 * i + 2] = is_drawn ? heights[i] + shift : 0.0F;
      glm::dvec3 normal{0.0, 0.0, 1.0};
      if (is_drawn) {
        normal.x = -slope(i, 1, column > 0, column + 1 < columns, map.cell_size_m.x);
        normal.y = -slope(i, columns, row > 0, row + 1 < rows, map.cell_size_m.y);
      }
      const double scale = 127.0 / std::hypot(normal.x, normal.y, normal.z);
      for (int axis = 0; axis < 3; ++axis) {
        sinks.normals[4 * i + static_cast<std::size_t>(axis)] =
            static_cast<std::int8_t>(std::lround(normal[axis] * scale));
      }
      sinks.normals[4 * i + 3] = 0;
    }
  }
  sinks.triangles.clear();
  sinks.triangles.reserve(columns > 1 && rows > 1 ? 6 * (columns - 1) * (rows - 1) : 0);
  for (std::size_t row = 0; row + 1 < rows; ++row) {
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const auto a = static_cast<std::uint32_t>(row * columns + column);
      const auto d = static_cast<std::uint32_t>(a + columns);
      // Counter-clockwise from above: a, b to its right, c above that, d above a.
      const std::array<std::uint32_t, 4> corners{a, a + 1, d + 1, d};
      std::array<std::uint32_t, 4> kept{};
      std::size_t count = 0;
      for (const std::uint32_t corner : corners) {
        if (has(corner)) {
          kept[count++] = corner;
        }
      }
      if (count >= 3) {
        sinks.triangles.insert(sinks.triangles.end(), {kept[0], kept[1], kept[2]});
      }
      if (count == 4) {
        sinks.triangles.insert(sinks.triangles.end(), {kept[0], kept[2], kept[3]});
      }
    }
  }
}

}  // namespace stillframe::nodes
