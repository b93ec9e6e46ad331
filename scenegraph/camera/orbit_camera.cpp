#include "scenegraph/camera/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace stillframe::scenegraph {
namespace {

constexpr double kMostStretch = 10.0;  // of a pan along the ground seen at a flat angle

double metresPerPixel(const Sight& sight, double height_px) {
  return 2.0 * sight.radius_m * std::tan(sight.vertical_fov_rad / 2.0) / height_px;
}

}  // namespace

void OrbitCamera::setState(const State& state) {
  if (isFinite(state)) {
    state_ = inRange(state);
  }
}

CameraView OrbitCamera::view() const {
  const EyeAxes axes = eyeAxes(state_.yaw_rad, state_.pitch_rad);
  CameraView view;
  for (int column = 0; column < 3; ++column) {
    view.eye_from_fixed[column] = {axes.right[column], axes.up[column], axes.back[column], 0.0};
  }
  const glm::dvec3& focal = state_.focal_point;
  view.eye_from_fixed[3] = {-glm::dot(axes.right, focal), -glm::dot(axes.up, focal),
                            -glm::dot(axes.back, focal) - state_.radius_m, 1.0};
  view.vertical_fov_rad = state_.vertical_fov_rad;
  // Close to something tiny the near plane comes along; a float reverse-Z depth has room for it.
  view.near_m = std::min(view.near_m, 1e-3 * state_.radius_m);
  return view;
}

void OrbitCamera::carry(double yaw_rad, const glm::dvec3& translation) {
  setState(carried(state_, yaw_rad, translation));
}

void OrbitCamera::rotate(double dx_px, double dy_px, double height_px) {
  State state = state_;
  state.yaw_rad -= dx_px * std::numbers::pi / height_px;
  state.pitch_rad += dy_px * std::numbers::pi / height_px;
  setState(state);
}

void OrbitCamera::pan(double dx_px, double dy_px, double height_px) {
  const EyeAxes axes = eyeAxes(state_.yaw_rad, state_.pitch_rad);
  State state = state_;
  state.focal_point += metresPerPixel(state_, height_px) * (dy_px * axes.up - dx_px * axes.right);
  setState(state);
}

void OrbitCamera::zoom(double steps) {
  if (std::isfinite(steps)) {
    State state = state_;
    // The factor of many steps may be 0 or infinity; neither is a radius, and the ends of its range are meant.
    state.radius_m = std::clamp(state.radius_m * std::pow(0.9, steps), 0.0, 1e300);
    setState(state);
  }
}

void OrbitCamera::dolly(double dy_px, double height_px) {
  const double heights = dy_px / height_px;
  if (std::isfinite(heights)) {
    State state = state_;
    state.radius_m = std::clamp(state.radius_m * std::pow(10.0, heights), 0.0, 1e300);
    setState(state);
  }
}

void OrbitCamera::walk(const glm::dvec3& direction, double seconds) {
  const EyeAxes axes = eyeAxes(state_.yaw_rad, 0.0);
  State state = state_;
  state.focal_point +=
      state.radius_m * seconds * (direction.x * axes.right + direction.y * axes.up - direction.z * axes.back);
  setState(state);
}

void OrbitCamera::frame(const Box& box, double aspect) {
  if (!box.isValid()) {
    return;
  }
  State state = state_;
  state.focal_point = focalPointFor(box);
  const double distance_m = distanceToSee(box, state, aspect);
  if (distance_m > 0.0) {  // a single point is looked at from where we are
    constexpr double kMargin = 1.04;
    state.radius_m = std::min(kMargin * distance_m, 1e300);
  }
  setState(state);
}

XyOrbitCamera::XyOrbitCamera() = default;

void XyOrbitCamera::adopt(const Sight& sight) {
  if (!isFinite(sight)) {
    return;
  }
  const double ground_m = state().focal_point.z;
  const glm::dvec3 back = eyeAxes(sight.yaw_rad, sight.pitch_rad).back;
  const glm::dvec3 eye = eyeOf(sight);
  Sight on_ground = sight;
  const double distance_m = (eye.z - ground_m) / back.z;
  if (distance_m > 0.01 * sight.radius_m && distance_m < 100.0 * sight.radius_m) {
    on_ground.focal_point = eye - distance_m * back;
    on_ground.radius_m = distance_m;
  }
  on_ground.focal_point.z = ground_m;
  setState(on_ground);
}

void XyOrbitCamera::pan(double dx_px, double dy_px, double height_px) {
  const EyeAxes level = eyeAxes(state().yaw_rad, 0.0);
  const double sine = std::sin(state().pitch_rad);
  const double stretch = std::copysign(std::min(1.0 / std::abs(sine), kMostStretch), sine);
  State state = this->state();
  state.focal_point -= metresPerPixel(state, height_px) * (dx_px * level.right + dy_px * stretch * level.back);
  setState(state);
}

void XyOrbitCamera::walk(const glm::dvec3& direction, double seconds) {
  OrbitCamera::walk({direction.x, 0.0, direction.z}, seconds);
}

glm::dvec3 XyOrbitCamera::focalPointFor(const Box& box) const {
  const glm::dvec3 centre = box.centre();
  return {centre.x, centre.y, state().focal_point.z};
}

}  // namespace stillframe::scenegraph
