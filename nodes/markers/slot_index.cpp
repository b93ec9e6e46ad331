#include "nodes/markers/slot_index.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace stillframe::nodes {

void SlotIndex::reserve(std::size_t count) {
  constexpr std::size_t kLeast = 64;
  const std::size_t wanted = std::bit_ceil(std::max(2 * count, kLeast));
  if (wanted <= cells_.size()) {
    return;
  }
  const std::vector<Cell> old = std::exchange(cells_, std::vector<Cell>(wanted));
  for (const Cell& cell : old) {
    if (cell.slot != kFree) {
      put(cell);
    }
  }
}

void SlotIndex::put(const Cell& cell) {
  std::size_t at = cell.hash & mask();
  while (cells_[at].slot != kFree) {
    at = (at + 1) & mask();
  }
  cells_[at] = cell;
}

void SlotIndex::insert(std::string_view id, std::size_t slot) {
  reserve(++count_);
  put({hashOf(id), static_cast<std::uint32_t>(slot)});
}

void SlotIndex::erase(std::string_view id, std::size_t slot) {
  std::size_t gap = hashOf(id) & mask();
  while (cells_[gap].slot != slot) {
    gap = (gap + 1) & mask();
  }
  // What follows moves up where the gap would part it from where it belongs.
  for (std::size_t at = (gap + 1) & mask(); cells_[at].slot != kFree; at = (at + 1) & mask()) {
    const std::size_t home = cells_[at].hash & mask();
    if (((at - home) & mask()) >= ((at - gap) & mask())) {
      cells_[gap] = cells_[at];
      gap = at;
    }
  }
  cells_[gap] = {};
  --count_;
}

}  // namespace stillframe::nodes
