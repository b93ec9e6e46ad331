#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "scenegraph/executor.h"
#include "scenegraph/store/object_cache.h"

namespace stillframe::scenegraph {

/// Work that somebody will probably want soon, done in the time that an executor has to spare; the latest request
/// counts. What it makes it puts where others look for it (the cache). Destroying one does not wait.
class ReadAhead {
 public:
  explicit ReadAhead(Executor& executor) : executor_(executor), state_(std::make_shared<State>()) {}
  ~ReadAhead() { state_->forget(); }
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// Wants `work` done under `key`; nothing new when it is the one asked for last. GUI thread.
  void request(const CacheKey& key, std::function<void()> work) {
    {
      const std::scoped_lock lock(state_->mutex);
      if (std::exchange(state_->wanted, key) == key) {
        return;
      }
    }
    executor_.submitSpare([state = state_, key, work = std::move(work)] { state->run(key, work); });
  }

  /// For a worker that needs what is under `key` now: waits while it is being made, and no longer. Copyable; outlives
  /// the ReadAhead.
  [[nodiscard]] std::function<void(const CacheKey&)> waiter() const {
    return [state = state_](const CacheKey& key) { state->waitFor(key); };
  }

 private:
  struct State {
    std::mutex mutex;  // guards everything below
    std::condition_variable done;
    std::optional<CacheKey> wanted;
    std::optional<CacheKey> running;

    void forget() {
      const std::scoped_lock lock(mutex);
      wanted.reset();
    }
    void run(const CacheKey& key, const std::function<void()>& work) {
      {
        const std::scoped_lock lock(mutex);
        if (wanted != key || running) {
          return;
        }
        running = key;
      }
      work();
      {
        const std::scoped_lock lock(mutex);
        running.reset();
      }
      done.notify_all();
    }
    void waitFor(const CacheKey& key) {
      std::unique_lock lock(mutex);
      done.wait(lock, [&] { return running != key; });
    }
  };

  Executor& executor_;
  std::shared_ptr<State> state_;
};

}  // namespace stillframe::scenegraph
