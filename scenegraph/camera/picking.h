#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/camera/camera.h"
#include "tf/transform_buffer.h"

namespace stillframe::scenegraph {

/// A picture's size in device pixels.
struct PictureSize {
  double width_px = 0.0;
  double height_px = 0.0;
  double pixel_ratio = 1.0;  ///< device pixels to one of those that settings count in
};

/// Where a point falls in a picture.
struct ScreenPoint {
  glm::dvec2 position_px{0.0, 0.0};  ///< from the top left corner, y down; may lie outside the picture
  double depth_m = 0.0;              ///< in front of the eye, along the line of sight
};

/// Pixel of a point in the fixed frame; nullopt when it lies before the near plane (perspective), is not finite, or the
/// picture has no area.
[[nodiscard]] std::optional<ScreenPoint> toScreen(const CameraView& view, const PictureSize& size,
                                                  const glm::dvec3& point_in_fixed);

/// Where a straight line falls, as far as it is not before the near plane; it may reach beyond the picture. Nullopt
/// when nothing of it is seen.
[[nodiscard]] std::optional<std::pair<glm::dvec2, glm::dvec2>> toScreen(const CameraView& view, const PictureSize& size,
                                                                        const glm::dvec3& from_in_fixed,
                                                                        const glm::dvec3& to_in_fixed);

/// Line of sight of a place in the picture, in the fixed frame.
struct SightLine {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};  ///< such that a step of 1 along it is 1 m along the view axis
};
/// The inverse of toScreen(); orthographic lines begin in the plane of the eye. Nullopt when the picture has no area.
[[nodiscard]] std::optional<SightLine> sightLine(const CameraView& view, const PictureSize& size,
                                                 const glm::dvec2& position_px);

/// A frame under the cursor.
struct FramePick {
  std::string frame;
  double distance_px = 0.0;  ///< from the cursor to the frame's origin
  double depth_m = 0.0;
};

/// The frames whose origins are nearest to the cursor in the picture, within `reach_px`: by distance from the cursor,
/// of origins at the same pixel the nearest to the eye, then the one first seen. At most `most`. Never one behind the
/// eye or without a place in `fixed_from_frames`. O(frames).
[[nodiscard]] std::vector<FramePick> pickFrames(const tf::TransformBuffer& buffer,
                                                const tf::Snapshot& fixed_from_frames, const CameraView& view,
                                                const PictureSize& size, const glm::dvec2& cursor_px, double reach_px,
                                                std::size_t most = 1);

}  // namespace stillframe::scenegraph
