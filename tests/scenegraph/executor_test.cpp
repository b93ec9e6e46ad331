#include "scenegraph/executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace stillframe::scenegraph {
namespace {

TEST(SynchronousExecutor, RunsAJobInsideSubmit) {
  const auto executor = makeSynchronousExecutor();
  std::thread::id ran_on;
  executor->submit([&] { ran_on = std::this_thread::get_id(); });
  EXPECT_EQ(ran_on, std::this_thread::get_id());
  executor->drain();
}

TEST(ThreadPoolExecutor, DrainWaitsForAllJobsAndForThoseTheySubmit) {
  const auto executor = makeThreadPoolExecutor(3);
  std::atomic<int> runs = 0;
  for (int i = 0; i < 100; ++i) {
    executor->submit([&] {
      ++runs;
      executor->submit([&] { ++runs; });
    });
  }
  executor->drain();
  EXPECT_EQ(runs, 200);
}

TEST(ThreadPoolExecutor, HasAtLeastOneThreadAndRunsItsQueueToTheEnd) {
  std::atomic<int> runs = 0;
  {
    const auto executor = makeThreadPoolExecutor(0);
    for (int i = 0; i < 50; ++i) {
      executor->submit([&] { ++runs; });
    }
  }
  EXPECT_EQ(runs, 50);
}

TEST(ThreadPoolExecutor, WhatAJobOwnsIsGoneAfterDrain) {
  const auto executor = makeThreadPoolExecutor(1);
  auto owned = std::make_shared<int>(1);
  const std::weak_ptr<int> watched = owned;
  executor->submit([owned = std::move(owned)] { EXPECT_EQ(*owned, 1); });
  executor->drain();
  EXPECT_TRUE(watched.expired());
}

TEST(ThreadPoolExecutor, RunsSpareJobsOnlyWhileThereIsNothingElse) {
  std::mutex mutex;  // guards the rest
  std::condition_variable changed;
  bool may_go = false;
  bool has_spared = false;
  const auto pool = makeThreadPoolExecutor(1);
  pool->submit([&] {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return may_go; });
  });
  pool->submitSpare([&] {
    const std::scoped_lock lock(mutex);
    EXPECT_TRUE(may_go) << "ran beside what is wanted now";
    has_spared = true;
    changed.notify_all();
  });
  {
    const std::scoped_lock lock(mutex);
    may_go = true;
  }
  changed.notify_all();
  std::unique_lock lock(mutex);
  changed.wait(lock, [&] { return has_spared; });
}

}  // namespace
}  // namespace stillframe::scenegraph
