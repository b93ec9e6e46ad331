#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::tf {

/// Samples of one parent->child edge, answered by zero-order hold.
///
/// Sorted by stamp in blocks of at most kBlockSamples; a sample fills one cache line, its stamp beside its pose. The
/// block and the place in it are guessed as if the rate were steady and searched for from there: two or three looks at
/// a steady rate, O(log n) at any other. An insert is O(1) at the end and O(log n + block) anywhere else. 64 bytes a
/// sample, at most an eighth of slack, and half a byte of index. Not thread-safe: TransformBuffer holds the lock.
class EdgeCache {
 public:
  static constexpr std::size_t kBlockSamples = 64;

  struct alignas(64) Sample {
    RigidTransform parent_from_child;
    std::int64_t stamp_ns = 0;
  };
  static_assert(sizeof(Sample) == 64);

  /// Sample in force at `time`, or nullptr when `time` precedes every stamp. Valid until the next change.
  [[nodiscard]] const Sample* find(TimePoint time) const noexcept {
    return find(probe(guessBlockAgain(guessBlock(time), time), time), time);
  }
  /// A search in four steps, for many edges at once: each step prefetches what the next one reads.
  struct Probe {
    const Sample* samples = nullptr;  ///< of the block in which the time lies; nullptr before the first stamp
    std::uint32_t count = 0;          ///< of those samples
    std::uint32_t guess = 0;          ///< where among them the time lies at a steady rate
  };
  [[nodiscard]] std::size_t guessBlock(TimePoint time) const noexcept;
  [[nodiscard]] std::size_t guessBlockAgain(std::size_t guess, TimePoint time) const noexcept;
  [[nodiscard]] Probe probe(std::size_t block_guess, TimePoint time) const noexcept;
  static void prefetchSample(const Probe& probe) noexcept;
  [[nodiscard]] static const Sample* find(const Probe& probe, TimePoint time) noexcept;

  /// Adds a sample or replaces the one of the same stamp.
  void insert(TimePoint stamp, const RigidTransform& parent_from_child);
  /// Drops every sample before `cutoff`.
  void dropBefore(TimePoint cutoff);
  /// Whether samples came so far out of order that an eighth of the blocks could be spared.
  [[nodiscard]] bool isLoose() const noexcept {
    return blocks_.size() > 1 && 8 * (blocks_.size() - 1) * kBlockSamples > 9 * size_;
  }
  /// The same samples in full blocks, as if they had come in order: a steady rate is guessed right again. O(n).
  [[nodiscard]] EdgeCache packed() const;

  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// First and newest stamp; only when not empty.
  [[nodiscard]] TimePoint first() const noexcept { return {first_}; }
  [[nodiscard]] TimePoint last() const noexcept { return {last_}; }
  /// Calls `visitor` with every sample, oldest first.
  template <typename Visitor>
  void visit(const Visitor& visitor) const {
    for (const Block& block : blocks_) {
      for (const Sample& sample : block.samples) {
        visitor(sample);
      }
    }
  }
  /// The first sample; only when not empty.
  [[nodiscard]] const Sample& front() const noexcept { return blocks_.front().samples.front(); }
  /// Heap bytes held, capacity included.
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct Block {
    std::int64_t first = 0;  // stamp of the first sample
    std::vector<Sample> samples;
  };

  /// (to - from) / 2 for from <= to: the difference of two int64 may need 64 bits, half of it converts to double in one
  /// instruction.
  [[nodiscard]] static double halfSpan(std::int64_t from, std::int64_t to) noexcept {
    const std::uint64_t span = static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
    return static_cast<double>(static_cast<std::int64_t>(span >> 1));
  }
  [[nodiscard]] bool isInBlock(std::size_t block, std::int64_t stamp) const noexcept {
    return blocks_[block].first <= stamp && (block + 1 == blocks_.size() || stamp < blocks_[block + 1].first);
  }
  /// A guess by the directory, for where the rate was not steady. Needs first_ <= stamp.
  [[nodiscard]] std::size_t guessByDirectory(std::int64_t stamp) const noexcept;
  [[nodiscard]] std::size_t searchBlock(std::size_t guess, std::int64_t stamp) const noexcept;
  [[nodiscard]] static const Sample* searchSample(const Probe& probe, std::int64_t stamp) noexcept;

  void append(TimePoint stamp, const RigidTransform& parent_from_child);
  void insertBetween(TimePoint stamp, const RigidTransform& parent_from_child);
  void makeRoom(Block& block) const;
  void split(std::size_t block);
  void measureRate() noexcept;
  void makeDirectory();

  std::vector<Block> blocks_;  // none is empty
  std::size_t size_ = 0;
  std::int64_t first_ = 0;  // oldest and newest stamp, when size_ > 0
  std::int64_t last_ = 0;
  double blocks_per_half_span_ = 0.0;  // blocks per 2 ns, for guessBlock()

  /// First stamp of every kDirectoryStep-th block; off by the few blocks that were split since it was made.
  struct Directory {
    std::vector<std::int64_t> firsts;
    std::size_t splits = 0;
  };
  static constexpr std::size_t kDirectoryStep = 16;
  std::unique_ptr<Directory> directory_;  // for many blocks only
};

inline std::size_t EdgeCache::guessBlock(TimePoint time) const noexcept {
  if (blocks_.size() < 2 || time.ns < first_) {
    return 0;
  }
  const double place = halfSpan(first_, time.ns) * blocks_per_half_span_;
  const double last_place = static_cast<double>(static_cast<std::int64_t>(blocks_.size() - 1));
  const auto guess = static_cast<std::int64_t>(std::min(place, last_place));
  __builtin_prefetch(&blocks_[static_cast<std::size_t>(guess)]);
  __builtin_prefetch(&blocks_[static_cast<std::size_t>(guess)] + 1);  // past the end at worst: no harm in a prefetch
  return static_cast<std::size_t>(guess);
}

inline std::size_t EdgeCache::guessBlockAgain(std::size_t guess, TimePoint time) const noexcept {
  if (directory_ == nullptr || time.ns < first_ || isInBlock(guess, time.ns)) {
    return guess;
  }
  const std::size_t again = guessByDirectory(time.ns);
  __builtin_prefetch(&blocks_[again]);
  __builtin_prefetch(&blocks_[again] + 1);
  return again;
}

inline EdgeCache::Probe EdgeCache::probe(std::size_t block_guess, TimePoint time) const noexcept {
  if (size_ == 0 || time.ns < first_) {
    return {};
  }
  const std::size_t index = isInBlock(block_guess, time.ns) ? block_guess : searchBlock(block_guess, time.ns);
  const Block& block = blocks_[index];
  const bool is_last = index + 1 == blocks_.size();
  const auto last_place = static_cast<std::int64_t>(block.samples.size() - 1);
  // A block ends where the next begins, the last one at its last sample.
  const double span = halfSpan(block.first, is_last ? last_ : blocks_[index + 1].first);
  const double steps = static_cast<double>(is_last ? last_place : last_place + 1);
  const double place = halfSpan(block.first, time.ns) * steps / std::max(span, 1.0);
  const auto guess = static_cast<std::int64_t>(std::min(place, static_cast<double>(last_place)));
  return {block.samples.data(), static_cast<std::uint32_t>(last_place + 1), static_cast<std::uint32_t>(guess)};
}

inline void EdgeCache::prefetchSample(const Probe& probe) noexcept {
  if (probe.samples != nullptr) {
    __builtin_prefetch(probe.samples + probe.guess);
    __builtin_prefetch(probe.samples + probe.guess + 1);
  }
}

inline const EdgeCache::Sample* EdgeCache::find(const Probe& probe, TimePoint time) noexcept {
  if (probe.samples == nullptr) {
    return nullptr;
  }
  const Sample* guess = probe.samples + probe.guess;
  const bool right = guess->stamp_ns <= time.ns && (probe.guess + 1 == probe.count || time.ns < (guess + 1)->stamp_ns);
  return right ? guess : searchSample(probe, time.ns);
}

}  // namespace stillframe::tf
