#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "nodes/join_job.h"
#include "nodes/poses/pose_set.h"
#include "scenegraph/layer.h"

namespace stillframe::nodes {

/// Which of a topic's messages up to some entry are its trail.
struct TrailWindow {
  std::size_t most = 0;             ///< entries, the last one among them
  std::optional<double> seconds{};  ///< before the last one; nullopt: all
};

/// The first poses of a topic's messages, as a path with log times.
struct PoseTrail {
  PoseSet poses;
  std::size_t other_frames = 0;  ///< left out: in another frame than the last message
  std::size_t undecodable = 0;   ///< left out
  bool is_cut = false;           ///< there are more than kMost
  static constexpr std::size_t kMost = 100'000;
};

/// Collects trails off the GUI thread. What was decoded lies in the dataset's cache, so that going on by a message
/// decodes one message. GUI thread only.
class TrailLoader {
 public:
  TrailLoader(const scenegraph::LayerContext& context, std::string topic);

  /// The trail that ends with `last`; nullptr while it is under way.
  [[nodiscard]] std::shared_ptr<const PoseTrail> get(const scenegraph::Entry& last, const TrailWindow& window);
  void cancel() { job_.cancel(); }
  [[nodiscard]] bool isPending() const { return job_.isPending(); }

 private:
  std::shared_ptr<scenegraph::Dataset> dataset_;
  std::string topic_;
  JoinJob<PoseTrail> job_;
};

}  // namespace stillframe::nodes
