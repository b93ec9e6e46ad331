#include "tf/edge_cache.h"

#include <algorithm>
#include <utility>

#include "tf/sorted_stamps.h"

namespace stillframe::tf {

std::optional<EdgeCache::Cursor> EdgeCache::find(TimePoint time) const noexcept { return find(probeBlock(time), time); }

std::optional<EdgeCache::Cursor> EdgeCache::find(const Probe& probe, TimePoint time) const noexcept {
  if (probe.block_count == 0) {
    return std::nullopt;
  }
  const std::size_t block_index = probe.block_count - 1;
  const Block& block = blocks_[block_index];
  // Near the guess first: the ends of the block are other cache lines.
  std::size_t count = block.stamps.size() + 1;
  if (block.stamps.size() >= kStampWindow) {
    count = countNearGuess(block.stamps, time.ns, block.guess(probe));
  }
  if (count > block.stamps.size()) {
    count = countAtOrBefore(block.stamps, time.ns);
  }
  return Cursor{static_cast<std::uint32_t>(block_index), static_cast<std::uint32_t>(count - 1)};
}

const RigidTransform* EdgeCache::at(TimePoint time) const noexcept {
  const auto cursor = find(time);
  return cursor ? &pose(*cursor) : nullptr;
}

void EdgeCache::prefetchIndex(TimePoint time) const noexcept {
  if (firsts_.size() > 64 && time.ns >= firsts_.front() && time.ns < firsts_.back()) {
    __builtin_prefetch(&firsts_[interpolatedIndex(firsts_.front(), firsts_.back(), firsts_.size() - 1, time.ns)]);
  }
}

EdgeCache::Probe EdgeCache::probeBlock(TimePoint time) const noexcept {
  const std::size_t block_count = countAtOrBefore(firsts_, time.ns);
  if (block_count == 0) {
    return {};
  }
  __builtin_prefetch(&blocks_[block_count - 1]);
  const std::int64_t first = firsts_[block_count - 1];
  const bool last_block = block_count == firsts_.size();
  const std::int64_t next = last_block ? last_ : firsts_[block_count];
  if (time.ns >= next) {
    return {block_count, 1.0};
  }
  return {block_count, secondsBetween(TimePoint{first}, time) / secondsBetween(TimePoint{first}, TimePoint{next})};
}

void EdgeCache::prefetchSample(const Probe& probe) const noexcept {
  if (probe.block_count == 0) {
    return;
  }
  const Block& block = blocks_[probe.block_count - 1];
  const std::size_t guess = block.guess(probe);
  __builtin_prefetch(&block.stamps[guess]);
  __builtin_prefetch(&block.poses[guess]);
  __builtin_prefetch(&block.poses[guess].translation.z);  // a pose may straddle two cache lines
}

void EdgeCache::insert(TimePoint stamp, const RigidTransform& parent_from_child) {
  if (size_ == 0 || stamp.ns > last_) {
    append(stamp, parent_from_child);
  } else {
    insertBetween(stamp, parent_from_child);
  }
}

void EdgeCache::append(TimePoint stamp, const RigidTransform& parent_from_child) {
  if (blocks_.empty() || blocks_.back().stamps.size() == kBlockSamples) {
    blocks_.emplace_back();
    firsts_.push_back(stamp.ns);
  }
  Block& block = blocks_.back();
  makeRoom(block);
  block.stamps.push_back(stamp.ns);
  block.poses.push_back(parent_from_child);
  last_ = stamp.ns;
  ++size_;
}

void EdgeCache::insertBetween(TimePoint stamp, const RigidTransform& parent_from_child) {
  std::size_t block_index = std::max<std::size_t>(countAtOrBefore(firsts_, stamp.ns), 1) - 1;
  if (blocks_[block_index].stamps.size() == kBlockSamples) {
    split(block_index);
    block_index += stamp.ns >= firsts_[block_index + 1] ? 1 : 0;
  }
  Block& block = blocks_[block_index];
  const auto position = static_cast<std::ptrdiff_t>(countAtOrBefore(block.stamps, stamp.ns));
  if (position > 0 && block.stamps[static_cast<std::size_t>(position - 1)] == stamp.ns) {
    block.poses[static_cast<std::size_t>(position - 1)] = parent_from_child;
    return;
  }
  makeRoom(block);
  block.stamps.insert(block.stamps.begin() + position, stamp.ns);
  block.poses.insert(block.poses.begin() + position, parent_from_child);
  firsts_[block_index] = block.stamps.front();
  ++size_;
}

void EdgeCache::makeRoom(Block& block) const {
  const std::size_t used = block.stamps.size();
  if (used < block.stamps.capacity()) {
    return;
  }
  // Doubling up to 8, then steps of an eighth of the edge: little slack, and few copies once an edge is long.
  const std::size_t step = used < 8 ? std::max<std::size_t>(used, 1) : std::clamp<std::size_t>(size_ / 64 * 8, 8, 64);
  const bool at_end = &block == &blocks_.back();
  const std::size_t capacity = std::min(used + (at_end ? step : std::min<std::size_t>(step, 8)), kBlockSamples);
  block.stamps.reserve(capacity);
  block.poses.reserve(capacity);
}

void EdgeCache::split(std::size_t block_index) {
  Block& full = blocks_[block_index];
  constexpr auto kHalf = static_cast<std::ptrdiff_t>(kBlockSamples / 2);
  Block low;
  low.stamps.assign(full.stamps.begin(), full.stamps.begin() + kHalf);
  low.poses.assign(full.poses.begin(), full.poses.begin() + kHalf);
  Block high;
  high.stamps.assign(full.stamps.begin() + kHalf, full.stamps.end());
  high.poses.assign(full.poses.begin() + kHalf, full.poses.end());
  full = std::move(low);
  const std::int64_t high_first = high.stamps.front();
  const auto next = static_cast<std::ptrdiff_t>(block_index + 1);
  blocks_.insert(blocks_.begin() + next, std::move(high));
  firsts_.insert(firsts_.begin() + next, high_first);
}

void EdgeCache::dropBefore(TimePoint cutoff) {
  if (size_ == 0 || firsts_.front() >= cutoff.ns) {
    return;
  }
  std::size_t whole = 0;
  while (whole < blocks_.size() && blocks_[whole].stamps.back() < cutoff.ns) {
    size_ -= blocks_[whole].stamps.size();
    ++whole;
  }
  blocks_.erase(blocks_.begin(), blocks_.begin() + static_cast<std::ptrdiff_t>(whole));
  firsts_.erase(firsts_.begin(), firsts_.begin() + static_cast<std::ptrdiff_t>(whole));
  if (blocks_.empty()) {
    return;
  }
  Block& block = blocks_.front();
  const auto kept = std::lower_bound(block.stamps.begin(), block.stamps.end(), cutoff.ns);
  const auto dropped = kept - block.stamps.begin();
  block.stamps.erase(block.stamps.begin(), kept);
  block.poses.erase(block.poses.begin(), block.poses.begin() + dropped);
  size_ -= static_cast<std::size_t>(dropped);
  firsts_.front() = block.stamps.front();
}

std::size_t EdgeCache::bytes() const noexcept {
  std::size_t total = firsts_.capacity() * sizeof(firsts_[0]) + blocks_.capacity() * sizeof(Block);
  for (const Block& block : blocks_) {
    total += block.stamps.capacity() * sizeof(block.stamps[0]) + block.poses.capacity() * sizeof(block.poses[0]);
  }
  return total;
}

}  // namespace stillframe::tf
