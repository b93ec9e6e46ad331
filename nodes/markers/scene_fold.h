#pragma once

#include <functional>
#include <queue>

#include "nodes/markers/scene_history.h"
#include "nodes/markers/slot_index.h"

namespace stillframe::nodes {

/// A state that messages are applied to: SceneState with what finding and placing entities needs.
class SceneHistory::Fold {
 public:
  /// Goes on from a state after `place` messages.
  Fold(const SceneState& state, std::size_t place, std::uint64_t last_sequence, std::size_t max_bytes);

  void apply(const SceneMessage& message);
  /// As it is, before anything ends with its lifetime.
  [[nodiscard]] SceneState snapshot();
  /// As it is at `time`.
  [[nodiscard]] SceneState snapshotAt(tf::TimePoint time);

  std::size_t place = 0;
  std::uint64_t last_sequence = 0;
  std::size_t work = 0;       ///< since the last checkpoint
  std::size_t new_bytes = 0;  ///< of entities since then

 private:
  using BatchId = std::pair<std::string, ShapeBatchKey>;

  void add(const scenegraph::SceneEntity& entity, const std::shared_ptr<const scenegraph::SceneEntities>& owner,
           tf::TimePoint log_time);
  void remove(const scenegraph::SceneEntityDeletion& deletion);
  [[nodiscard]] std::optional<std::size_t> slotOf(std::string_view id) const;
  [[nodiscard]] const LiveEntity* entityAt(std::size_t slot) const {
    return blocks_[slot / SceneState::kBlock]->slots[slot % SceneState::kBlock].get();
  }
  void erase(std::size_t slot);
  void endLifetimes(tf::TimePoint time);
  void put(std::size_t slot, std::shared_ptr<const LiveEntity> entity);
  bool placeRuns(LiveEntity& entity, const LiveEntity* replaced);
  void freeRuns(const LiveEntity& entity);
  void closeGaps();

  std::size_t max_bytes_;
  std::uint64_t epoch_ = 1;  // blocks of this epoch are nobody else's
  std::vector<std::shared_ptr<SceneState::Block>> blocks_;
  SceneState rest_;  // all but blocks and batches
  SlotIndex slots_;
  std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> free_slots_;  // the lowest first
  std::set<std::pair<std::int64_t, std::size_t>> expiries_;
  std::map<BatchId, PlaceList> batches_;
};

}  // namespace stillframe::nodes
