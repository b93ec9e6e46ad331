#include "scenegraph/executor.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

#include "scenegraph/thread_priority.h"

namespace stillframe::scenegraph {
namespace {

class SynchronousExecutor : public Executor {
 public:
  void submit(std::function<void()> job) override { job(); }
  void submitSpare(std::function<void()> /*job*/) override {}
  void drain() override {}
};

class ThreadPoolExecutor : public Executor {
 public:
  explicit ThreadPoolExecutor(unsigned threads) {
    for (unsigned i = 0; i < std::max(threads, 1U); ++i) {
      threads_.emplace_back([this] { work(); });
    }
    threads_.emplace_back([this] { workInSpareTime(); });
  }
  ~ThreadPoolExecutor() override {
    {
      const std::scoped_lock lock(mutex_);
      is_ending_ = true;
    }
    wake_.notify_all();
    spare_wake_.notify_all();
    for (std::thread& thread : threads_) {
      thread.join();
    }
  }
  void submit(std::function<void()> job) override {
    {
      const std::scoped_lock lock(mutex_);
      jobs_.push_back(std::move(job));
      ++unfinished_;
    }
    wake_.notify_one();
  }
  void submitSpare(std::function<void()> job) override {
    {
      const std::scoped_lock lock(mutex_);
      spare_jobs_.push_back(std::move(job));
    }
    spare_wake_.notify_one();
  }
  void drain() override {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return unfinished_ == 0; });
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      wake_.wait(lock, [this] { return is_ending_ || !jobs_.empty(); });
      if (jobs_.empty()) {
        return;
      }
      std::function<void()> job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      job();
      job = nullptr;  // what the job owned goes before drain() returns
      lock.lock();
      if (--unfinished_ == 0) {
        idle_.notify_all();
        spare_wake_.notify_one();
      }
    }
  }

  void workInSpareTime() {
    standBack(StandBack::Spare);
    std::unique_lock lock(mutex_);
    while (true) {
      spare_wake_.wait(lock, [this] { return is_ending_ || (!spare_jobs_.empty() && unfinished_ == 0); });
      if (is_ending_) {
        return;
      }
      std::function<void()> job = std::move(spare_jobs_.front());
      spare_jobs_.pop_front();
      lock.unlock();
      job();
      job = nullptr;
      lock.lock();
    }
  }

  std::mutex mutex_;  // guards jobs_, spare_jobs_, unfinished_, is_ending_
  std::condition_variable wake_;
  std::condition_variable spare_wake_;
  std::condition_variable idle_;
  std::deque<std::function<void()>> jobs_;
  std::deque<std::function<void()>> spare_jobs_;
  std::size_t unfinished_ = 0;
  bool is_ending_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace

std::unique_ptr<Executor> makeSynchronousExecutor() { return std::make_unique<SynchronousExecutor>(); }

std::unique_ptr<Executor> makeThreadPoolExecutor(unsigned threads) {
  return std::make_unique<ThreadPoolExecutor>(threads);
}

}  // namespace stillframe::scenegraph
