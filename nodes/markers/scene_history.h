#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "nodes/checkpoints.h"
#include "nodes/markers/place_list.h"
#include "nodes/markers/scene_state.h"
#include "scenegraph/store/object_store.h"

namespace stillframe::nodes {

/// One message of a topic of scene entities.
struct SceneMessage {
  tf::TimePoint log_time;
  std::uint64_t sequence = 0;  ///< names the message for good
  std::size_t payload_bytes = 0;
  std::expected<std::shared_ptr<const scenegraph::SceneEntities>, scenegraph::DecodeError> scene;
};

/// All states of one topic of markers: on by any number of messages, and back again.
///
/// A state is a pure function of the messages in their order and the time: entities come, are replaced by their id,
/// deleted, and end with their lifetime, which runs on log time. Checkpoints bound the work of any step back. Bounded
/// memory: an entity beyond `max_bytes` in all, or in more draw calls than kMostBatches, is refused and counted. Not
/// thread-safe.
class SceneHistory {
 public:
  static constexpr std::size_t kMostBatches = 4096;
  static constexpr std::size_t kMostCells = 256;  ///< draw calls beyond which no new cell is opened

  /// The sequence number of the message at that place; and the message itself.
  using SequenceAt = std::function<std::uint64_t(std::size_t place)>;
  using Fetch = std::function<SceneMessage(std::size_t place)>;

  explicit SceneHistory(std::size_t max_bytes = std::size_t{1} << 30U,
                        std::size_t max_checkpoint_bytes = std::size_t{256} << 20U);
  ~SceneHistory();
  SceneHistory(SceneHistory&&) noexcept;
  SceneHistory& operator=(SceneHistory&&) noexcept;

  /// The state at `time` after the first `count` messages, all logged at or before it. Messages that arrived late,
  /// among those applied before, are noticed by the sequence numbers.
  [[nodiscard]] SceneState at(std::size_t count, tf::TimePoint time, const SequenceAt& sequence_at, const Fetch& fetch);

  [[nodiscard]] std::size_t checkpointCount() const noexcept { return checkpoints_.size(); }
  [[nodiscard]] std::size_t byteSize() const noexcept;

 private:
  class Fold;
  /// A state and the message it ends with.
  struct Mark {
    SceneState state;
    std::uint64_t last_sequence = 0;
  };

  std::size_t max_bytes_;
  Checkpoints<Mark> checkpoints_;
  std::unique_ptr<Fold> head_;  // where the last call ended
};

}  // namespace stillframe::nodes
