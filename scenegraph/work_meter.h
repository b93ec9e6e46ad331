#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "scenegraph/executor.h"

namespace stillframe::scenegraph {

/// An executor that hands a layer's work on to another, and remembers how long it took. Any thread.
class WorkMeter final : public Executor {
 public:
  /// `inner` outlives this and its work, which may outlive this.
  explicit WorkMeter(Executor& inner) : inner_(inner), last_ns_(std::make_shared<std::atomic<std::int64_t>>(-1)) {}

  void submit(std::function<void()> job) override;
  void submitSpare(std::function<void()> job) override { inner_.submitSpare(std::move(job)); }
  void drain() override { inner_.drain(); }
  [[nodiscard]] Executor& backing() override { return inner_.backing(); }
  /// Of the job that ended last; nullopt before the first has.
  [[nodiscard]] std::optional<double> lastMs() const;

 private:
  Executor& inner_;
  std::shared_ptr<std::atomic<std::int64_t>> last_ns_;  // shared with jobs, which may outlive the layer
};

}  // namespace stillframe::scenegraph
