#include "scenegraph/camera/fly_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scenegraph/camera/orbit_camera.h"

namespace stillframe::scenegraph {
namespace {

constexpr double kMostSteps = 50.0;   // of one event; a driver may send anything
constexpr double kMostHeights = 3.0;  // of one drag

/// The sight with its focal point in the eye, to be checked and kept in range like any other.
Sight atEye(const FlyCamera::State& state) {
  return {state.eye, state.yaw_rad, state.pitch_rad, state.reach_m, state.vertical_fov_rad};
}

FlyCamera::State stateAtEye(const Sight& sight) {
  return {sight.focal_point, sight.yaw_rad, sight.pitch_rad, sight.radius_m, sight.vertical_fov_rad};
}

double advance(double steps) { return 1.0 - std::pow(0.9, std::clamp(steps, -kMostSteps, kMostSteps)); }

}  // namespace

void FlyCamera::setState(const State& state) {
  if (isFinite(atEye(state))) {
    state_ = stateAtEye(inRange(atEye(state)));
  }
}

CameraView FlyCamera::view() const {
  const EyeAxes axes = eyeAxes(state_.yaw_rad, state_.pitch_rad);
  CameraView view;
  for (int column = 0; column < 3; ++column) {
    view.eye_from_fixed[column] = {axes.right[column], axes.up[column], axes.back[column], 0.0};
  }
  const glm::dvec3& eye = state_.eye;
  view.eye_from_fixed[3] = {-glm::dot(axes.right, eye), -glm::dot(axes.up, eye), -glm::dot(axes.back, eye), 1.0};
  view.vertical_fov_rad = state_.vertical_fov_rad;
  view.near_m = std::min(view.near_m, 1e-3 * state_.reach_m);
  return view;
}

Sight FlyCamera::sight() const {
  Sight sight = atEye(state_);
  sight.focal_point -= sight.radius_m * eyeAxes(sight.yaw_rad, sight.pitch_rad).back;
  return inRange(sight);
}

void FlyCamera::adopt(const Sight& sight) {
  Sight at_eye = sight;
  at_eye.focal_point = eyeOf(sight);
  setState(stateAtEye(at_eye));
}

void FlyCamera::carry(double yaw_rad, const glm::dvec3& translation) {
  setState(stateAtEye(carried(atEye(state_), yaw_rad, translation)));
}

void FlyCamera::rotate(double dx_px, double dy_px, double height_px) {
  const double rad_per_px = state_.vertical_fov_rad / height_px;
  State state = state_;
  state.yaw_rad -= dx_px * rad_per_px;
  state.pitch_rad += dy_px * rad_per_px;
  setState(state);
}

void FlyCamera::pan(double dx_px, double dy_px, double height_px) {
  const EyeAxes axes = eyeAxes(state_.yaw_rad, state_.pitch_rad);
  const double m_per_px = 2.0 * state_.reach_m * std::tan(state_.vertical_fov_rad / 2.0) / height_px;
  State state = state_;
  state.eye += m_per_px * (dy_px * axes.up - dx_px * axes.right);
  setState(state);
}

void FlyCamera::zoom(double steps) {
  State state = state_;
  state.eye -= advance(steps) * state.reach_m * eyeAxes(state.yaw_rad, state.pitch_rad).back;
  setState(state);
}

void FlyCamera::zoomAt(double steps, const glm::dvec2& from_centre_px, double height_px) {
  const EyeAxes axes = eyeAxes(state_.yaw_rad, state_.pitch_rad);
  const double slope_per_px = 2.0 * std::tan(state_.vertical_fov_rad / 2.0) / height_px;
  const glm::dvec3 to_cursor = slope_per_px * (from_centre_px.x * axes.right - from_centre_px.y * axes.up) - axes.back;
  State state = state_;
  state.eye += advance(steps) * state.reach_m * to_cursor;
  setState(state);
}

void FlyCamera::dolly(double dy_px, double height_px) {
  const double heights = std::clamp(dy_px / height_px, -kMostHeights, kMostHeights);
  State state = state_;
  state.eye += (std::pow(10.0, heights) - 1.0) * state.reach_m * eyeAxes(state.yaw_rad, state.pitch_rad).back;
  setState(state);
}

void FlyCamera::walk(const glm::dvec3& direction, double seconds) {
  const EyeAxes axes = eyeAxes(state_.yaw_rad, state_.pitch_rad);
  State state = state_;
  state.eye += state.reach_m * seconds *
               (direction.x * axes.right + direction.y * glm::dvec3(0.0, 0.0, 1.0) - direction.z * axes.back);
  setState(state);
}

void FlyCamera::frame(const Box& box, double aspect) {
  OrbitCamera orbit;
  orbit.setState(sight());
  orbit.frame(box, aspect);
  if (box.isValid()) {
    adopt(orbit.state());
  }
}

void FlyCamera::changePace(double steps) {
  State state = state_;
  state.reach_m *= std::pow(1.25, std::clamp(steps, -kMostSteps, kMostSteps));
  setState(state);
}

}  // namespace stillframe::scenegraph
