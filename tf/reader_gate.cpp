#include "tf/reader_gate.h"

namespace stillframe::tf {

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
  while (closed_.load() != 0) {
    unlock_shared();
    closed_.wait(1);
    readers.fetch_add(1);
  }
}

void ReaderGate::unlock_shared() noexcept {
  std::atomic<std::uint32_t>& readers = ownStripe().readers;
  readers.fetch_sub(1);
  if (closed_.load() != 0) {
    readers.notify_all();
  }
}

void ReaderGate::close() noexcept {
  closed_.store(1);
  for (Stripe& stripe : stripes_) {
    for (std::uint32_t readers = stripe.readers.load(); readers != 0; readers = stripe.readers.load()) {
      stripe.readers.wait(readers);
    }
  }
}

void ReaderGate::open() noexcept {
  closed_.store(0);
  closed_.notify_all();
}

}  // namespace stillframe::tf
