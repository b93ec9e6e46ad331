#pragma once

#include <exception>
#include <expected>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <unordered_map>
#include <utility>

#include "scenegraph/executor.h"
#include "scenegraph/status.h"
#include "scenegraph/store/object_cache.h"

namespace stillframe::scenegraph {

/// Background work of one layer of which only the latest request counts.
///
/// request(), cancel(), take() and isPending() on one thread (the GUI's); the work runs on the executor, one piece at a
/// time. A newer request replaces one that waits; the result of one that was replaced while it ran is dropped (the work
/// itself may have put it into the cache). A key that failed is remembered and never run again. Destroying a LatestJob
/// does not wait: work under way ends on its own, and wakes nobody.
template <typename Product>
class LatestJob {
 public:
  using Result = std::expected<std::shared_ptr<const Product>, Status>;
  struct Outcome {
    CacheKey key;
    Result result;
  };

  /// `wake` is called from the worker when a result is there to take() (not when submit() ran the work itself); it must
  /// neither wait for the GUI thread nor come back here.
  LatestJob(Executor& executor, std::function<void()> wake) : executor_(executor), state_(std::make_shared<State>()) {
    state_->wake = std::move(wake);
  }
  ~LatestJob() {
    const std::scoped_lock lock(state_->mutex);
    state_->wake = nullptr;
    state_->wanted.reset();
    state_->queued.reset();
  }
  LatestJob(const LatestJob&) = delete;
  LatestJob& operator=(const LatestJob&) = delete;

  /// Wants `work`'s result under `key`; nothing new when that is under way already. `work` owns all that it touches.
  void request(const CacheKey& key, std::function<Result()> work) {
    {
      const std::scoped_lock lock(state_->mutex);
      if (state_->wanted == key) {
        return;
      }
      state_->wanted = key;
      state_->finished.reset();
      state_->queued.reset();
      if (const auto failed = state_->failed.find(key); failed != state_->failed.end()) {
        state_->finished = Outcome{key, std::unexpected(failed->second)};
        return;
      }
      state_->queued = Work{key, std::move(work)};
      if (std::exchange(state_->is_running, true)) {
        return;
      }
    }
    executor_.submit([state = state_, requester = std::this_thread::get_id(), executor = &executor_.backing()] {
      run(*state, requester, *executor);
    });
  }
  /// Wants nothing any more.
  void cancel() {
    const std::scoped_lock lock(state_->mutex);
    state_->wanted.reset();
    state_->finished.reset();
    state_->queued.reset();
  }
  /// The result of the latest request, once; nullopt while it is under way or when there is none.
  [[nodiscard]] std::optional<Outcome> take() {
    const std::scoped_lock lock(state_->mutex);
    if (state_->finished) {
      state_->wanted.reset();
    }
    return std::exchange(state_->finished, std::nullopt);
  }
  [[nodiscard]] bool isPending() const {
    const std::scoped_lock lock(state_->mutex);
    return state_->wanted.has_value();
  }

 private:
  struct Work {
    CacheKey key;
    std::function<Result()> run;
  };
  struct State {
    std::mutex mutex;  // guards everything below
    std::function<void()> wake;
    std::optional<CacheKey> wanted;
    std::optional<Work> queued;
    std::optional<Outcome> finished;
    std::unordered_map<CacheKey, Status, CacheKeyHash> failed;
    bool is_running = false;
  };

  static Result runOne(const Work& work) {
    try {
      return work.run();
    } catch (const std::exception& error) {
      return std::unexpected(
          Status{StatusLevel::Error, "ConversionFailed", std::string("the conversion gave up: ") + error.what()});
    }
  }
  static void run(State& state, std::thread::id requester, Executor& executor) {
    std::unique_lock lock(state.mutex);
    while (state.queued) {
      std::optional<Work> work = std::exchange(state.queued, std::nullopt);
      const CacheKey key = work->key;
      lock.unlock();
      Result result = runOne(*work);
      lock.lock();
      if (!result) {
        state.failed.insert_or_assign(key, result.error());
      }
      if (state.wanted == key) {
        state.finished = Outcome{key, std::move(result)};
        if (state.wake && std::this_thread::get_id() != requester) {
          state.wake();  // under the lock: the destructor waits for it, so that it never reaches a view that is gone
        }
      }
      lock.unlock();
      // What it holds may be much memory, and giving that back takes long: after all that waits to be made.
      executor.submit([rest = std::make_shared<const Work>(*std::exchange(work, std::nullopt))] {});
      lock.lock();
    }
    state.is_running = false;
  }

  Executor& executor_;
  std::shared_ptr<State> state_;
};

}  // namespace stillframe::scenegraph
