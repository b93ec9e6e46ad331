#pragma once

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>

namespace stillframe::scenegraph {

/// How far a thread stands back behind those that draw and that fetch what is wanted now, where all want a core: in
/// units of nice (POSIX), of which ten leave a ninth of a core.
enum class StandBack { Loading = 10, Spare = 19 };

namespace detail {

struct Precedences {
  std::mutex mutex;
  std::condition_variable over;
  std::atomic<int> count = 0;
  std::atomic<int> of_window = 0;  // among them
};
[[nodiscard]] inline Precedences& precedences() noexcept {
  static Precedences all;
  return all;
}
struct Errand {
  const std::atomic<bool>& is_awaited;
  const Errand* outer;  // in which this is one step
};
inline thread_local const Errand* errand = nullptr;
[[nodiscard]] inline bool isAwaited() noexcept {
  const Errand* at = errand;
  while (at != nullptr && !at->is_awaited) {
    at = at->outer;
  }
  return at != nullptr;
}
inline thread_local bool stands_back = false;
// Times as long as it worked that a thread waits: with more, what is read ahead is not there when it is wanted.
inline constexpr int kLoading = 2;
inline constexpr int kSpare = 1;
inline constexpr std::chrono::steady_clock::duration kLongestPause = std::chrono::milliseconds(30);
inline thread_local int patience = 0;
inline thread_local std::chrono::steady_clock::time_point resumed;
inline thread_local std::chrono::steady_clock::duration
    saved{};  // worked, and not yet paused for by the window's steps

}  // namespace detail

/// Whether the calling thread stands back. What it has to do it does by itself: threads that help would not.
[[nodiscard]] inline bool standsBack() noexcept { return detail::stands_back; }

/// Whether it does what is not wanted yet, and may never be.
[[nodiscard]] inline bool isSpare() noexcept { return detail::stands_back && detail::patience == detail::kSpare; }

/// Lets the calling thread stand back until it ends; on Linux it alone, not its process. It has no way back without
/// privileges, so it is for threads that do nothing else.
inline void standBack(StandBack how) noexcept {
  detail::stands_back = true;
  detail::patience = how == StandBack::Loading ? detail::kLoading : detail::kSpare;
  detail::resumed = std::chrono::steady_clock::now();
  static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), static_cast<int>(how)));
}

/// As long as one lives, threads that stand back pause where they giveWay(). For a frame, or the conversion of what is
/// waited for: the system lets a thread of low priority finish its slice of some milliseconds, and a core that it does
/// not take it slows by the memory that it moves. One of a thread that stands back counts for nothing. Any thread.
class Precedence {
 public:
  enum class Of {
    Work,    ///< shares the cores with those that stand back
    Window,  ///< a step that keeps the window's thread: they pause for all of it, where they do not starve by that
  };

  explicit Precedence(Of what = Of::Work) noexcept : counts_(!standsBack()), of_window_(what == Of::Window) {
    if (counts_) {
      ++detail::precedences().count;
      detail::precedences().of_window += of_window_ ? 1 : 0;
    }
  }
  ~Precedence() {
    if (!counts_) {
      return;
    }
    auto& all = detail::precedences();
    const bool is_last_of_window = of_window_ && --all.of_window == 0;
    if (--all.count == 0 || is_last_of_window) {
      const std::scoped_lock lock(all.mutex);
      all.over.notify_all();
    }
  }
  Precedence(const Precedence&) = delete;
  Precedence& operator=(const Precedence&) = delete;

 private:
  bool counts_;
  bool of_window_;
};

/// What the calling thread does from here to the end of this, which others may come to wait for: once `is_awaited`, it
/// pauses no more. Errands nest.
class Errand {
 public:
  explicit Errand(const std::atomic<bool>& is_awaited) noexcept : errand_{is_awaited, detail::errand} {
    detail::errand = &errand_;
  }
  ~Errand() { detail::errand = errand_.outer; }
  Errand(const Errand&) = delete;
  Errand& operator=(const Errand&) = delete;

 private:
  detail::Errand errand_;
};

/// Before waiting for an errand of another thread: it is awaited now, unless the caller stands back and nobody waits
/// for it either. Any thread.
inline void await(std::atomic<bool>& is_awaited) {
  if (standsBack() && !detail::isAwaited()) {
    return;
  }
  is_awaited = true;
  const std::scoped_lock lock(detail::precedences().mutex);
  detail::precedences().over.notify_all();
}

/// Pauses a thread that stands back while somebody has precedence: as long as it worked since it last paused, twice as
/// long where it loads, so that both go on; for a step of the window's thread once more what it worked since the last
/// of these. 30 ms at most, and never in an errand that is awaited. Nothing for other threads. For work that takes
/// long, every fraction of a millisecond; not with a lock held that others want.
inline void giveWay() {
  using std::chrono::steady_clock;
  auto& all = detail::precedences();
  if (!standsBack() || all.count == 0 || detail::isAwaited()) {
    return;
  }
  const steady_clock::time_point begun = steady_clock::now();
  const steady_clock::duration worked = std::min(begun - detail::resumed, detail::kLongestPause);
  detail::saved = std::min(detail::saved + worked, detail::kLongestPause);
  const bool is_of_window = all.of_window > 0;
  const steady_clock::duration share = worked * detail::patience;
  const steady_clock::duration pause = is_of_window ? std::max(share, detail::saved) : share;
  {
    std::unique_lock lock(all.mutex);
    all.over.wait_for(lock, std::min(pause, detail::kLongestPause),
                      [&] { return all.count == 0 || (is_of_window && all.of_window == 0) || detail::isAwaited(); });
  }
  detail::resumed = steady_clock::now();
  if (is_of_window) {
    detail::saved -= std::min(detail::resumed - begun, detail::saved);
  }
}

}  // namespace stillframe::scenegraph
