#include "tf/reader_gate.h"

#include <thread>

namespace stillframe::tf {
namespace {

void relax() noexcept {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Polls for some ten microseconds.
template <typename Condition>
bool pollUntil(const Condition& holds) noexcept {
  constexpr int kPolls = 512;
  for (int i = 0; i < kPolls; ++i) {
    if (holds()) {
      return true;
    }
    relax();
  }
  return false;
}

/// Polls, then gives way for a while: with more threads than cores, the one waited for may need this core. False when
/// it is time to sleep.
template <typename Condition>
bool spinUntil(const Condition& holds) noexcept {
  constexpr int kYields = 64;
  if (pollUntil(holds)) {
    return true;
  }
  for (int i = 0; i < kYields; ++i) {
    if (holds()) {
      return true;
    }
    std::this_thread::yield();
  }
  return false;
}

}  // namespace

ReaderGate::Stripe& ReaderGate::ownStripe() noexcept {
  static std::atomic<std::size_t> next_thread{0};
  thread_local const std::size_t stripe = next_thread.fetch_add(1, std::memory_order_relaxed) % kStripes;
  return stripes_[stripe];
}

// Reader and writer each raise their own flag and then look at the other's. With sequential consistency at least one of
// the two sees the other, and the reader is the one that steps back.
void ReaderGate::lock_shared() noexcept {
  std::atomic<std::uint32_t>& readers = ownStripe().readers;
  readers.fetch_add(1);
  if (closed_.load() == 0) {
    return;
  }
  kept_out_.fetch_add(1);
  do {
    unlock_shared();
    waitUntilOpen();
    readers.fetch_add(1);
  } while (closed_.load() != 0);
  kept_out_.fetch_sub(1);
}

void ReaderGate::unlock_shared() noexcept {
  std::atomic<std::uint32_t>& readers = ownStripe().readers;
  readers.fetch_sub(1);
  if (closed_.load() != 0) {
    readers.notify_all();
  }
}

void ReaderGate::waitUntilOpen() noexcept {
  if (!spinUntil([this] { return closed_.load() == 0; })) {
    closed_.wait(1);
  }
}

void ReaderGate::close() noexcept {
  closed_.store(1);
  for (Stripe& stripe : stripes_) {
    if (spinUntil([&stripe] { return stripe.readers.load() == 0; })) {
      continue;
    }
    for (std::uint32_t readers = stripe.readers.load(); readers != 0; readers = stripe.readers.load()) {
      stripe.readers.wait(readers);
    }
  }
}

void ReaderGate::open() noexcept {
  closed_.store(0);
  closed_.notify_all();
}

void ReaderGate::letReadersIn() const noexcept {
  (void)pollUntil([this] { return kept_out_.load() == 0; });  // one that sleeps is not waited for
}

}  // namespace stillframe::tf
