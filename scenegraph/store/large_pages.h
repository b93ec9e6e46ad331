#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>

namespace stillframe::scenegraph {

/// Asks the system to lay a block that nobody has written to yet on large pages, where it is large enough for that to
/// tell: with small ones the first touch, one fault every 4 KiB, can take many times what is done with the bytes, and
/// so can giving them back. Any thread; a system that has none goes on as ever.
inline void useLargePages(void* block, std::size_t bytes) noexcept {
  constexpr std::size_t kTells = std::size_t{4} << 20;
  if (bytes < kTells) {
    return;
  }
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const std::uintptr_t begin = (reinterpret_cast<std::uintptr_t>(block) + page - 1) / page * page;
  const std::uintptr_t end = (reinterpret_cast<std::uintptr_t>(block) + bytes) / page * page;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): rounded to whole pages
  (void)::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

/// Gives the whole pages within a block back to the system, piece by piece: giving back all of a large one at once
/// keeps every thread that wants memory waiting, 17 ms for 220 MB. What the block holds is lost; it is to be freed
/// next.
inline void releasePages(void* block, std::size_t bytes) noexcept {
  constexpr std::uintptr_t kPiece = std::uintptr_t{2} << 20;
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const std::uintptr_t end = (reinterpret_cast<std::uintptr_t>(block) + bytes) / page * page;
  for (std::uintptr_t at = (reinterpret_cast<std::uintptr_t>(block) + page - 1) / page * page; at < end; at += kPiece) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): rounded to whole pages
    (void)::madvise(reinterpret_cast<void*>(at), end - at < kPiece ? end - at : kPiece, MADV_DONTNEED);
  }
}

/// Has the system lay the whole pages within a block, which hold nothing yet or what they hold: who writes to them
/// then need not wait for that. Any thread, beside who writes. A system that does not know how leaves it to the writer.
inline void populatePages(void* block, std::size_t bytes) noexcept {
#ifdef MADV_POPULATE_WRITE
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const std::uintptr_t begin = (reinterpret_cast<std::uintptr_t>(block) + page - 1) / page * page;
  const std::uintptr_t end = (reinterpret_cast<std::uintptr_t>(block) + bytes) / page * page;
  if (begin < end) {
    // NOLINTNEXTLINE(performance-no-int-to-ptr): rounded to whole pages
    (void)::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_POPULATE_WRITE);
  }
#else
  (void)block;
  (void)bytes;
#endif
}

}  // namespace stillframe::scenegraph
