#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scenegraph/objects/frame_transforms.h"
#include "scenegraph/status.h"
#include "scenegraph/store/object_store.h"
#include "scenegraph/store/tf_clock.h"
#include "tf/transform_buffer.h"

namespace stillframe::scenegraph {

/// Moves the FrameTransforms entries of a store into a TransformBuffer, each once, under one clock. Dataset's inner
/// part.
///
/// Who watches the progress finds in the buffer what has been decoded so far: what is seen at the beginning of a long
/// recording need not wait for its end. Until all is there it lies under the clock that the first transforms tell of;
/// should all of them tell otherwise, everything is inserted anew.
///
/// Not thread-safe: Dataset lets one caller in at a time. Memory: a cursor per topic; while the clock is not settled,
/// 88 bytes for each transform seen.
class TransformLoader {
 public:
  using Progress = std::function<bool(std::uint64_t, std::uint64_t)>;

  TransformLoader(const ObjectStore& store, tf::TransformBuffer& buffer) : store_(store), buffer_(buffer) {}

  /// Takes what is new. `settled_clock` absent: finds out, once per recording, from the dynamic edges.
  void take(const Progress& progress);
  /// Header stamps (false), log times (true), or nullopt to find out. Refills the buffer when the clock in use changes.
  void setUseLogTime(std::optional<bool> use_log_time);
  [[nodiscard]] bool usesLogTime() const noexcept { return uses_log_time_; }
  [[nodiscard]] std::vector<Problem> problems() const;

 private:
  struct Work {
    TopicId topic = 0;
    Entry entry;
    bool is_static = false;
  };
  struct Sample {
    std::uint32_t parent = 0;  // index into names_
    std::uint32_t child = 0;
    tf::TimePoint header;
    tf::TimePoint log;
    tf::RigidTransform parent_from_child;
    bool is_static = false;
  };
  void queueNew();
  bool decodeQueue(const Progress& progress, bool hold);
  void insertProvisionally();
  void clearBuffer();
  void decodeOne(const Work& work);
  void settleClock();
  void insertFrom(std::size_t first);
  void insertGathered();
  void refill();
  std::uint32_t nameIndex(const std::string& name);
  std::uint32_t edgeIndex(const Sample& sample);

  const ObjectStore& store_;
  tf::TransformBuffer& buffer_;
  std::vector<std::uint64_t> cursors_;  // per topic: the next sequence to take
  std::vector<Work> queue_;             // known, not yet decoded; by log time
  std::size_t queue_next_ = 0;
  std::vector<Sample> gathered_;          // decoded, and not yet inserted but for the first inserted_
  std::size_t inserted_ = 0;              // provisionally: the clock may turn out to be the other
  std::size_t clock_samples_in_use_ = 0;  // that told of the clock they lie under
  bool has_forgotten_ = false;            // samples in the buffer that gathered_ does not hold
  std::deque<std::string> names_;
  std::unordered_map<std::string_view, std::uint32_t> name_index_;

  bool is_automatic_ = true;
  bool is_settled_ = false;  // automatic: decided from enough samples
  bool uses_log_time_ = false;
  std::vector<ClockSample> clock_samples_;  // until settled
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edge_index_;

  std::vector<Problem> clock_problems_;
  std::map<std::pair<TopicId, std::string>, Problem> decode_problems_;
  std::vector<Problem> refusal_problems_;
  std::map<std::tuple<tf::InsertError, std::string, std::string>, std::size_t> refusal_index_;
  std::uint64_t unlisted_refusals_ = 0;
};

}  // namespace stillframe::scenegraph
