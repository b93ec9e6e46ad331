#include "nodes/occupancy_grid/grid_cells.h"

#include <algorithm>
#include <cstring>

namespace stillframe::nodes {
namespace {

// Sums in bytes are what the compiler turns into vector code: at most 255 cells at a time.
constexpr std::size_t kRun = 255;

void add(CellCounts& to, const CellCounts& counts, std::uint64_t times = 1) {
  to.unknown += times * counts.unknown;
  to.occupied += times * counts.occupied;
  to.invalid += times * counts.invalid;
}

void subtract(CellCounts& from, const CellCounts& counts) {
  from.unknown -= counts.unknown;
  from.occupied -= counts.occupied;
  from.invalid -= counts.invalid;
}

const std::int8_t* cellsOf(std::span<const std::byte> bytes) {
  return reinterpret_cast<const std::int8_t*>(bytes.data());
}

}  // namespace

CellCounts countCells(std::span<const std::int8_t> cells) noexcept {
  CellCounts counts;
  while (!cells.empty()) {
    const auto run = cells.first(std::min(kRun, cells.size()));
    std::uint8_t unknown = 0;
    std::uint8_t occupied = 0;
    std::uint8_t invalid = 0;
    for (const std::int8_t cell : run) {
      unknown = static_cast<std::uint8_t>(unknown + static_cast<std::uint8_t>(cell == -1));
      occupied = static_cast<std::uint8_t>(occupied + static_cast<std::uint8_t>(cell >= 65 && cell <= 100));
      invalid = static_cast<std::uint8_t>(invalid + static_cast<std::uint8_t>(cell < -1 || cell > 100));
    }
    add(counts, {unknown, occupied, invalid});
    cells = cells.subspan(run.size());
  }
  return counts;
}

GridCells::GridCells(const GridHeader& header, std::span<const std::byte> cells)
    : width_(header.width),
      height_(header.height),
      edge_(header.tile_edge),
      tile_columns_((header.width + header.tile_edge - 1) / header.tile_edge) {
  const std::int8_t* const from = cellsOf(cells);
  for (std::uint32_t y = 0; y < height_ && width_ > 0; y += edge_) {
    for (std::uint32_t x = 0; x < width_; x += edge_) {
      auto tile = std::make_shared<GridTile>();
      tile->width = std::min(edge_, width_ - x);
      tile->height = std::min(edge_, height_ - y);
      const auto row = [&](std::uint32_t i) { return from + (std::size_t{y} + i) * width_ + x; };
      const std::int8_t first = *row(0);
      bool is_uniform = true;
      for (std::uint32_t i = 0; i < tile->height && is_uniform; ++i) {
        is_uniform = *row(i) == first && std::memcmp(row(i), row(i) + 1, tile->width - 1) == 0;
      }
      if (is_uniform) {
        tile->cells.assign(1, first);
        add(counts_, countCells(tile->cells), std::uint64_t{tile->width} * tile->height);
      } else {
        tile->cells.resize(std::size_t{tile->width} * tile->height);
        for (std::uint32_t i = 0; i < tile->height; ++i) {
          std::memcpy(tile->cells.data() + std::size_t{i} * tile->width, row(i), tile->width);
        }
        add(counts_, countCells(tile->cells));
      }
      tiles_.push_back(std::move(tile));
    }
  }
  is_own_.assign(tiles_.size(), 0);
}

GridCells::GridCells(const GridCells& other)
    : width_(other.width_),
      height_(other.height_),
      edge_(other.edge_),
      tile_columns_(other.tile_columns_),
      counts_(other.counts_),
      tiles_(other.tiles_),
      is_own_(other.is_own_.size(), 0) {
  other.disown();
}

GridCells& GridCells::operator=(const GridCells& other) {
  if (this != &other) {
    *this = GridCells(other);
  }
  return *this;
}

void GridCells::disown() const {
  if (own_bytes_ > 0) {
    std::ranges::fill(is_own_, std::uint8_t{0});
    own_bytes_ = 0;
  }
}

GridTile& GridCells::own(std::size_t tile) {
  std::shared_ptr<GridTile>& shared = tiles_[tile];
  if (is_own_[tile] == 0) {
    auto copy = std::make_shared<GridTile>(*shared);
    if (copy->isUniform()) {
      const std::int8_t value = copy->cells.front();
      copy->cells.assign(std::size_t{copy->width} * copy->height, value);
    }
    shared = std::move(copy);
    is_own_[tile] = 1;
    own_bytes_ += shared->byteSize();
  }
  return *shared;
}

PatchOutcome GridCells::apply(const scenegraph::OccupancyGridUpdate& patch) {
  const std::uint64_t cells = std::uint64_t{patch.width} * patch.height;
  if (patch.data.bytes.size() < cells) {
    return PatchOutcome::Short;
  }
  const auto left = std::max<std::int64_t>(patch.x, 0);
  const auto bottom = std::max<std::int64_t>(patch.y, 0);
  const auto right = std::min<std::int64_t>(std::int64_t{patch.x} + patch.width, width_);
  const auto top = std::min<std::int64_t>(std::int64_t{patch.y} + patch.height, height_);
  if (cells == 0) {
    return PatchOutcome::Applied;
  }
  if (left >= right || bottom >= top) {
    return PatchOutcome::Outside;
  }
  const std::int8_t* const from = cellsOf(patch.data.bytes);
  const std::int64_t edge = edge_;
  for (std::int64_t tile_y = bottom / edge; tile_y * edge < top; ++tile_y) {
    for (std::int64_t tile_x = left / edge; tile_x * edge < right; ++tile_x) {
      GridTile& tile = own(static_cast<std::size_t>(tile_y * tile_columns_ + tile_x));
      const std::int64_t x0 = std::max(left, tile_x * edge);
      const std::int64_t x1 = std::min(right, tile_x * edge + tile.width);
      const std::int64_t y0 = std::max(bottom, tile_y * edge);
      const std::int64_t y1 = std::min(top, tile_y * edge + tile.height);
      const auto count = static_cast<std::size_t>(x1 - x0);
      for (std::int64_t y = y0; y < y1; ++y) {
        std::int8_t* const to = tile.cells.data() + (y - tile_y * edge) * tile.width + (x0 - tile_x * edge);
        subtract(counts_, countCells({to, count}));
        std::memcpy(to, from + (y - patch.y) * std::int64_t{patch.width} + (x0 - patch.x), count);
        add(counts_, countCells({to, count}));
      }
    }
  }
  const bool is_whole = left == patch.x && bottom == patch.y && right == std::int64_t{patch.x} + patch.width &&
                        top == std::int64_t{patch.y} + patch.height;
  return is_whole ? PatchOutcome::Applied : PatchOutcome::Clipped;
}

std::int8_t GridCells::at(std::uint32_t column, std::uint32_t row) const {
  const GridTile& tile = *tiles_[std::size_t{row / edge_} * tile_columns_ + column / edge_];
  return tile.isUniform() ? tile.cells.front() : tile.cells[std::size_t{row % edge_} * tile.width + column % edge_];
}

std::size_t GridCells::byteSize() const noexcept {
  std::size_t bytes = sizeof(*this) + tiles_.size() * (sizeof(tiles_.front()) + 1);
  for (const auto& tile : tiles_) {
    bytes += tile->byteSize();
  }
  return bytes;
}

}  // namespace stillframe::nodes
