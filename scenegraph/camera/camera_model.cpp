#include "scenegraph/camera/camera_model.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

namespace stillframe::scenegraph {
namespace {

constexpr double kMinRadiusM = 1e-6;
constexpr double kMaxRadiusM = 1e9;
constexpr double kMaxCoordinateM = 1e12;

}  // namespace

void CameraModel::zoomAt(double steps, const glm::dvec2& from_centre_px, double height_px) {
  const double before_m = sight().radius_m;
  zoom(steps);
  // What lies under the cursor at the focal depth has moved away from the middle by the magnification: bring it back.
  const glm::dvec2 moved = from_centre_px * (1.0 - before_m / sight().radius_m);
  pan(moved.x, moved.y, height_px);
}

EyeAxes eyeAxes(double yaw_rad, double pitch_rad) {
  const double sin_yaw = std::sin(yaw_rad);
  const double cos_yaw = std::cos(yaw_rad);
  const double sin_pitch = std::sin(pitch_rad);
  const double cos_pitch = std::cos(pitch_rad);
  return {.right = {-sin_yaw, cos_yaw, 0.0},
          .up = {-sin_pitch * cos_yaw, -sin_pitch * sin_yaw, cos_pitch},
          .back = {cos_pitch * cos_yaw, cos_pitch * sin_yaw, sin_pitch}};
}

glm::dvec3 eyeOf(const Sight& sight) {
  return sight.focal_point + sight.radius_m * eyeAxes(sight.yaw_rad, sight.pitch_rad).back;
}

bool isFinite(const Sight& sight) {
  const auto& focal = sight.focal_point;
  return std::isfinite(focal.x) && std::isfinite(focal.y) && std::isfinite(focal.z) && std::isfinite(sight.yaw_rad) &&
         std::isfinite(sight.pitch_rad) && std::isfinite(sight.radius_m) && std::isfinite(sight.vertical_fov_rad);
}

Sight inRange(Sight sight) {
  sight.focal_point = glm::clamp(sight.focal_point, -kMaxCoordinateM, kMaxCoordinateM);
  sight.yaw_rad = std::remainder(sight.yaw_rad, 2.0 * std::numbers::pi);
  sight.pitch_rad = std::clamp(sight.pitch_rad, -std::numbers::pi / 2.0, std::numbers::pi / 2.0);
  sight.radius_m = std::clamp(sight.radius_m, kMinRadiusM, kMaxRadiusM);
  sight.vertical_fov_rad = std::clamp(sight.vertical_fov_rad, kMinFovRad, kMaxFovRad);
  return sight;
}

Sight lookingFrom(const glm::dvec3& eye, const glm::dvec3& target, Sight sight) {
  const glm::dvec3 back = eye - target;
  const double level = std::hypot(back.x, back.y);
  sight.focal_point = target;
  sight.radius_m = std::hypot(level, back.z);
  if (sight.radius_m > 0.0) {
    sight.pitch_rad = std::atan2(back.z, level);
    // Straight up or down: +y of the fixed frame is up in the picture, as lookAt() has it.
    sight.yaw_rad =
        level > 0.0 ? std::atan2(back.y, back.x) : (back.z > 0.0 ? -std::numbers::pi / 2.0 : std::numbers::pi / 2.0);
  }
  return sight;
}

Sight carried(Sight sight, double yaw_rad, const glm::dvec3& translation) {
  const glm::dvec3 at = sight.focal_point;
  const double cos_yaw = std::cos(yaw_rad);
  const double sin_yaw = std::sin(yaw_rad);
  sight.focal_point = translation + glm::dvec3(cos_yaw * at.x - sin_yaw * at.y, sin_yaw * at.x + cos_yaw * at.y, at.z);
  sight.yaw_rad += yaw_rad;
  return sight;
}

double distanceToSee(const Box& box, const Sight& sight, double aspect) {
  const double width_over_height = std::isfinite(aspect) && aspect > 0.0 ? aspect : 1.0;
  const double slope_y = std::tan(sight.vertical_fov_rad / 2.0);
  const double slope_x = slope_y * width_over_height;
  const EyeAxes axes = eyeAxes(sight.yaw_rad, sight.pitch_rad);
  double distance_m = 0.0;  // at which the outermost corner touches an edge of the picture
  for (unsigned i = 0; i < 8; ++i) {
    const glm::dvec3 offset = box.corner(i) - sight.focal_point;
    const double needed =
        std::max(std::abs(glm::dot(offset, axes.right)) / slope_x, std::abs(glm::dot(offset, axes.up)) / slope_y);
    distance_m = std::max(distance_m, glm::dot(offset, axes.back) + needed);
  }
  return distance_m;
}

Sight mix(const Sight& from, const Sight& to, double fraction) {
  if (!(fraction < 1.0)) {
    return to;
  }
  if (!(fraction > 0.0)) {
    return from;
  }
  Sight sight = to;
  sight.focal_point = glm::mix(from.focal_point, to.focal_point, fraction);
  sight.yaw_rad = from.yaw_rad + fraction * std::remainder(to.yaw_rad - from.yaw_rad, 2.0 * std::numbers::pi);
  sight.pitch_rad = std::lerp(from.pitch_rad, to.pitch_rad, fraction);
  sight.radius_m = from.radius_m * std::pow(to.radius_m / from.radius_m, fraction);
  sight.vertical_fov_rad = std::lerp(from.vertical_fov_rad, to.vertical_fov_rad, fraction);
  return inRange(sight);
}

}  // namespace stillframe::scenegraph
