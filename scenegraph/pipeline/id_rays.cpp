#include "scenegraph/pipeline/id_rays.h"

#include <cmath>
#include <osg/Drawable>

namespace stillframe::scenegraph {

const RayTarget* rayTargetOf(const osg::Node& drawable) {
  return dynamic_cast<const RayTarget*>(drawable.getUserData());
}

IdRays::IdRays(const RayTarget& target, const osg::Matrixd& eye_from_local, const osg::Matrixd& clip_from_eye,
               int width_px, int height_px)
    : target_(target),
      local_from_eye_(osg::Matrixd::inverse(eye_from_local)),
      clip_from_eye_(clip_from_eye),
      width_px_(width_px),
      height_px_(height_px) {}

std::optional<IdRays::Met> IdRays::at(int x_px, int y_px) const {
  const bool is_orthographic = clip_from_eye_(3, 3) == 1.0;
  const double across = (2.0 * (x_px + 0.5) / width_px_ - 1.0) / clip_from_eye_(0, 0);
  const double up = (2.0 * (y_px + 0.5) / height_px_ - 1.0) / clip_from_eye_(1, 1);
  // From where the depth is 1. A step of 1 along the direction is 1 m along the view axis.
  const double nearest_z =
      is_orthographic ? (1.0 - clip_from_eye_(3, 2)) / clip_from_eye_(2, 2) : -clip_from_eye_(3, 2);
  const osg::Vec4d origin = is_orthographic ? osg::Vec4d(across, up, nearest_z, 1.0)
                                            : osg::Vec4d(-nearest_z * across, -nearest_z * up, nearest_z, 1.0);
  const osg::Vec4d direction = is_orthographic ? osg::Vec4d(0.0, 0.0, -1.0, 0.0) : osg::Vec4d(across, up, -1.0, 0.0);
  const osg::Vec4d origin_in_local = origin * local_from_eye_;
  const osg::Vec4d direction_in_local = direction * local_from_eye_;
  const auto hit = target_.meet({{origin_in_local.x(), origin_in_local.y(), origin_in_local.z()},
                                 {direction_in_local.x(), direction_in_local.y(), direction_in_local.z()}});
  if (!hit) {
    return std::nullopt;
  }
  const osg::Vec4d clip = (origin + direction * hit->along) * clip_from_eye_;
  const auto depth = static_cast<float>(clip.z() / clip.w());
  // Beyond what the buffer tells from nothing there is nothing.
  return depth > 0.0F && std::isfinite(depth) ? std::optional(Met{hit->instance, depth}) : std::nullopt;
}

}  // namespace stillframe::scenegraph
