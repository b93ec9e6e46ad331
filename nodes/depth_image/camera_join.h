#pragma once

#include <memory>
#include <optional>
#include <string>

#include "nodes/depth_image/depth_frame.h"
#include "nodes/depth_image/topics_in_force.h"
#include "nodes/join_job.h"
#include "scenegraph/layer.h"

namespace stillframe::nodes {

/// The camera of a depth image and the rays of its pixels.
///
/// Of the CameraInfo messages in force (the newest of each topic at or before the tick, never a later one) those in the
/// image's frame; of several, one of the right size, then the one whose topic's name is most like the image's. A named
/// topic is taken as it is, whatever its frame. Decoding and inverting the lens happen on a worker; rays are cached by
/// the intrinsics' values, not by message. GUI thread.
class CameraJoin {
 public:
  struct Wanted {
    std::string frame_id;  ///< without leading slashes
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::string info_topic;                             ///< "auto": by frame
    std::shared_ptr<const scenegraph::CameraInfo> own;  ///< that came with the image; then "auto" is this one
    bool rectify = true;                                ///< take the distortion into account
  };

  CameraJoin(const scenegraph::LayerContext& context, std::string image_topic);
  /// nullopt while it is under way. Fails with NoCameraInfo, CameraInfoMismatch, BadCameraInfo, UnknownDistortion.
  [[nodiscard]] std::optional<JoinJob<CameraRays>::Result> get(const Wanted& wanted, tf::TimePoint time);
  void cancel() { job_.cancel(); }
  [[nodiscard]] bool isPending() const { return job_.isPending(); }
  /// Names of all topics with cameras.
  [[nodiscard]] std::vector<std::string> topicNames() const;

 private:
  std::shared_ptr<scenegraph::Dataset> dataset_;
  std::string image_topic_;
  TopicsInForce topics_;
  JoinJob<CameraRays> job_;
};

}  // namespace stillframe::nodes
