#include "scenegraph/latest_job.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <semaphore>
#include <stdexcept>
#include <thread>

#include "scenegraph/work_meter.h"

namespace stillframe::scenegraph {
namespace {

TEST(LatestJob, TellsItsResultBeforeWhatTheWorkHeldIsGivenBack) {
  const auto pool = makeThreadPoolExecutor(1);
  std::binary_semaphore is_told{0};
  std::binary_semaphore is_taken{0};
  std::atomic<bool> was_taken_first = false;
  LatestJob<int> job(*pool, [&] { is_told.release(); });
  std::shared_ptr<void> memory(nullptr,
                               [&](void*) { was_taken_first = is_taken.try_acquire_for(std::chrono::seconds(5)); });
  job.request({1, 2, 3, 4, "a"},
              [memory = std::move(memory)] { return LatestJob<int>::Result(std::make_shared<const int>(1)); });
  is_told.acquire();
  EXPECT_TRUE(job.take());
  is_taken.release();
  pool->drain();
  EXPECT_TRUE(was_taken_first);
}

TEST(LatestJob, TurnsAnExceptionIntoAStatusAndRemembersIt) {
  const auto executor = makeSynchronousExecutor();
  LatestJob<int> job(*executor, {});
  int runs = 0;
  for (int i = 0; i < 2; ++i) {
    job.request(CacheKey{}, [&]() -> LatestJob<int>::Result {
      ++runs;
      throw std::runtime_error("boom");
    });
    const auto outcome = job.take();
    ASSERT_TRUE(outcome);
    EXPECT_EQ(outcome->result.error().code, "ConversionFailed");
  }
  EXPECT_EQ(runs, 1);
}

TEST(LatestJob, OnAPoolOnlyTheLatestResultIsTaken) {
  const auto executor = makeThreadPoolExecutor(2);
  std::atomic<int> wakes = 0;
  LatestJob<int> job(*executor, [&] { ++wakes; });
  CacheKey key;
  for (int i = 1; i <= 200; ++i) {
    key.log_time_ns = i;
    job.request(key, [i] { return std::make_shared<const int>(i); });
  }
  executor->drain();
  const auto outcome = job.take();
  ASSERT_TRUE(outcome);
  EXPECT_EQ(**outcome->result, 200);
  EXPECT_GE(wakes, 1);
  EXPECT_FALSE(job.isPending());
}

/// Work that says when it runs and ends when it is let.
struct Gate {
  std::binary_semaphore is_running{0};
  std::binary_semaphore may_end{0};
  LatestJob<int>::Result pass() {
    is_running.release();
    may_end.acquire();
    return std::make_shared<const int>(7);
  }
};

TEST(LatestJob, MayGoWithTheMeterOfItsLayerWhileTheWorkRuns) {
  const auto pool = makeThreadPoolExecutor(1);
  Gate gate;
  std::atomic<bool> was_let_go = false;
  std::shared_ptr<void> memory(nullptr, [&](void*) { was_let_go = true; });
  {
    auto meter = std::make_unique<WorkMeter>(*pool);
    LatestJob<int> job(*meter, {});
    job.request(CacheKey{}, [&gate, memory = std::move(memory)] { return gate.pass(); });
    gate.is_running.acquire();
  }
  EXPECT_FALSE(was_let_go);
  gate.may_end.release();
  pool->drain();
  EXPECT_TRUE(was_let_go);
}

TEST(WorkMeter, TellsWhatTheWorkTookNotWhatGivingItsMemoryBackTook) {
  const auto pool = makeThreadPoolExecutor(1);
  WorkMeter meter(*pool);
  EXPECT_FALSE(meter.lastMs());
  LatestJob<int> job(meter, {});
  job.request(CacheKey{}, [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return std::make_shared<const int>(7);
  });
  pool->drain();
  ASSERT_TRUE(meter.lastMs());
  EXPECT_GE(*meter.lastMs(), 20.0);
}

}  // namespace
}  // namespace stillframe::scenegraph
