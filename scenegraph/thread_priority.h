#pragma once

#include <sys/resource.h>
#include <unistd.h>

namespace stillframe::scenegraph {

namespace detail {
inline thread_local bool stands_back = false;
}

/// How far a thread stands back behind those that draw and that fetch what is wanted now, where all want a core: in
/// units of nice (POSIX), of which ten leave a ninth of a core.
enum class StandBack { Loading = 10, Spare = 19 };

/// Whether the calling thread stands back. What it has to do it does by itself: threads that help would not.
[[nodiscard]] inline bool standsBack() noexcept { return detail::stands_back; }

/// Lets the calling thread stand back until it ends; on Linux it alone, not its process. It has no way back without
/// privileges, so it is for threads that do nothing else.
inline void standBack(StandBack how) noexcept {
  detail::stands_back = true;
  static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), static_cast<int>(how)));
}

}  // namespace stillframe::scenegraph
