#pragma once

#include <optional>
#include <string>

#include "nodes/depth_image/depth_frame.h"
#include "nodes/depth_image/topics_in_force.h"
#include "nodes/join_job.h"
#include "scenegraph/layer.h"

namespace stillframe::nodes {

/// The colours registered with a depth image: of the colour images in force at the tick, one of the same frame and
/// size; of several, that whose topic's name is most like the image's. Decoded on a worker. GUI thread.
class ColorJoin {
 public:
  ColorJoin(const scenegraph::LayerContext& context, std::string image_topic);
  /// nullopt while it is under way. Fails with NoColorImage.
  [[nodiscard]] std::optional<JoinJob<ColorFrame>::Result> get(const std::string& frame_id, std::uint32_t width,
                                                               std::uint32_t height, tf::TimePoint time);
  void cancel() { job_.cancel(); }
  [[nodiscard]] bool isPending() const { return job_.isPending(); }

 private:
  std::shared_ptr<scenegraph::Dataset> dataset_;
  std::string image_topic_;
  TopicsInForce topics_;
  JoinJob<ColorFrame> job_;
};

}  // namespace stillframe::nodes
