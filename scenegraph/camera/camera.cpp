#include "scenegraph/camera/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace stillframe::scenegraph {
namespace {

/// `value` when it is a positive finite number, else `fallback`.
double positiveOr(double value, double fallback) { return std::isfinite(value) && value > 0.0 ? value : fallback; }

/// Unit vector; `fallback` for what has no direction. Scaled first, so that no length over- or underflows.
glm::dvec3 directionOr(const glm::dvec3& v, const glm::dvec3& fallback) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return std::isfinite(largest) && largest > 0.0 ? glm::normalize(v / largest) : fallback;
}

}  // namespace

glm::dmat4 lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
  const glm::dvec3 forward = directionOr(target - eye, {1.0, 0.0, 0.0});
  glm::dvec3 side = glm::cross(forward, directionOr(up, {0.0, 0.0, 1.0}));
  if (glm::dot(side, side) < 1e-24) {
    // Along the line of sight: any direction across it will do, the world's y before its x.
    side = glm::cross(forward, std::abs(forward.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0));
  }
  side = glm::normalize(side);
  const glm::dvec3 true_up = glm::cross(side, forward);
  glm::dmat4 eye_from_fixed(1.0);
  for (int column = 0; column < 3; ++column) {
    eye_from_fixed[column] = {side[column], true_up[column], -forward[column], 0.0};
  }
  eye_from_fixed[3] = {-glm::dot(side, eye), -glm::dot(true_up, eye), glm::dot(forward, eye), 1.0};
  return eye_from_fixed;
}

glm::dmat4 reverseZInfinitePerspective(double vertical_fov_rad, double aspect, double near_m) {
  const double fov = std::isfinite(vertical_fov_rad) ? std::clamp(vertical_fov_rad, kMinFovRad, kMaxFovRad)
                                                     : CameraView{}.vertical_fov_rad;
  const double scale_y = 1.0 / std::tan(fov / 2.0);
  glm::dmat4 clip_from_eye(0.0);
  clip_from_eye[0][0] = scale_y / positiveOr(aspect, 1.0);
  clip_from_eye[1][1] = scale_y;
  clip_from_eye[2][3] = -1.0;  // w = distance in front of the eye
  clip_from_eye[3][2] = positiveOr(near_m, CameraView{}.near_m);
  return clip_from_eye;
}

glm::dmat4 reverseZOrthographic(double vertical_extent_m, double aspect, double half_depth_m) {
  const double height = positiveOr(vertical_extent_m, CameraView{}.vertical_extent_m);
  glm::dmat4 clip_from_eye(1.0);
  clip_from_eye[0][0] = 2.0 / (height * positiveOr(aspect, 1.0));
  clip_from_eye[1][1] = 2.0 / height;
  clip_from_eye[2][2] = 0.5 / positiveOr(half_depth_m, 1.0);
  clip_from_eye[3][2] = 0.5;
  return clip_from_eye;
}

glm::dmat4 projection(const CameraView& view, double aspect) {
  return view.is_orthographic ? reverseZOrthographic(view.vertical_extent_m, aspect, view.half_depth_m)
                              : reverseZInfinitePerspective(view.vertical_fov_rad, aspect, view.near_m);
}

}  // namespace stillframe::scenegraph
