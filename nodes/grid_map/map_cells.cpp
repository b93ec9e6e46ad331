#include "nodes/grid_map/map_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace stillframe::nodes {
namespace {

using scenegraph::GridMap;
using scenegraph::Status;
using scenegraph::StatusLevel;

Status malformedMap(std::string message) { return {StatusLevel::Error, "MalformedGrid", std::move(message)}; }

std::string sizeText(const GridMap& map) {
  return std::to_string(map.column_count) + " x " + std::to_string(map.row_count) + " cells";
}

std::optional<Status> findFault(const GridMap& map) {
  const auto isSize = [](double size, std::uint32_t count) {
    return size > 0.0 && size * count < ConvertedCloud::kReach;
  };
  if (!isSize(map.cell_size_m.x, std::max(map.column_count, 1U)) ||
      !isSize(map.cell_size_m.y, std::max(map.row_count, 1U)) || !tf::isFinite(map.origin)) {
    return malformedMap("cells of " + std::to_string(map.cell_size_m.x) + " x " + std::to_string(map.cell_size_m.y) +
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
    return malformedMap("the map of " + sizeText(map) + " with strides of " + std::to_string(map.row_stride) + " and " +
                        std::to_string(map.cell_stride) + " bytes needs " +
                        (record ? std::to_string(needed) : "more than 2^32") + " bytes, it has " +
                        std::to_string(map.data.bytes.size()));
  }
  return std::nullopt;
}

bool isHeight(float height) noexcept { return std::abs(height) <= ConvertedCloud::kReach; }

/// What takes a rise over one or two cells to a slope.
struct CellScale {
  explicit CellScale(const glm::dvec2& size_m)
      : x(static_cast<float>(std::min(1.0 / size_m.x, kMost))),
        y(static_cast<float>(std::min(1.0 / size_m.y, kMost))) {}
  static constexpr double kMost = 1e30;  // times no rise it is 0 still
  float x;
  float y;
};

/// Slope at a height between its neighbours, those that are heights, steeper than any eye can tell at most.
float slopeAt(float height, float before, float after, float scale) noexcept {
  constexpr float kSteepest = 1e6F;
  const bool has_before = isHeight(before);
  const bool has_after = isHeight(after);
  const float rise = (has_after ? after : height) - (has_before ? before : height);
  const float slope = rise * scale * (has_before && has_after ? 0.5F : 1.0F);
  return slope < -kSteepest ? -kSteepest : slope > kSteepest ? kSteepest : slope;
}

std::int8_t rounded(float value) noexcept {
  return static_cast<std::int8_t>(static_cast<int>(value + (value < 0.0F ? -0.5F : 0.5F)));
}

// Rows are written in loops without branches, which the compiler turns into vector code.

void writePositions(const float* heights, std::span<const float> x, float y, float shift, float* out) {
  for (std::size_t i = 0; i < x.size(); ++i, out += 3) {
    out[0] = x[i];
    out[1] = y;
    out[2] = isHeight(heights[i]) ? heights[i] + shift : 0.0F;
  }
}

/// Of cells whose neighbours lie at the same places in the rows before and after; the row has one cell more at both
/// ends.
void writeNormals(const float* heights, const float* before, const float* after, std::size_t columns,
                  const CellScale& scale, std::int8_t* out) {
  const float* const left = heights - 1;
  const float* const right = heights + 1;
  for (std::size_t i = 0; i < columns; ++i, out += 4) {
    const bool is_drawn = isHeight(heights[i]);
    const float x = is_drawn ? slopeAt(heights[i], left[i], right[i], scale.x) : 0.0F;
    const float y = is_drawn ? slopeAt(heights[i], before[i], after[i], scale.y) : 0.0F;
    const float size = 127.0F / std::sqrt(x * x + y * y + 1.0F);
    out[0] = rounded(-x * size);
    out[1] = rounded(-y * size);
    out[2] = rounded(size);
    out[3] = 0;
  }
}

/// Triangles between a row and the one above it, whose first cell is number `first`. Returns how many indices.
std::size_t writeTriangles(const float* row, const float* above, std::size_t columns, std::size_t first,
                           std::uint32_t* out) {
  std::uint32_t* const start = out;
  for (std::size_t column = 0; column + 1 < columns; ++column) {
    const auto a = static_cast<std::uint32_t>(first + column);
    const auto d = static_cast<std::uint32_t>(a + columns);
    // Counter-clockwise from above: a, b to its right, c above that, d above a.
    const std::array<std::uint32_t, 4> corners{a, a + 1, d + 1, d};
    const std::array<bool, 4> has{isHeight(row[column]), isHeight(row[column + 1]), isHeight(above[column + 1]),
                                  isHeight(above[column])};
    std::array<std::uint32_t, 5> kept{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      kept[count] = corners[i];
      count += has[i] ? 1 : 0;
    }
    // Both triangles are written, and kept when there are corners enough.
    const std::array<std::uint32_t, 6> both{kept[0], kept[1], kept[2], kept[0], kept[2], kept[3]};
    std::ranges::copy(both, out);
    out += count == 4 ? 6 : count == 3 ? 3 : 0;
  }
  return static_cast<std::size_t>(out - start);
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
  const auto shift = static_cast<float>(heights_offset - z_origin);
  const CellScale scale(map.cell_size_m);
  std::vector<float> x(columns);
  for (std::size_t column = 0; column < columns; ++column) {
    x[column] = static_cast<float>((static_cast<double>(column) + 0.5) * map.cell_size_m.x);
  }
  // The row, the one before and the one after, with a cell that has no height at both ends.
  std::array<std::vector<float>, 3> padded;
  padded.fill(std::vector<float>(columns + 2, kMissingValue));
  const auto load = [&](std::size_t row) {
    const auto to = std::span(padded[row % 3]).subspan(1, columns);
    if (row < rows) {
      std::ranges::copy(heights.subspan(row * columns, columns), to.begin());
    } else {
      std::ranges::fill(to, kMissingValue);
    }
  };
  if (rows > 0) {
    load(0);
  }
  sinks.triangles.clear();
  sinks.triangles.reserve(columns > 1 && rows > 1 ? 6 * (columns - 1) * (rows - 1) : 0);
  std::vector<std::uint32_t> triangles(6 * columns);
  for (std::size_t row = 0; row < rows; ++row) {
    load(row + 1);
    const float* const at = padded[row % 3].data() + 1;
    const float* const above = padded[(row + 1) % 3].data() + 1;
    const std::size_t first = row * columns;
    writePositions(at, x, static_cast<float>((static_cast<double>(row) + 0.5) * map.cell_size_m.y), shift,
                   &sinks.positions[3 * first]);
    writeNormals(at, padded[(row + 2) % 3].data() + 1, above, columns, scale, &sinks.normals[4 * first]);
    if (row + 1 < rows) {
      const std::size_t count = writeTriangles(at, above, columns, first, triangles.data());
      sinks.triangles.insert(sinks.triangles.end(), triangles.data(), triangles.data() + count);
    }
  }
}

}  // namespace stillframe::nodes
