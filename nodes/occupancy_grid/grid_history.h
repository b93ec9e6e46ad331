#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "nodes/checkpoints.h"
#include "nodes/occupancy_grid/grid_cells.h"
#include "nodes/occupancy_grid/grid_header.h"
#include "scenegraph/objects/occupancy_grid.h"

namespace stillframe::nodes {

/// A base grid after some of its updates.
struct GridState {
  GridCells cells;
  std::uint64_t applied = 0;      ///< updates, clipped ones included
  std::uint64_t clipped = 0;      ///< applied in part, since they reach beyond the grid
  std::uint64_t refused = 0;      ///< outside the grid, short of data or not decodable
  std::uint64_t other_frame = 0;  ///< applied by their cells although they name another frame than the base
  std::string first_refusal;      ///< of the first of them, one clause
  std::string first_frame;        ///< that another frame was named first
};

/// All states of one base grid: any number of updates in, and back again.
///
/// A state is a pure function of the base and the updates in their order; how it was come by leaves no trace. States
/// share the blocks that do not differ. Checkpoints lie wherever a certain amount of work has gone by, so that any
/// state costs a bounded amount of work; when they outgrow `max_bytes`, every other one goes and the amount doubles.
/// Not thread-safe.
class GridHistory {
 public:
  using Update = std::shared_ptr<const scenegraph::OccupancyGridUpdate>;
  /// The update at that place of the list; nullptr when it cannot be decoded.
  using Fetch = std::function<Update(std::size_t place)>;

  GridHistory(GridHeader header, std::span<const std::byte> cells, std::size_t max_bytes = std::size_t{256} << 20U);

  [[nodiscard]] const GridHeader& header() const noexcept { return header_; }
  /// The state after the updates of these ids, in this order. An id names an update for good (a store's sequence
  /// numbers); a list that differs from the one before, for something arrived late, costs what follows the difference.
  [[nodiscard]] std::shared_ptr<const GridState> at(std::span<const std::uint64_t> ids, const Fetch& fetch);

  [[nodiscard]] std::size_t checkpointCount() const noexcept { return checkpoints_.size(); }
  /// Memory of the base, the checkpoints and the updates kept.
  [[nodiscard]] std::size_t byteSize() const noexcept;

 private:
  struct Head {
    std::size_t place = 0;
    std::size_t work = 0;  ///< since the checkpoint before
    std::shared_ptr<GridState> state;
    bool is_given_out = false;  ///< and so not to be written any more
  };
  void forgetAfter(std::size_t place);
  Update update(std::size_t place, const Fetch& fetch);
  void apply(GridState& state, const Update& update) const;

  GridHeader header_;
  std::size_t max_bytes_;
  std::size_t base_bytes_ = 0;
  Checkpoints<GridState> checkpoints_;  // the first is the base
  std::optional<Head> head_;            // where the last call ended
  std::vector<std::uint64_t> ids_;
  std::vector<Update> updates_;  // by place; nullptr where not kept
  std::size_t update_bytes_ = 0;
};

}  // namespace stillframe::nodes
