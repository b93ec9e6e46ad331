#include "scenegraph/camera/top_down_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace stillframe::scenegraph {
namespace {

constexpr double kMinExtentM = 1e-6;
constexpr double kMaxExtentM = 1e9;
constexpr double kMinHalfDepthM = 1e4;
constexpr double kDepthPerExtent = 10.0;  // a tower seen from far away stays in the picture

/// As eyeAxes(yaw, pi/2), without the rounding of a cosine that should be zero.
EyeAxes downAxes(double yaw_rad) {
  const double sin_yaw = std::sin(yaw_rad);
  const double cos_yaw = std::cos(yaw_rad);
  return {.right = {-sin_yaw, cos_yaw, 0.0}, .up = {-cos_yaw, -sin_yaw, 0.0}, .back = {0.0, 0.0, 1.0}};
}

double slope(double vertical_fov_rad) { return 2.0 * std::tan(vertical_fov_rad / 2.0); }

}  // namespace

void TopDownCamera::setState(const State& state) {
  Sight sight;
  sight.focal_point = state.centre;
  sight.yaw_rad = state.yaw_rad;
  sight.vertical_fov_rad = state.vertical_fov_rad;
  if (!isFinite(sight) || !std::isfinite(state.vertical_extent_m)) {
    return;
  }
  sight = inRange(sight);
  state_ = {.centre = sight.focal_point,
            .yaw_rad = sight.yaw_rad,
            .vertical_extent_m = std::clamp(state.vertical_extent_m, kMinExtentM, kMaxExtentM),
            .vertical_fov_rad = sight.vertical_fov_rad};
}

CameraView TopDownCamera::view() const {
  const EyeAxes axes = downAxes(state_.yaw_rad);
  CameraView view;
  for (int column = 0; column < 3; ++column) {
    view.eye_from_fixed[column] = {axes.right[column], axes.up[column], axes.back[column], 0.0};
  }
  const glm::dvec3& at = state_.centre;
  view.eye_from_fixed[3] = {-glm::dot(axes.right, at), -glm::dot(axes.up, at), -at.z, 1.0};
  view.is_orthographic = true;
  view.vertical_extent_m = state_.vertical_extent_m;
  view.vertical_fov_rad = state_.vertical_fov_rad;
  view.half_depth_m = std::max(kMinHalfDepthM, kDepthPerExtent * state_.vertical_extent_m);
  return view;
}

Sight TopDownCamera::sight() const {
  return inRange({.focal_point = state_.centre,
                  .yaw_rad = state_.yaw_rad,
                  .pitch_rad = std::numbers::pi / 2.0,
                  .radius_m = state_.vertical_extent_m / slope(state_.vertical_fov_rad),
                  .vertical_fov_rad = state_.vertical_fov_rad});
}

void TopDownCamera::adopt(const Sight& sight) {
  setState({.centre = sight.focal_point,
            .yaw_rad = sight.yaw_rad,
            .vertical_extent_m = sight.radius_m * slope(sight.vertical_fov_rad),
            .vertical_fov_rad = sight.vertical_fov_rad});
}

void TopDownCamera::carry(double yaw_rad, const glm::dvec3& translation) {
  Sight at;
  at.focal_point = state_.centre;
  at.yaw_rad = state_.yaw_rad;
  at = carried(at, yaw_rad, translation);
  State state = state_;
  state.centre = at.focal_point;
  state.yaw_rad = at.yaw_rad;
  setState(state);
}

void TopDownCamera::rotate(double dx_px, double /*dy_px*/, double height_px) {
  State state = state_;
  state.yaw_rad -= dx_px * std::numbers::pi / height_px;
  setState(state);
}

void TopDownCamera::pan(double dx_px, double dy_px, double height_px) {
  const EyeAxes axes = downAxes(state_.yaw_rad);
  State state = state_;
  state.centre += state.vertical_extent_m / height_px * (dy_px * axes.up - dx_px * axes.right);
  setState(state);
}

void TopDownCamera::scale(double factor) {
  State state = state_;
  // The factor of many steps may be 0 or infinity; neither is a size, and the ends of its range are meant.
  state.vertical_extent_m = std::clamp(state.vertical_extent_m * factor, 0.0, kMaxExtentM);
  setState(state);
}

void TopDownCamera::zoom(double steps) {
  if (std::isfinite(steps)) {
    scale(std::pow(0.9, steps));
  }
}

void TopDownCamera::dolly(double dy_px, double height_px) {
  const double heights = dy_px / height_px;
  if (std::isfinite(heights)) {
    scale(std::pow(10.0, heights));
  }
}

void TopDownCamera::walk(const glm::dvec3& direction, double seconds) {
  const EyeAxes axes = downAxes(state_.yaw_rad);
  State state = state_;
  state.centre += state.vertical_extent_m * seconds * (direction.x * axes.right + direction.z * axes.up);
  setState(state);
}

void TopDownCamera::frame(const Box& box, double aspect) {
  if (!box.isValid()) {
    return;
  }
  const double width_over_height = std::isfinite(aspect) && aspect > 0.0 ? aspect : 1.0;
  const EyeAxes axes = downAxes(state_.yaw_rad);
  const glm::dvec3 half = box.halfSize();
  const double half_width = glm::dot(glm::abs(axes.right), half);
  const double half_height = glm::dot(glm::abs(axes.up), half);
  State state = state_;
  state.centre = box.centre();
  const double extent_m = 2.0 * std::max(half_height, half_width / width_over_height);
  if (extent_m > 0.0) {  // a single point is looked at as widely as before
    constexpr double kMargin = 1.04;
    state.vertical_extent_m = std::min(kMargin * extent_m, kMaxExtentM);
  }
  setState(state);
}

}  // namespace stillframe::scenegraph
