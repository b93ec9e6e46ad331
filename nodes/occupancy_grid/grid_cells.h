#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "nodes/occupancy_grid/grid_header.h"
#include "scenegraph/objects/occupancy_grid.h"

namespace stillframe::nodes {

/// What the cells of a grid amount to.
struct CellCounts {
  std::uint64_t unknown = 0;   ///< -1
  std::uint64_t occupied = 0;  ///< 65..100
  std::uint64_t invalid = 0;   ///< outside -1..100

  friend bool operator==(const CellCounts&, const CellCounts&) = default;
};

/// A square of cells, row-major, row 0 at y = 0. One that is all of one value keeps that value alone.
struct GridBlock {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::int8_t> cells;

  [[nodiscard]] bool isUniform() const noexcept { return cells.size() == 1; }
  [[nodiscard]] std::size_t byteSize() const noexcept { return sizeof(*this) + cells.size(); }
};

/// What became of a patch.
enum class PatchOutcome : std::uint8_t {
  Applied,
  Clipped,  ///< the part inside the grid was applied
  Outside,  ///< no cell of it lies in the grid
  Short,    ///< fewer bytes than cells: not applied
};

/// The cells of a grid as blocks that copies share: a copy costs a pointer a block, a patch after it copies only the
/// blocks that it touches. Not thread-safe; copies may be read and patched by different threads.
class GridCells {
 public:
  GridCells() = default;
  /// Of a grid that checkGrid() took.
  GridCells(const GridHeader& header, std::span<const std::byte> cells);
  GridCells(const GridCells& other);
  GridCells& operator=(const GridCells& other);
  GridCells(GridCells&&) noexcept = default;
  GridCells& operator=(GridCells&&) noexcept = default;
  ~GridCells() = default;

  PatchOutcome apply(const scenegraph::OccupancyGridUpdate& patch);

  [[nodiscard]] const CellCounts& counts() const noexcept { return counts_; }
  [[nodiscard]] std::uint32_t blockColumns() const noexcept { return block_columns_; }
  /// Row-major.
  [[nodiscard]] const std::vector<std::shared_ptr<GridBlock>>& blocks() const noexcept { return blocks_; }
  /// The value of a cell of the grid.
  [[nodiscard]] std::int8_t at(std::uint32_t column, std::uint32_t row) const;
  /// Bytes that apply() has copied into blocks of its own since this object was last copied.
  [[nodiscard]] std::size_t ownBytes() const noexcept { return own_bytes_; }
  [[nodiscard]] std::size_t byteSize() const noexcept;

 private:
  GridBlock& own(std::size_t block);
  void disown() const;

  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::uint32_t edge_ = 1;
  std::uint32_t block_columns_ = 0;
  CellCounts counts_;
  std::vector<std::shared_ptr<GridBlock>> blocks_;
  // Whether a block belongs to this object alone; copying ends that for both, and so these change in const objects.
  mutable std::vector<std::uint8_t> is_own_;
  mutable std::size_t own_bytes_ = 0;
};

/// Counts of some cells.
[[nodiscard]] CellCounts countCells(std::span<const std::int8_t> cells) noexcept;

}  // namespace stillframe::nodes
