#pragma once

#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "scenegraph/latest_job.h"
#include "scenegraph/layer.h"

namespace stillframe::nodes {

/// A LatestJob that remembers its last outcome, so that asking again for the same key costs a comparison. GUI thread.
template <typename Product>
class JoinJob {
 public:
  using Result = typename scenegraph::LatestJob<Product>::Result;

  explicit JoinJob(const scenegraph::LayerContext& context) : job_(context.executor, context.request_update) {}

  /// The outcome of `work` for `key`; nullopt while it is under way. `work` owns all that it touches.
  [[nodiscard]] std::optional<Result> get(const scenegraph::CacheKey& key, std::function<Result()> work) {
    if (key_ == key) {
      job_.cancel();
      return result_;
    }
    job_.request(key, std::move(work));
    auto outcome = job_.take();
    if (!outcome) {
      return std::nullopt;
    }
    key_ = key;
    result_ = std::move(outcome->result);
    return result_;
  }
  void cancel() { job_.cancel(); }
  [[nodiscard]] bool isPending() const { return job_.isPending(); }

 private:
  scenegraph::LatestJob<Product> job_;
  std::optional<scenegraph::CacheKey> key_;
  std::optional<Result> result_;
};

}  // namespace stillframe::nodes
