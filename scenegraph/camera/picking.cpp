#include "scenegraph/camera/picking.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <tuple>

namespace stillframe::scenegraph {

std::optional<ScreenPoint> toScreen(const CameraView& view, const PictureSize& size, const glm::dvec3& point_in_fixed) {
  if (!(size.width_px > 0.0) || !(size.height_px > 0.0)) {
    return std::nullopt;
  }
  const glm::dvec4 point_in_eye = view.eye_from_fixed * glm::dvec4(point_in_fixed, 1.0);
  const double depth = -point_in_eye.z;
  if (!std::isfinite(depth) || (!view.is_orthographic && depth < view.near_m)) {
    return std::nullopt;
  }
  const glm::dvec4 clip = projection(view, size.width_px / size.height_px) * point_in_eye;
  const glm::dvec2 position_px(size.width_px * (0.5 + 0.5 * clip.x / clip.w),
                               size.height_px * (0.5 - 0.5 * clip.y / clip.w));
  if (!std::isfinite(position_px.x) || !std::isfinite(position_px.y)) {
    return std::nullopt;
  }
  return ScreenPoint{position_px, depth};
}

std::optional<FramePick> pickFrame(const FrameGraph& frames, const CameraView& view, const PictureSize& size,
                                   const glm::dvec2& cursor_px, double reach_px) {
  const auto& fixed_from_frames = frames.snapshot().root_from_frame;
  std::optional<FramePick> best;
  tf::FrameId best_frame = tf::kNoFrame;
  for (tf::FrameId frame = 0; frame < fixed_from_frames.size(); ++frame) {
    const auto& fixed_from_frame = fixed_from_frames[frame];
    const auto at = fixed_from_frame ? toScreen(view, size, fixed_from_frame->translation) : std::nullopt;
    if (!at) {
      continue;
    }
    const double distance = glm::length(at->position_px - cursor_px);
    if (distance <= reach_px &&
        (!best || std::tie(distance, at->depth_m) < std::tie(best->distance_px, best->depth_m))) {
      best = FramePick{{}, distance, at->depth_m};
      best_frame = frame;
    }
  }
  if (best) {
    best->frame = frames.buffer().frameName(best_frame);
  }
  return best;
}

}  // namespace stillframe::scenegraph
