#pragma once

#include <cstddef>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "scenegraph/thread_priority.h"

namespace stillframe::scenegraph {

/// `task(number)` for all numbers below `count`, in parallel, where nobody draws: who draws points, in an arena of the
/// highest priority, gets the threads that help here as soon as they have done their task. So a task is to take less
/// than a millisecond. For workers; returns when all are done. A worker that stands back does them all by itself, and
/// gives way between them.
template <typename Task>
void runInBackground(std::size_t count, const Task& task) {
  if (count <= 1 || standsBack()) {
    for (std::size_t number = 0; number < count; ++number) {
      giveWay();
      task(number);
    }
    return;
  }
  tbb::task_arena arena(tbb::task_arena::automatic, 1, tbb::task_arena::priority::low);
  arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, task); });
}

}  // namespace stillframe::scenegraph
