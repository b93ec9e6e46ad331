#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/status.h"
#include "scenegraph/store/object_cache.h"
#include "scenegraph/store/object_store.h"
#include "scenegraph/store/resources.h"
#include "tf/transform_buffer.h"

namespace stillframe::scenegraph {

/// Which clock stamps a transform (DESIGN.md §3, Time).
enum class TfClock : std::uint8_t {
  Auto,    ///< header stamps, unless they ride another epoch than the log times of the dynamic edges: then log times
  Header,  ///< the transform's own header stamp
  Log,     ///< the log time of its message
};

/// One opened recording or live stream: its objects, its transforms, its problems. Shared by all views. Any thread.
///
/// Owned by a shared_ptr: background work keeps it alive to its end.
///
/// The reader appends entries to `store()`; `takeTransforms()` moves what is new on the FrameTransforms topics into
/// `transforms()`, with a cursor per topic, so that nothing is taken twice.
class Dataset : public std::enable_shared_from_this<Dataset> {
 public:
  explicit Dataset(std::string name);
  ~Dataset();

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] ObjectStore& store() noexcept { return store_; }
  [[nodiscard]] const ObjectStore& store() const noexcept { return store_; }
  [[nodiscard]] ObjectCache& cache() const noexcept { return cache_; }
  /// Attachments and folders of the files that its messages name.
  [[nodiscard]] Resources& resources() noexcept { return resources_; }
  [[nodiscard]] const Resources& resources() const noexcept { return resources_; }
  [[nodiscard]] const std::shared_ptr<tf::TransformBuffer>& transforms() const noexcept { return transforms_; }

  /// Decodes the new entries of every FrameTransforms topic and inserts them in bulk. Blocks on the disk: call it on a
  /// worker for a file. `progress` is called with (entries done, entries in all) now and then; returning false stops
  /// early, and the next call goes on from there.
  void takeTransforms(const std::function<bool(std::uint64_t, std::uint64_t)>& progress = {});
  /// Changes the clock and rebuilds the transforms from the store when the clock in use changes. Blocks.
  void setTfClock(TfClock clock);
  [[nodiscard]] TfClock tfClock() const;
  /// Header or Log: what Auto has settled on, or what was set.
  [[nodiscard]] TfClock tfClockInUse() const;

  /// First and last log time over all topics, as known so far; the reader may know it before the entries.
  [[nodiscard]] std::optional<std::pair<tf::TimePoint, tf::TimePoint>> timeRange() const;
  /// What the file's own statistics say, before the entries are in.
  void setTimeRange(tf::TimePoint first, tf::TimePoint last);

  /// Adds a fault of the recording; equal code and message add up.
  void addProblem(const Problem& problem);
  /// Faults of the recording and of its transforms (refused edges, clock), in order of appearance.
  [[nodiscard]] std::vector<Problem> problems() const;

 private:
  struct Impl;
  std::string name_;
  ObjectStore store_;
  mutable ObjectCache cache_;
  Resources resources_;
  std::shared_ptr<tf::TransformBuffer> transforms_;
  std::unique_ptr<Impl> impl_;  // after store_ and transforms_, which it uses
};

}  // namespace stillframe::scenegraph
