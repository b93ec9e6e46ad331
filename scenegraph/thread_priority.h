#pragma once

#include <sys/resource.h>
#include <unistd.h>

namespace stillframe::scenegraph {

inline constexpr int kBehindThePicture = 5;  ///< gets a third of what a thread that draws gets, where cores are few
inline constexpr int kSpareTime = 19;        ///< the lowest there is

/// Lets this thread, and it alone, stand back behind the others: `nice` as in setpriority(). For threads that only do
/// background work: what was given away cannot be taken back.
inline void standBack(int nice) noexcept { (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), nice); }

}  // namespace stillframe::scenegraph
