#pragma once

#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

namespace stillframe::scenegraph {

/// A block of bytes that one thread writes, from its beginning on, and others read as far as it is there. Any thread.
class Arrival {
 public:
  /// The block, whole or not, which its owner keeps alive.
  struct Block {
    std::span<const std::byte> bytes;
    std::shared_ptr<const void> owner;
  };

  /// The writer: the block is there, and nothing in it yet.
  void begin(Block block) {
    const std::scoped_lock lock(mutex_);
    if (!is_finished_) {
      block_ = std::move(block);
    }
    grown_.notify_all();
  }
  /// The writer: so many bytes are there.
  void advance(std::size_t bytes) {
    const std::scoped_lock lock(mutex_);
    there_ = bytes;
    grown_.notify_all();
  }
  /// The writer: nothing comes any more. `is_good`: what came is what the block was to be.
  void finish(bool is_good) {
    const std::scoped_lock lock(mutex_);
    is_finished_ = true;
    is_good_ = is_good;
    block_.reset();
    grown_.notify_all();
  }

  /// Waits for the block. nullopt: it has been finished, with or without one.
  [[nodiscard]] std::optional<Block> block() const {
    std::unique_lock lock(mutex_);
    grown_.wait(lock, [this] { return block_ || is_finished_; });
    return block_;
  }
  /// Waits for so many bytes, of which there may be more, and says how many are there; nullopt: they do not come.
  [[nodiscard]] std::optional<std::size_t> wait(std::size_t bytes) const {
    std::unique_lock lock(mutex_);
    grown_.wait(lock, [&] { return there_ >= bytes || is_finished_; });
    return (is_finished_ && !is_good_) || there_ < bytes ? std::nullopt : std::optional(there_);
  }
  /// Waits for the end, and says whether it is a good one.
  [[nodiscard]] bool waitForAll() const {
    std::unique_lock lock(mutex_);
    grown_.wait(lock, [this] { return is_finished_; });
    return is_good_;
  }

 private:
  mutable std::mutex mutex_;  // guards everything below
  mutable std::condition_variable grown_;
  std::optional<Block> block_;
  std::size_t there_ = 0;
  bool is_finished_ = false;
  bool is_good_ = false;
};

}  // namespace stillframe::scenegraph
