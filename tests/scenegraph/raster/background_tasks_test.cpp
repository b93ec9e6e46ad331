#include "scenegraph/raster/background_tasks.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <thread>
#include <vector>

namespace stillframe::scenegraph {
namespace {

TEST(BackgroundTasks, RunOnceEachWhateverTheirNumber) {
  for (const std::size_t count : {0U, 1U, 2U, 1000U}) {
    std::vector<std::atomic<int>> runs(count);
    runInBackground(count, [&](std::size_t number) { ++runs[number]; });
    for (const auto& run : runs) {
      EXPECT_EQ(run, 1) << count;
    }
  }
}

TEST(BackgroundTasks, OfAThreadThatStandsBackTakeNoOther) {
  std::set<std::thread::id> threads;  // only ever by the one: no mutex
  std::thread::id own;
  bool stood_back = true;
  std::thread([&] {
    own = std::this_thread::get_id();
    stood_back = standsBack();
    standBack(StandBack::Spare);
    runInBackground(64, [&](std::size_t) { threads.insert(std::this_thread::get_id()); });
  }).join();
  EXPECT_FALSE(stood_back) << "unasked";
  EXPECT_EQ(threads, std::set{own});
  EXPECT_FALSE(standsBack()) << "nobody but that thread";
}

}  // namespace
}  // namespace stillframe::scenegraph
