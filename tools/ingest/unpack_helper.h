#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "tools/ingest/compression.h"

namespace stillframe::ingest {

/// Packed bytes a window at a time, which stays in the cache of the processor, as what comes out does for its sum: a
/// chunk may be larger than all caches, and the first touch of memory costs more than reading. One thread.
class PackedWindow {
 public:
  static constexpr std::size_t kBytes = std::size_t{256} << 10;

  explicit PackedWindow(const PackedBytes& packed) : packed_(packed) {}
  /// Some of those from `position` on, valid until the next call; none at the end.
  [[nodiscard]] std::span<const std::byte> from(std::size_t position);

 private:
  const PackedBytes& packed_;
  std::vector<std::byte> bytes_;
};

/// A thread beside the one that unpacks: keeps some windows of packed bytes ready, has the system lay the memory that
/// is written next, and hands on what was made, a piece after the other. It has the priority of who starts it.
///
/// What it takes off is reading, clearing of pages and sums: a sixth of the time that unpacking takes without it. 2
/// MiB.
class UnpackHelper {
 public:
  /// `out` has room for all that is made. nullptr where the system has no thread left.
  [[nodiscard]] static std::unique_ptr<UnpackHelper> start(const PackedBytes& packed,
                                                           const std::function<void(std::span<const std::byte>)>& made,
                                                           std::span<std::byte> out);
  /// Returns when all was handed on.
  ~UnpackHelper();
  UnpackHelper(const UnpackHelper&) = delete;
  UnpackHelper& operator=(const UnpackHelper&) = delete;

  /// As PackedWindow has it; positions only grow. Waits for the disk where it must.
  [[nodiscard]] std::span<const std::byte> from(std::size_t position);
  /// So many bytes of `out` are there now.
  void made(std::size_t bytes);

 private:
  static constexpr std::size_t kWindows = 8;

  struct Filled {
    std::vector<std::byte> bytes;
    std::size_t position = 0;
    std::size_t size = 0;
    [[nodiscard]] std::size_t end() const noexcept { return position + size; }
  };

  UnpackHelper(const PackedBytes& packed, const std::function<void(std::span<const std::byte>)>& made,
               std::span<std::byte> out);
  void work();
  void fill(std::unique_lock<std::mutex>& lock);
  void populate(std::unique_lock<std::mutex>& lock);
  void handOn(std::unique_lock<std::mutex>& lock);

  const PackedBytes& packed_;
  const std::function<void(std::span<const std::byte>)>& hand_on_;
  std::span<std::byte> out_;
  std::mutex mutex_;  // guards what follows; a window that is being filled is the thread's alone
  std::condition_variable wake_;
  std::array<Filled, kWindows> windows_;
  std::size_t filled_ = 0;  // windows so far
  std::size_t taken_ = 0;
  std::size_t read_ = 0;  // bytes
  std::size_t made_ = 0;
  std::size_t populated_ = 0;
  std::size_t handed_on_ = 0;
  bool is_at_end_ = false;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace stillframe::ingest
