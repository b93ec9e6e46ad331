#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::tf {

/// Samples of one parent->child edge, answered by zero-order hold.
///
/// Sorted by stamp in blocks of at most kBlockSamples, stamps and poses apart (a search reads stamps only), with the
/// first stamp of every block in one index. A search is O(log n), a few probes when the rate is steady; an insert is
/// O(1) at the end and O(log n + block) anywhere else. 64 bytes a sample, at most an eighth of slack, and one byte of
/// index. Not thread-safe: TransformBuffer holds the lock.
class EdgeCache {
 public:
  static constexpr std::size_t kBlockSamples = 64;

  /// Position of a sample; valid until the next change.
  struct Cursor {
    std::uint32_t block = 0;
    std::uint32_t index = 0;
  };

  /// Sample in force at `time`; nullopt when `time` precedes every stamp.
  [[nodiscard]] std::optional<Cursor> find(TimePoint time) const noexcept;
  /// A search in three steps, for many edges at once: each step prefetches what the next one reads.
  struct Probe {
    std::size_t block_count = 0;  ///< blocks that start at or before the time
    double fraction = 0.0;        ///< where in the last of them the time would lie at a steady rate
  };
  void prefetchIndex(TimePoint time) const noexcept;
  [[nodiscard]] Probe probeBlock(TimePoint time) const noexcept;
  void prefetchSample(const Probe& probe) const noexcept;
  /// Sample in force at `time`, for the probe of that time.
  [[nodiscard]] std::optional<Cursor> find(const Probe& probe, TimePoint time) const noexcept;

  /// Pose in force at `time`, or nullptr when `time` precedes every stamp. Valid until the next change.
  [[nodiscard]] const RigidTransform* at(TimePoint time) const noexcept;
  [[nodiscard]] TimePoint stamp(Cursor cursor) const noexcept { return {blocks_[cursor.block].stamps[cursor.index]}; }
  [[nodiscard]] const RigidTransform& pose(Cursor cursor) const noexcept {
    return blocks_[cursor.block].poses[cursor.index];
  }

  /// Adds a sample or replaces the one of the same stamp.
  void insert(TimePoint stamp, const RigidTransform& parent_from_child);
  /// Drops every sample before `cutoff`.
  void dropBefore(TimePoint cutoff);

  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// First and newest stamp; only when not empty.
  [[nodiscard]] TimePoint first() const noexcept { return {firsts_.front()}; }
  [[nodiscard]] TimePoint last() const noexcept { return {last_}; }
  /// The first pose; only when not empty.
  [[nodiscard]] const RigidTransform& firstPose() const noexcept { return blocks_.front().poses.front(); }
  /// Heap bytes held, capacity included.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct Block {
    [[nodiscard]] std::size_t guess(const Probe& probe) const noexcept {
      const std::size_t count = stamps.size();
      const double index = probe.fraction * static_cast<double>(count);
      return std::min(static_cast<std::size_t>(static_cast<std::int64_t>(index)), count - 1);
    }

    std::vector<std::int64_t> stamps;
    std::vector<RigidTransform> poses;
  };
  void append(TimePoint stamp, const RigidTransform& parent_from_child);
  void insertBetween(TimePoint stamp, const RigidTransform& parent_from_child);
  void makeRoom(Block& block) const;
  void split(std::size_t block);

  std::vector<std::int64_t> firsts_;  // first stamp of each block
  std::vector<Block> blocks_;         // none is empty
  std::size_t size_ = 0;
  std::int64_t last_ = 0;  // newest stamp, when size_ > 0
};

}  // namespace stillframe::tf
