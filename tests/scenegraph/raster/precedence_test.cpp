// Who pauses for whom, and for how long: on a machine that has nothing else to do.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <semaphore>
#include <thread>
#include <utility>

#include "scenegraph/stopwatch.h"
#include "scenegraph/thread_priority.h"

namespace stillframe::scenegraph {
namespace {

/// How long a thread that stands back pauses, milliseconds, after it worked so long.
double pauseMs(StandBack how, std::chrono::milliseconds worked) {
  double paused_ms = 0.0;
  std::thread([&] {
    standBack(how);
    std::this_thread::sleep_for(worked);
    const auto start = std::chrono::steady_clock::now();
    giveWay();
    paused_ms = millisecondsSince(start);
  }).join();
  return paused_ms;
}

TEST(Precedence, PausesThreadsThatStandBackByWhatTheyWorked) {
  const Precedence drawing;
  const double loading_ms = pauseMs(StandBack::Loading, std::chrono::milliseconds(5));
  EXPECT_GE(loading_ms, 9.0) << "twice as long";
  EXPECT_GE(pauseMs(StandBack::Spare, std::chrono::milliseconds(10)), 9.0) << "as long";
  EXPECT_GE(pauseMs(StandBack::Loading, std::chrono::milliseconds(100)), 29.0) << "30 ms at most";
  EXPECT_LT(pauseMs(StandBack::Loading, std::chrono::milliseconds(0)), loading_ms) << "who has not worked goes on";
}

/// Pieces of work that take nothing, by a thread that has saved 30 ms, in a step of the window's that takes 10 ms; and
/// how long the same thread pauses after it.
std::pair<int, double> piecesInAStepOfTheWindow() {
  std::binary_semaphore has_worked{0};
  std::binary_semaphore is_drawing{0};
  std::atomic<int> pieces = 0;
  std::atomic<bool> is_over = false;
  double after_ms = 0.0;
  int in_step = 0;
  std::thread worker([&] {
    standBack(StandBack::Spare);
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    has_worked.release();
    is_drawing.acquire();
    while (!is_over) {
      ++pieces;
      giveWay();
    }
    const auto start = std::chrono::steady_clock::now();
    giveWay();
    after_ms = millisecondsSince(start);
  });
  has_worked.acquire();
  {
    const Precedence drawing(Precedence::Of::Window);
    is_drawing.release();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    in_step = pieces;
    is_over = true;
  }
  worker.join();
  return {in_step, after_ms};
}

TEST(Precedence, OfTheWindowPausesThemForAllOfIt) {
  // A machine that is busy lets such a thread sleep through the step, or a step take longer than a pause may.
  constexpr int kTries = 20;
  bool is_seen = false;
  for (int i = 0; i < kTries && !is_seen; ++i) {
    const auto [pieces, after_ms] = piecesInAStepOfTheWindow();
    is_seen = pieces == 1 && after_ms < 5.0;
  }
  EXPECT_TRUE(is_seen) << "one piece, and none after it though each takes nothing; no pause when the step is over";
}

TEST(Precedence, OfTheWindowStarvesNobody) {
  const Precedence drawing(Precedence::Of::Window);
  int pieces = 0;
  std::thread([&] {
    standBack(StandBack::Spare);
    for (const auto start = std::chrono::steady_clock::now(); millisecondsSince(start) < 200.0; ++pieces) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      giveWay();
    }
  }).join();
  EXPECT_GE(pieces, 20) << "of 1 ms, with as long a pause after each, once what was saved is used up";
}

TEST(Precedence, OfAThreadThatStandsBackCountsForNothing) {
  std::binary_semaphore is_held{0};
  std::binary_semaphore is_over{0};
  std::thread holder([&] {
    standBack(StandBack::Spare);
    const Precedence spare;
    is_held.release();
    is_over.acquire();
  });
  is_held.acquire();
  EXPECT_LT(pauseMs(StandBack::Spare, std::chrono::milliseconds(5)), 20.0);
  is_over.release();
  holder.join();
}

TEST(Precedence, IsNothingToOtherThreads) {
  const auto start = std::chrono::steady_clock::now();
  const Precedence drawing;
  for (int i = 0; i < 1000; ++i) {
    giveWay();  // this thread does not stand back: a thousand pauses would be 30 s
  }
  EXPECT_LT(millisecondsSince(start), 1000.0);
}

}  // namespace
}  // namespace stillframe::scenegraph
