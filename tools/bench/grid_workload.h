#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "nodes/occupancy_grid/grid_history.h"

namespace stillframe::bench {

/// A base grid of 4000 x 4000 cells, and 10 000 patches of 64 x 64 cells at random places in it, as a mapper sends
/// them.
class PatchStream {
 public:
  static constexpr std::uint32_t kSide = 4000;
  static constexpr std::uint32_t kPatchSide = 64;
  static constexpr std::size_t kPatches = 10'000;

  PatchStream();
  [[nodiscard]] nodes::GridHistory makeHistory() const;
  /// The grid and the patches as messages; the grid's bytes stay those of this.
  [[nodiscard]] scenegraph::OccupancyGrid base() const;
  [[nodiscard]] const scenegraph::OccupancyGridUpdate& patch(std::size_t place) const { return *patches_[place]; }
  /// The state after the first `count` patches.
  [[nodiscard]] std::shared_ptr<const nodes::GridState> seek(nodes::GridHistory& history, std::size_t count) const;

 private:
  nodes::GridHeader header_;
  std::vector<std::byte> cells_;
  std::vector<nodes::GridHistory::Update> patches_;
  std::vector<std::uint64_t> ids_;
};

}  // namespace stillframe::bench
