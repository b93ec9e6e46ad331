#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "scenegraph/executor.h"
#include "scenegraph/store/object_cache.h"

namespace stillframe::scenegraph {

/// The place that the step from `before` to `place` leads to next; a jump leads to the neighbour in its direction.
[[nodiscard]] constexpr std::int64_t placeAhead(std::int64_t before, std::int64_t place) noexcept {
  constexpr std::int64_t kLongestStep = 32;
  const std::int64_t way = place - before;
  const bool is_step = way != 0 && way >= -kLongestStep && way <= kLongestStep;
  return place + (is_step ? way : way < 0 ? -1 : 1);
}

/// Work that somebody will probably want soon, done in the time that an executor has to spare; of several requests that
/// wait the latest counts. What is made goes to where others look for it (the cache). Destroying one does not wait.
class ReadAhead {
 public:
  explicit ReadAhead(Executor& executor) : executor_(executor), state_(std::make_shared<State>()) {}
  ~ReadAhead() { forget(); }
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
    executor_.submitSpare([state = state_, key, work = std::move(work)] {
      {
        const std::scoped_lock lock(state->mutex);
        if (state->wanted != key) {
          return;
        }
      }
      work();
    });
  }
  /// Wants nothing any more; what is under way ends on its own. GUI thread.
  void forget() {
    const std::scoped_lock lock(state_->mutex);
    state_->wanted.reset();
  }

 private:
  struct State {
    std::mutex mutex;  // guards wanted
    std::optional<CacheKey> wanted;
  };

  Executor& executor_;
  std::shared_ptr<State> state_;
};

}  // namespace stillframe::scenegraph
