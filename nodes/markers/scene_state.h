#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "nodes/markers/entity_shapes.h"
#include "scenegraph/objects/scene_entities.h"
#include "scenegraph/store/object_store.h"
#include "tf/time.h"

namespace stillframe::nodes {

/// An entity that is there, in the form in which it is drawn. Immutable; shared by all states that hold it.
struct LiveEntity {
  std::string id;
  std::string frame_id;
  std::string marker_namespace;
  tf::TimePoint stamp;
  tf::TimePoint log_time;                                          ///< of its message
  tf::TimePoint expiry{std::numeric_limits<std::int64_t>::max()};  ///< gone from then on
  bool is_frame_locked = false;
  std::vector<std::pair<std::string, std::string>> metadata;
  EntityShapes shapes;
  std::uint32_t primitives = 0;  ///< of every kind
  /// Lines, triangles, texts and models; nullptr without any.
  std::shared_ptr<const scenegraph::SceneEntity> rest;
  std::size_t byte_size = 0;
};

/// Sums over the entities of a state.
struct SceneTotals {
  std::uint64_t entities = 0;
  std::uint64_t primitives = 0;
  std::uint64_t unsound = 0, flat = 0, invisible = 0;  ///< as EntityShapes counts them
  std::uint64_t free_in_fixed = 0;                     ///< entities that are not frame-locked
  std::uint64_t bytes = 0;

  void add(const LiveEntity& entity, bool is_there);
};

/// A draw call's worth of shapes: its frame, what they are, and how many places there are (some may be free).
struct ShapeBatch {
  std::string frame_id;
  ShapeBatchKey key;
  std::uint32_t size = 0;
};

/// All entities of a topic at one moment. Cheap to copy: blocks are shared by states that hold the same in them.
///
/// An entity keeps its slot from the message that made it to its end, whatever comes and goes; so what differs between
/// two states is found by comparing pointers, and written in place.
struct SceneState {
  static constexpr std::size_t kBlock = 32;
  struct Block {
    std::uint64_t epoch = 0;  ///< SceneHistory's own
    std::array<std::shared_ptr<const LiveEntity>, kBlock> slots;
  };

  std::vector<std::shared_ptr<const Block>> blocks;
  std::vector<ShapeBatch> batches;
  SceneTotals totals;
  std::uint64_t refused = 0;                       ///< entities for which there was no room, from the beginning on
  std::uint64_t undecodable = 0;                   ///< messages, from the beginning on
  std::optional<scenegraph::DecodeError> failure;  ///< of the newest message
  std::vector<std::string> faults;                 ///< of the newest message
  /// The same state holds from the last expiry that went into it up to the next, between the same messages.
  tf::TimePoint last_expiry{std::numeric_limits<std::int64_t>::min()};
  tf::TimePoint next_expiry{std::numeric_limits<std::int64_t>::max()};

  [[nodiscard]] const LiveEntity* at(std::size_t slot) const {
    const std::size_t block = slot / kBlock;
    return block < blocks.size() ? blocks[block]->slots[slot % kBlock].get() : nullptr;
  }
  [[nodiscard]] std::size_t slotCount() const noexcept { return blocks.size() * kBlock; }
};

/// Calls `visit(slot, before, after)` for each slot whose entity differs; either may be nullptr.
template <typename Visit>
void forEachChange(const SceneState& before, const SceneState& after, Visit visit) {
  const std::size_t count = std::max(before.blocks.size(), after.blocks.size());
  for (std::size_t block = 0; block < count; ++block) {
    const auto* const a = block < before.blocks.size() ? before.blocks[block].get() : nullptr;
    const auto* const b = block < after.blocks.size() ? after.blocks[block].get() : nullptr;
    if (a == b) {
      continue;
    }
    for (std::size_t i = 0; i < SceneState::kBlock; ++i) {
      const LiveEntity* const old = a != nullptr ? a->slots[i].get() : nullptr;
      const LiveEntity* const now = b != nullptr ? b->slots[i].get() : nullptr;
      if (old != now) {
        visit(block * SceneState::kBlock + i, old, now);
      }
    }
  }
}

}  // namespace stillframe::nodes
