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
      edge_(header.block_edge),
      block_columns_((header.width + header.block_edge - 1) / header.block_edge) {
  const std::int8_t* const from = cellsOf(cells);
  for (std::uint32_t y = 0; y < height_ && width_ > 0; y += edge_) {
    for (std::uint32_t x = 0; x < width_; x += edge_) {
      auto block = std::make_shared<GridBlock>();
      block->width = std::min(edge_, width_ - x);
      block->height = std::min(edge_, height_ - y);
      const auto row = [&](std::uint32_t i) { return from + (std::size_t{y} + i) * width_ + x; };
      const std::int8_t first = *row(0);
      bool is_uniform = true;
      for (std::uint32_t i = 0; i < block->height && is_uniform; ++i) {
        is_uniform = *row(i) == first && std::memcmp(row(i), row(i) + 1, block->width - 1) == 0;
      }
      if (is_uniform) {
        block->cells.assign(1, first);
        add(counts_, countCells(block->cells), std::uint64_t{block->width} * block->height);
      } else {
        block->cells.resize(std::size_t{block->width} * block->height);
        for (std::uint32_t i = 0; i < block->height; ++i) {
          std::memcpy(block->cells.data() + std::size_t{i} * block->width, row(i), block->width);
        }
        add(counts_, countCells(block->cells));
      }
      blocks_.push_back(std::move(block));
    }
  }
  is_own_.assign(blocks_.size(), 0);
}

GridCells::GridCells(const GridCells& other)
    : width_(other.width_),
      height_(other.height_),
      edge_(other.edge_),
      block_columns_(other.block_columns_),
      counts_(other.counts_),
      blocks_(other.blocks_),
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

GridBlock& GridCells::own(std::size_t block) {
  std::shared_ptr<GridBlock>& shared = blocks_[block];
  if (is_own_[block] == 0) {
    auto copy = std::make_shared<GridBlock>(*shared);
    if (copy->isUniform()) {
      const std::int8_t value = copy->cells.front();
      copy->cells.assign(std::size_t{copy->width} * copy->height, value);
    }
    shared = std::move(copy);
    is_own_[block] = 1;
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
  for (std::int64_t block_y = bottom / edge; block_y * edge < top; ++block_y) {
    for (std::int64_t block_x = left / edge; block_x * edge < right; ++block_x) {
      GridBlock& block = own(static_cast<std::size_t>(block_y * block_columns_ + block_x));
      const std::int64_t x0 = std::max(left, block_x * edge);
      const std::int64_t x1 = std::min(right, block_x * edge + block.width);
      const std::int64_t y0 = std::max(bottom, block_y * edge);
      const std::int64_t y1 = std::min(top, block_y * edge + block.height);
      const auto count = static_cast<std::size_t>(x1 - x0);
      for (std::int64_t y = y0; y < y1; ++y) {
        std::int8_t* const to = block.cells.data() + (y - block_y * edge) * block.width + (x0 - block_x * edge);
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
  const GridBlock& block = *blocks_[std::size_t{row / edge_} * block_columns_ + column / edge_];
  return block.isUniform() ? block.cells.front() : block.cells[std::size_t{row % edge_} * block.width + column % edge_];
}

std::size_t GridCells::byteSize() const noexcept {
  std::size_t bytes = sizeof(*this) + blocks_.size() * (sizeof(blocks_.front()) + 1);
  for (const auto& block : blocks_) {
    bytes += block->byteSize();
  }
  return bytes;
}

}  // namespace stillframe::nodes
