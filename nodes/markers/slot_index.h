#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace stillframe::nodes {

/// Finds the slot of an entity by its id, without keeping the ids: who asks says which id a slot has. 16 to 32 bytes an
/// entity in one piece, and mostly one cache miss a question. Slots are below 2^32.
class SlotIndex {
 public:
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  /// Makes room for so many in all.
  void reserve(std::size_t count);
  /// `id_of(slot)` gives the id of a slot that is in the index.
  template <typename IdOf>
  [[nodiscard]] std::optional<std::size_t> find(std::string_view id, const IdOf& id_of) const {
    const std::uint32_t hash = hashOf(id);
    for (std::size_t at = hash & mask(); !cells_.empty() && cells_[at].slot != kFree; at = (at + 1) & mask()) {
      if (cells_[at].hash == hash && id_of(cells_[at].slot) == id) {
        return cells_[at].slot;
      }
    }
    return std::nullopt;
  }
  /// `id` must not be there yet.
  void insert(std::string_view id, std::size_t slot);
  /// Both must be there together.
  void erase(std::string_view id, std::size_t slot);

 private:
  static constexpr std::uint32_t kFree = ~std::uint32_t{0};
  struct Cell {
    std::uint32_t hash = 0;
    std::uint32_t slot = kFree;
  };
  [[nodiscard]] static std::uint32_t hashOf(std::string_view id) noexcept {
    return static_cast<std::uint32_t>(std::hash<std::string_view>{}(id));
  }
  [[nodiscard]] std::size_t mask() const noexcept { return cells_.size() - 1; }
  void put(const Cell& cell);

  std::vector<Cell> cells_;  // a power of two, at least half of them free
  std::size_t count_ = 0;
};

}  // namespace stillframe::nodes
