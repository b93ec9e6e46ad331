#include "scenegraph/camera/picking.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
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

std::optional<std::pair<glm::dvec2, glm::dvec2>> toScreen(const CameraView& view, const PictureSize& size,
                                                          const glm::dvec3& from_in_fixed,
                                                          const glm::dvec3& to_in_fixed) {
  glm::dvec3 from(view.eye_from_fixed * glm::dvec4(from_in_fixed, 1.0));
  glm::dvec3 to(view.eye_from_fixed * glm::dvec4(to_in_fixed, 1.0));
  if (!view.is_orthographic) {
    // A little farther than the near plane, where rounding cannot put it before.
    const double near = view.near_m * (1.0 + 1e-9);
    if (!(-from.z >= near || -to.z >= near)) {
      return std::nullopt;
    }
    const auto cut = [&](glm::dvec3& end, const glm::dvec3& other) {
      if (-end.z < near) {
        end += (other - end) * ((near + end.z) / (end.z - other.z));
      }
    };
    cut(from, to);
    cut(to, from);
  }
  CameraView at_eye = view;
  at_eye.eye_from_fixed = glm::dmat4(1.0);
  const auto start = toScreen(at_eye, size, from);
  const auto end = toScreen(at_eye, size, to);
  return start && end ? std::optional(std::pair(start->position_px, end->position_px)) : std::nullopt;
}

std::optional<SightLine> sightLine(const CameraView& view, const PictureSize& size, const glm::dvec2& position_px) {
  if (!(size.width_px > 0.0) || !(size.height_px > 0.0)) {
    return std::nullopt;
  }
  const glm::dmat4 clip_from_eye = projection(view, size.width_px / size.height_px);
  const glm::dmat4 fixed_from_eye = glm::inverse(view.eye_from_fixed);
  const glm::dvec2 across((2.0 * position_px.x / size.width_px - 1.0) / clip_from_eye[0][0],
                          (1.0 - 2.0 * position_px.y / size.height_px) / clip_from_eye[1][1]);
  const glm::dvec4 origin(view.is_orthographic ? across : glm::dvec2(0.0), 0.0, 1.0);
  const glm::dvec4 direction(view.is_orthographic ? glm::dvec2(0.0) : across, -1.0, 0.0);
  return SightLine{glm::dvec3(fixed_from_eye * origin), glm::dvec3(fixed_from_eye * direction)};
}

std::vector<FramePick> pickFrames(const tf::TransformBuffer& buffer, const tf::Snapshot& fixed_from_frames,
                                  const CameraView& view, const PictureSize& size, const glm::dvec2& cursor_px,
                                  double reach_px, std::size_t most) {
  struct NearFrame {
    double distance_px = 0.0;
    double depth_m = 0.0;
    tf::FrameId frame = tf::kNoFrame;
  };
  std::vector<NearFrame> near;
  for (tf::FrameId frame = 0; frame < fixed_from_frames.root_from_frame.size(); ++frame) {
    const auto& fixed_from_frame = fixed_from_frames.root_from_frame[frame];
    const auto at = fixed_from_frame ? toScreen(view, size, fixed_from_frame->translation) : std::nullopt;
    const double distance_px = at ? glm::length(at->position_px - cursor_px) : 0.0;
    if (at && distance_px <= reach_px) {
      near.push_back({distance_px, at->depth_m, frame});
    }
  }
  std::ranges::sort(near, {}, [](const NearFrame& one) { return std::tie(one.distance_px, one.depth_m, one.frame); });
  near.resize(std::min(near.size(), most));
  std::vector<FramePick> picks;
  for (const NearFrame& one : near) {
    picks.push_back({buffer.frameName(one.frame), one.distance_px, one.depth_m});
  }
  return picks;
}

}  // namespace stillframe::scenegraph
