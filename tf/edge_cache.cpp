#include "tf/edge_cache.h"

#include <utility>

namespace stillframe::tf {

std::size_t EdgeCache::guessByDirectory(std::int64_t stamp) const noexcept {
  const std::vector<std::int64_t>& firsts = directory_->firsts;
  // The last entry at or before the stamp, without a branch to mispredict.
  std::size_t entry = 0;
  for (std::size_t count = firsts.size(); count > 1; count -= count / 2) {
    entry += firsts[entry + count / 2] <= stamp ? count / 2 : 0;
  }
  const std::size_t first_block = entry * kDirectoryStep;
  const bool is_last = entry + 1 == firsts.size();
  const std::int64_t from = firsts[entry];
  const std::int64_t to = is_last ? last_ : firsts[entry + 1];
  if (stamp <= from || stamp >= to) {
    return stamp <= from ? std::min(first_block, blocks_.size() - 1) : blocks_.size() - 1;
  }
  const std::size_t blocks = is_last ? blocks_.size() - std::min(first_block, blocks_.size() - 1) : kDirectoryStep;
  const double place = halfSpan(from, stamp) / std::max(halfSpan(from, to), 1.0) * static_cast<double>(blocks);
  return std::min(first_block + static_cast<std::size_t>(place), blocks_.size() - 1);
}

/// Gallops from the guess, then halves. Needs first_ <= stamp.
std::size_t EdgeCache::searchBlock(std::size_t guess, std::int64_t stamp) const noexcept {
  // Invariant: blocks_[low].first <= stamp < blocks_[high].first, with the end standing for infinity.
  std::size_t low = 0;
  std::size_t high = blocks_.size();
  if (blocks_[guess].first <= stamp) {
    low = guess;
    for (std::size_t step = 1; low + step < high; step *= 2) {
      if (blocks_[low + step].first > stamp) {
        high = low + step;
        break;
      }
      low += step;
    }
  } else {
    high = guess;
    for (std::size_t step = 1; step < high; step *= 2) {
      if (blocks_[high - step].first <= stamp) {
        low = high - step;
        break;
      }
      high -= step;
    }
  }
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (blocks_[middle].first <= stamp ? low : high) = middle;
  }
  return low;
}

/// The neighbours of the guess first, then all. Needs samples[0].stamp_ns <= stamp.
const EdgeCache::Sample* EdgeCache::searchSample(const Probe& probe, std::int64_t stamp) noexcept {
  const Sample* const end = probe.samples + probe.count;
  const Sample* const guess = probe.samples + probe.guess;
  if (guess->stamp_ns > stamp) {
    if ((guess - 1)->stamp_ns <= stamp) {  // the guess is not the first: that one is at or before the stamp
      return guess - 1;
    }
  } else if (guess + 2 == end || (guess + 2)->stamp_ns > stamp) {
    return guess + 1;
  }
  const auto is_later = [](std::int64_t time, const Sample& sample) { return time < sample.stamp_ns; };
  return std::upper_bound(probe.samples, end, stamp, is_later) - 1;
}

void EdgeCache::insert(TimePoint stamp, const RigidTransform& parent_from_child) {
  if (size_ == 0 || stamp.ns > last_) {
    append(stamp, parent_from_child);
  } else {
    insertBetween(stamp, parent_from_child);
  }
}

void EdgeCache::append(TimePoint stamp, const RigidTransform& parent_from_child) {
  const bool starts_block = blocks_.empty() || blocks_.back().samples.size() == kBlockSamples;
  if (starts_block) {
    blocks_.push_back({stamp.ns, {}});
  }
  Block& block = blocks_.back();
  makeRoom(block);
  block.samples.push_back({parent_from_child, stamp.ns});
  first_ = size_ == 0 ? stamp.ns : first_;
  last_ = stamp.ns;
  ++size_;
  if (starts_block) {
    measureRate();
    if (directory_ == nullptr) {
      makeDirectory();
    } else if ((blocks_.size() - 1) % kDirectoryStep == 0) {
      directory_->firsts.push_back(stamp.ns);
    }
  }
}

void EdgeCache::insertBetween(TimePoint stamp, const RigidTransform& parent_from_child) {
  std::size_t block_index = 0;
  if (stamp.ns >= first_) {
    block_index = searchBlock(guessBlockAgain(guessBlock(stamp), stamp), stamp.ns);
  }
  if (blocks_[block_index].samples.size() == kBlockSamples) {
    split(block_index);
    block_index += stamp.ns >= blocks_[block_index + 1].first ? 1 : 0;
  }
  Block& block = blocks_[block_index];
  const auto later = std::upper_bound(block.samples.begin(), block.samples.end(), stamp.ns,
                                      [](std::int64_t time, const Sample& sample) { return time < sample.stamp_ns; });
  const auto position = later - block.samples.begin();
  if (position > 0 && (later - 1)->stamp_ns == stamp.ns) {
    (later - 1)->parent_from_child = parent_from_child;
    return;
  }
  makeRoom(block);
  block.samples.insert(block.samples.begin() + position, {parent_from_child, stamp.ns});
  ++size_;
  block.first = block.samples.front().stamp_ns;
  if (stamp.ns < first_) {
    first_ = stamp.ns;
    measureRate();
  }
}

void EdgeCache::makeRoom(Block& block) const {
  const std::size_t used = block.samples.size();
  if (used < block.samples.capacity()) {
    return;
  }
  // Doubling up to 8, then steps of an eighth of the edge: little slack, and few copies once an edge is long.
  const std::size_t step = used < 8 ? std::max<std::size_t>(used, 1) : std::clamp<std::size_t>(size_ / 64 * 8, 8, 64);
  const bool at_end = &block == &blocks_.back();
  block.samples.reserve(std::min(used + (at_end ? step : std::min<std::size_t>(step, 8)), kBlockSamples));
}

void EdgeCache::split(std::size_t block_index) {
  constexpr auto kHalf = static_cast<std::ptrdiff_t>(kBlockSamples / 2);
  const std::vector<Sample> full = std::move(blocks_[block_index].samples);
  blocks_[block_index].samples.assign(full.begin(), full.begin() + kHalf);
  Block high;
  high.samples.assign(full.begin() + kHalf, full.end());
  high.first = high.samples.front().stamp_ns;
  blocks_.insert(blocks_.begin() + static_cast<std::ptrdiff_t>(block_index + 1), std::move(high));
  measureRate();
  constexpr std::size_t kToleratedSplits = 8;
  if (directory_ == nullptr || ++directory_->splits > kToleratedSplits) {
    makeDirectory();
  }
}

EdgeCache EdgeCache::packed() const {
  EdgeCache packed;
  if (empty()) {
    return packed;
  }
  packed.blocks_.reserve((size_ + kBlockSamples - 1) / kBlockSamples);
  std::size_t left = size_;
  visit([&](const Sample& sample) {
    if (packed.blocks_.empty() || packed.blocks_.back().samples.size() == kBlockSamples) {
      packed.blocks_.push_back({sample.stamp_ns, {}});
      packed.blocks_.back().samples.reserve(std::min(left, kBlockSamples));
    }
    packed.blocks_.back().samples.push_back(sample);
    --left;
  });
  packed.size_ = size_;
  packed.first_ = first_;
  packed.last_ = last_;
  packed.measureRate();
  packed.makeDirectory();
  return packed;
}

void EdgeCache::dropBefore(TimePoint cutoff) {
  if (size_ == 0 || first_ >= cutoff.ns) {
    return;
  }
  std::size_t whole = 0;
  while (whole < blocks_.size() && blocks_[whole].samples.back().stamp_ns < cutoff.ns) {
    size_ -= blocks_[whole].samples.size();
    ++whole;
  }
  blocks_.erase(blocks_.begin(), blocks_.begin() + static_cast<std::ptrdiff_t>(whole));
  if (blocks_.empty()) {
    directory_ = nullptr;
    return;
  }
  Block& block = blocks_.front();
  const auto kept = std::lower_bound(block.samples.begin(), block.samples.end(), cutoff.ns,
                                     [](const Sample& sample, std::int64_t time) { return sample.stamp_ns < time; });
  size_ -= static_cast<std::size_t>(kept - block.samples.begin());
  block.samples.erase(block.samples.begin(), kept);
  block.first = block.samples.front().stamp_ns;
  first_ = block.first;
  measureRate();
  if (whole > 0) {
    makeDirectory();
  }
}

void EdgeCache::measureRate() noexcept {
  const double span = halfSpan(first_, blocks_.back().first);
  blocks_per_half_span_ = static_cast<double>(blocks_.size() - 1) / std::max(span, 1.0);
}

void EdgeCache::makeDirectory() {
  constexpr std::size_t kCachedAnyway = 64;  // blocks
  if (blocks_.size() <= kCachedAnyway) {
    directory_ = nullptr;
    return;
  }
  if (directory_ == nullptr) {
    directory_ = std::make_unique<Directory>();
  }
  directory_->splits = 0;
  directory_->firsts.clear();
  for (std::size_t block = 0; block < blocks_.size(); block += kDirectoryStep) {
    directory_->firsts.push_back(blocks_[block].first);
  }
}

std::size_t EdgeCache::bytes() const noexcept {
  std::size_t total = blocks_.capacity() * sizeof(Block);
  if (directory_ != nullptr) {
    total += sizeof(Directory) + directory_->firsts.capacity() * sizeof(std::int64_t);
  }
  for (const Block& block : blocks_) {
    total += block.samples.capacity() * sizeof(Sample);
  }
  return total;
}

}  // namespace stillframe::tf
