#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "scenegraph/executor.h"
#include "scenegraph/pipeline/offscreen_renderer.h"
#include "scenegraph/scene.h"
#include "tools/cli/cli_error.h"

namespace stillframe::cli {

/// What one position of the slider took.
struct BenchStep {
  double tick_ms = 0.0;      ///< longest that a tick kept the thread of the window
  double stall_ms = 0.0;     ///< longest that a step of a frame did
  double frame_ms = 0.0;     ///< longest frame, from its beginning to its end
  double picture_ms = 0.0;   ///< from the slider to the picture of that instant, or a fair part of its points
  double complete_ms = 0.0;  ///< to all of it
};

/// A view of the clouds of a recording as the window has it, without one: background work on a pool, frames with a
/// budget and in steps, and a loop that sleeps until somebody wakes it. One thread; requester() is for any.
class BenchView {
 public:
  static constexpr double kBudgetMs = 33.0;

  BenchView(std::shared_ptr<scenegraph::Dataset> dataset, std::unique_ptr<scenegraph::OffscreenRenderer> renderer);

  /// Shows this instant, whole. Waits for what is under way, `is_there` to come true too where it is given; 20 s at
  /// most.
  [[nodiscard]] Result<BenchStep> go(tf::TimePoint time, const std::function<bool()>& is_there = {});
  /// Draws a frame of what is there.
  [[nodiscard]] Result<void> draw();
  /// Waits for what is made in spare time.
  void rest();
  /// What each layer says.
  [[nodiscard]] std::vector<std::string> statusCodes() const;
  /// What wakes the loop: something was loaded.
  [[nodiscard]] std::function<void()> requester() const;

 private:
  class Wakes {
   public:
    void wake();
    void wait(std::chrono::steady_clock::time_point until);

   private:
    std::mutex mutex_;  // guards is_awake_
    std::condition_variable waking_;
    bool is_awake_ = false;
  };

  void frameAll();

  std::unique_ptr<scenegraph::OffscreenRenderer> renderer_;
  std::shared_ptr<Wakes> wakes_;
  std::unique_ptr<scenegraph::Executor> executor_;
  scenegraph::Scene scene_;
  scenegraph::CameraView view_;
  bool is_framed_ = false;
};

/// Whether the topic's messages are clouds.
[[nodiscard]] bool isCloud(const scenegraph::ObjectStore& store, scenegraph::TopicId topic);
/// The first instant at which every topic of clouds has a message; nullopt when none ever has.
[[nodiscard]] std::optional<tf::TimePoint> firstCloudInstant(const scenegraph::ObjectStore& store);

}  // namespace stillframe::cli
