#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace stillframe::tf {

/// Many readers, one writer; readers touch no cache line of each other.
///
/// A std::shared_mutex makes every reader write one shared counter, so readers on different cores slow each other. Here
/// each thread counts itself in a cache line of its own (shared only past kStripes threads), and a writer asks all of
/// them to leave. A waiting writer goes first; it should hold the gate for microseconds, as who waits here spins for
/// some tens of them before it sleeps: to sleep and be woken costs more than most lookups. Any thread may use it:
/// lock_shared() and unlock_shared() in one thread, not nested; the rest under the caller's own mutex, by one writer at
/// a time.
class ReaderGate {
 public:
  void lock_shared() noexcept;    // NOLINT(readability-identifier-naming): for std::shared_lock
  void unlock_shared() noexcept;  // NOLINT(readability-identifier-naming): for std::shared_lock
  /// Keeps new readers out and waits until the last has left.
  void close() noexcept;
  void open() noexcept;
  /// With the gate open: waits a moment, if need be, until those whom it kept out are in. A writer that closes it again
  /// and again calls this in between, or they would hardly ever find it open.
  void letReadersIn() const noexcept;

 private:
  static constexpr std::size_t kStripes = 16;
  struct alignas(64) Stripe {
    std::atomic<std::uint32_t> readers{0};
  };
  [[nodiscard]] Stripe& ownStripe() noexcept;
  void waitUntilOpen() noexcept;

  std::array<Stripe, kStripes> stripes_;
  alignas(64) std::atomic<std::uint32_t> closed_{0};
  alignas(64) std::atomic<std::uint32_t> kept_out_{0};  // readers in waitUntilOpen()
};

/// Closes a gate for its life.
class GateClosure {
 public:
  explicit GateClosure(ReaderGate& gate) noexcept : gate_(gate) { gate_.close(); }
  ~GateClosure() { gate_.open(); }
  GateClosure(const GateClosure&) = delete;
  GateClosure& operator=(const GateClosure&) = delete;

 private:
  ReaderGate& gate_;
};

}  // namespace stillframe::tf
