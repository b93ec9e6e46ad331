#include "scenegraph/camera/orbit_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <variant>

#include "scenegraph/settings.h"

namespace stillframe::scenegraph {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMinRadiusM = 1e-6;
constexpr double kMaxRadiusM = 1e9;
constexpr double kMaxCoordinateM = 1e12;
constexpr double kMinFovRad = 1e-3;
constexpr double kMaxFovRad = kPi - 1e-3;

using State = OrbitCamera::State;

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// The state within its ranges; a state in range is not touched in any bit.
State inRange(State state) {
  state.focal_point = glm::clamp(state.focal_point, -kMaxCoordinateM, kMaxCoordinateM);
  state.yaw_rad = std::remainder(state.yaw_rad, 2.0 * kPi);
  state.pitch_rad = std::clamp(state.pitch_rad, -kPi / 2.0, kPi / 2.0);
  state.radius_m = std::clamp(state.radius_m, kMinRadiusM, kMaxRadiusM);
  state.vertical_fov_rad = std::clamp(state.vertical_fov_rad, kMinFovRad, kMaxFovRad);
  return state;
}

/// Axes of the eye in the fixed frame; `back` points from the focal point to the eye. Without a singular direction.
struct Axes {
  glm::dvec3 right;
  glm::dvec3 up;
  glm::dvec3 back;
};

Axes axes(const State& state) {
  const double sin_yaw = std::sin(state.yaw_rad);
  const double cos_yaw = std::cos(state.yaw_rad);
  const double sin_pitch = std::sin(state.pitch_rad);
  const double cos_pitch = std::cos(state.pitch_rad);
  return {.right = {-sin_yaw, cos_yaw, 0.0},
          .up = {-sin_pitch * cos_yaw, -sin_pitch * sin_yaw, cos_pitch},
          .back = {cos_pitch * cos_yaw, cos_pitch * sin_yaw, sin_pitch}};
}

constexpr std::array<std::pair<const char*, double State::*>, 4> kScalars = {{{"yaw_rad", &State::yaw_rad},
                                                                              {"pitch_rad", &State::pitch_rad},
                                                                              {"radius_m", &State::radius_m},
                                                                              {"fov_rad", &State::vertical_fov_rad}}};
constexpr std::array<std::pair<const char*, int>, 3> kFocal = {{{"focal_x", 0}, {"focal_y", 1}, {"focal_z", 2}}};

}  // namespace

void OrbitCamera::setState(const State& state) {
  if (isFinite(state.focal_point) && std::isfinite(state.yaw_rad) && std::isfinite(state.pitch_rad) &&
      std::isfinite(state.radius_m) && std::isfinite(state.vertical_fov_rad)) {
    state_ = inRange(state);
  }
}

CameraView OrbitCamera::view() const {
  const Axes axis = axes(state_);
  CameraView view;
  for (int column = 0; column < 3; ++column) {
    view.eye_from_fixed[column] = {axis.right[column], axis.up[column], axis.back[column], 0.0};
  }
  const glm::dvec3& focal = state_.focal_point;
  view.eye_from_fixed[3] = {-glm::dot(axis.right, focal), -glm::dot(axis.up, focal),
                            -glm::dot(axis.back, focal) - state_.radius_m, 1.0};
  view.vertical_fov_rad = state_.vertical_fov_rad;
  // Close to something tiny the near plane comes along; a float reverse-Z depth has room for it.
  view.near_m = std::min(view.near_m, 1e-3 * state_.radius_m);
  return view;
}

glm::dvec3 OrbitCamera::eye() const { return state_.focal_point + state_.radius_m * axes(state_).back; }

void OrbitCamera::rotate(double dx_px, double dy_px, double height_px) {
  State state = state_;
  state.yaw_rad -= dx_px * kPi / height_px;
  state.pitch_rad += dy_px * kPi / height_px;
  setState(state);
}

void OrbitCamera::pan(double dx_px, double dy_px, double height_px) {
  const Axes axis = axes(state_);
  const double m_per_px = 2.0 * state_.radius_m * std::tan(state_.vertical_fov_rad / 2.0) / height_px;
  State state = state_;
  state.focal_point += m_per_px * (dy_px * axis.up - dx_px * axis.right);
  setState(state);
}

void OrbitCamera::zoom(double steps) {
  if (std::isfinite(steps)) {
    // The factor of many steps may be 0 or infinity: the clamp takes both.
    state_.radius_m = std::clamp(state_.radius_m * std::pow(0.9, steps), kMinRadiusM, kMaxRadiusM);
  }
}

void OrbitCamera::dolly(double dy_px, double height_px) {
  const double heights = dy_px / height_px;
  if (std::isfinite(heights)) {
    state_.radius_m = std::clamp(state_.radius_m * std::pow(10.0, heights), kMinRadiusM, kMaxRadiusM);
  }
}

void OrbitCamera::frame(const osg::BoundingBoxd& box, double aspect) {
  if (!box.valid()) {
    return;
  }
  const glm::dvec3 low(box.xMin(), box.yMin(), box.zMin());
  const glm::dvec3 high(box.xMax(), box.yMax(), box.zMax());
  const glm::dvec3 half = high / 2.0 - low / 2.0;
  const double width_over_height = std::isfinite(aspect) && aspect > 0.0 ? aspect : 1.0;
  const double slope_y = std::tan(state_.vertical_fov_rad / 2.0);
  const double slope_x = slope_y * width_over_height;
  const glm::dvec3 back(std::cos(state_.pitch_rad) * std::cos(state_.yaw_rad),
                        std::cos(state_.pitch_rad) * std::sin(state_.yaw_rad), std::sin(state_.pitch_rad));
  const glm::dvec3 right(-std::sin(state_.yaw_rad), std::cos(state_.yaw_rad), 0.0);
  const glm::dvec3 up = glm::cross(back, right);
  double radius_m = 0.0;  // at which the outermost corner touches an edge of the picture
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 offset((corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                            (corner & 4) != 0 ? half.z : -half.z);
    const double needed =
        std::max(std::abs(glm::dot(offset, right)) / slope_x, std::abs(glm::dot(offset, up)) / slope_y);
    radius_m = std::max(radius_m, glm::dot(offset, back) + needed);
  }
  State state = state_;
  state.focal_point = low / 2.0 + high / 2.0;
  if (radius_m > 0.0) {  // a single point is looked at from where we are
    constexpr double kMargin = 1.04;
    state.radius_m = std::min(kMargin * radius_m, kMaxRadiusM);
  }
  setState(state);
}

void OrbitCamera::setLookAt(const glm::dvec3& eye, const glm::dvec3& target) {
  const glm::dvec3 back = eye - target;
  const double level = std::hypot(back.x, back.y);
  State state = state_;
  state.focal_point = target;
  state.radius_m = std::hypot(level, back.z);
  if (state.radius_m > 0.0) {
    state.pitch_rad = std::atan2(back.z, level);
    // Straight up or down: +y of the fixed frame is up in the picture, as lookAt() has it.
    state.yaw_rad = level > 0.0 ? std::atan2(back.y, back.x) : (back.z > 0.0 ? -kPi / 2.0 : kPi / 2.0);
  }
  setState(state);
}

std::map<std::string, std::string> OrbitCamera::texts() const {
  std::map<std::string, std::string> texts;
  for (const auto& [key, member] : kScalars) {
    texts[key] = settingText(state_.*member);
  }
  for (const auto& [key, axis] : kFocal) {
    texts[key] = settingText(state_.focal_point[axis]);
  }
  return texts;
}

bool OrbitCamera::setTexts(const std::map<std::string, std::string>& texts) {
  State state = state_;
  const auto read = [&](const char* key, double& value) {
    const auto found = texts.find(key);
    if (found == texts.end()) {
      return true;
    }
    SettingSpec spec;
    spec.key = key;
    spec.kind = SettingKind::Double;
    const auto parsed = parseSetting(spec, found->second);
    if (parsed) {
      value = std::get<double>(*parsed);
    }
    return parsed.has_value();
  };
  bool is_valid = true;
  for (const auto& [key, member] : kScalars) {
    is_valid = read(key, state.*member) && is_valid;
  }
  for (const auto& [key, axis] : kFocal) {
    is_valid = read(key, state.focal_point[axis]) && is_valid;
  }
  if (is_valid) {
    setState(state);
  }
  return is_valid;
}

}  // namespace stillframe::scenegraph
