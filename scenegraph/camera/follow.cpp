#include "scenegraph/camera/follow.h"

#include <cmath>

namespace stillframe::scenegraph {
namespace {

/// A tilt below this is rounding, or invisible.
constexpr double kUprightRad = 1e-9;

glm::dquat turnAboutZ(double yaw_rad) { return {std::cos(yaw_rad / 2.0), 0.0, 0.0, std::sin(yaw_rad / 2.0)}; }

/// Upright, with the heading of a pose and its place.
tf::RigidTransform upright(const tf::RigidTransform& pose) {
  return {turnAboutZ(headingOf(pose.rotation)), pose.translation};
}

bool isUpright(const glm::dquat& rotation) { return 2.0 * std::hypot(rotation.x, rotation.y) < kUprightRad; }

}  // namespace

bool operator==(const FollowState& a, const FollowState& b) noexcept {
  const auto isSame = [](const tf::RigidTransform& left, const tf::RigidTransform& right) {
    return left.rotation == right.rotation && left.translation == right.translation;
  };
  return a.mode == b.mode && isSame(a.base_from_camera, b.base_from_camera) && a.heading_zero == b.heading_zero &&
         isSame(a.fixed_from_camera, b.fixed_from_camera) && a.is_waiting == b.is_waiting;
}

glm::dquat twistAboutZ(const glm::dquat& rotation) noexcept {
  const double norm = std::hypot(rotation.w, rotation.z);
  return norm > 1e-12 ? glm::dquat(rotation.w / norm, 0.0, 0.0, rotation.z / norm) : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

double headingOf(const glm::dquat& rotation) noexcept {
  const glm::dvec3 x = rotation * glm::dvec3(1.0, 0.0, 0.0);
  return std::hypot(x.x, x.y) > 1e-3 ? std::atan2(x.y, x.x) : 2.0 * std::atan2(rotation.z, rotation.w);
}

void Follow::setState(const FollowState& state) {
  const auto isUnit = [](const glm::dquat& q) {
    const double norm = std::hypot(std::hypot(q.w, q.x), std::hypot(q.y, q.z));
    return std::abs(norm - 1.0) < 1e-6;  // not for NaN either
  };
  if (tf::isFinite(state.base_from_camera) && tf::isFinite(state.fixed_from_camera) &&
      isUnit(state.base_from_camera.rotation) && isUnit(state.fixed_from_camera.rotation) &&
      isUnit(state.heading_zero)) {
    state_ = state;
  }
}

tf::RigidTransform Follow::base(const tf::RigidTransform& fixed_from_frame) const {
  switch (state_.mode) {
    case FollowMode::Position:
      return {glm::dquat(1.0, 0.0, 0.0, 0.0), fixed_from_frame.translation};
    case FollowMode::Heading:
      return {twistAboutZ(fixed_from_frame.rotation * glm::conjugate(state_.heading_zero)),
              fixed_from_frame.translation};
    case FollowMode::Pose:
      return fixed_from_frame;
    case FollowMode::Off:
      break;
  }
  return {};
}

/// The camera's own frame stays where it is in the fixed frame, and is expressed in the base.
void Follow::settle(const Pose& fixed_from_frame, CameraRig& rig) {
  state_.is_waiting = state_.mode != FollowMode::Off && !fixed_from_frame;
  if (state_.is_waiting) {
    return;
  }
  if (state_.mode == FollowMode::Heading) {
    state_.heading_zero = turnAboutZ(-headingOf(fixed_from_frame->rotation)) * fixed_from_frame->rotation;
  }
  const tf::RigidTransform fixed_from_base = base(fixed_from_frame.value_or(tf::RigidTransform{}));
  tf::RigidTransform base_from_camera = tf::inverse(fixed_from_base) * state_.fixed_from_camera;
  if (isUpright(base_from_camera.rotation)) {
    rig.carry(2.0 * std::atan2(base_from_camera.rotation.z, base_from_camera.rotation.w), base_from_camera.translation);
    base_from_camera = {};
  }
  state_.base_from_camera = base_from_camera;
  state_.fixed_from_camera = fixed_from_base * base_from_camera;
}

void Follow::setMode(FollowMode mode, const Pose& fixed_from_frame, CameraRig& rig) {
  state_.mode = mode;
  settle(fixed_from_frame, rig);
}

bool Follow::track(const Pose& fixed_from_frame, CameraRig& rig) {
  if (state_.mode == FollowMode::Off || !fixed_from_frame) {
    return false;
  }
  if (state_.is_waiting) {
    settle(fixed_from_frame, rig);
    return true;
  }
  const tf::RigidTransform before = state_.fixed_from_camera;
  state_.fixed_from_camera = base(*fixed_from_frame) * state_.base_from_camera;
  return before.rotation != state_.fixed_from_camera.rotation ||
         before.translation != state_.fixed_from_camera.translation;
}

void Follow::reset(const Pose& fixed_from_frame) {
  state_.base_from_camera = {};
  state_.is_waiting = state_.mode != FollowMode::Off && !fixed_from_frame;
  if (state_.mode == FollowMode::Heading && fixed_from_frame) {
    state_.heading_zero = turnAboutZ(-headingOf(fixed_from_frame->rotation)) * fixed_from_frame->rotation;
  }
  state_.fixed_from_camera =
      state_.is_waiting ? tf::RigidTransform{} : base(fixed_from_frame.value_or(tf::RigidTransform{}));
}

void Follow::recenter(const Pose& fixed_from_frame, CameraRig& rig) {
  if (state_.mode != FollowMode::Off && !fixed_from_frame) {
    return;
  }
  const tf::RigidTransform fixed_from_old = state_.fixed_from_camera;
  reset(fixed_from_frame);
  const tf::RigidTransform new_from_old = tf::inverse(state_.fixed_from_camera) * fixed_from_old;
  // The direction of sight, the same in the fixed frame; roll is what an upright camera leaves out.
  Sight sight = rig.model().sight();
  const glm::dvec3 back = new_from_old.rotation * eyeAxes(sight.yaw_rad, sight.pitch_rad).back;
  if (!isUpright(new_from_old.rotation)) {
    const double radius_m = sight.radius_m;
    sight = lookingFrom(radius_m * back, {}, sight);
  } else {
    sight.yaw_rad += 2.0 * std::atan2(new_from_old.rotation.z, new_from_old.rotation.w);
  }
  sight.focal_point = fixed_from_frame
                          ? tf::transformPoint(tf::inverse(state_.fixed_from_camera), fixed_from_frame->translation)
                          : tf::transformPoint(new_from_old, rig.model().sight().focal_point);
  rig.look(sight);
}

void Follow::changeFixedFrame(const tf::RigidTransform& new_from_old, const Pose& new_from_frame, CameraRig& rig) {
  state_.fixed_from_camera = new_from_old * state_.fixed_from_camera;
  if (state_.mode == FollowMode::Pose) {
    track(new_from_frame, rig);
    return;
  }
  state_.fixed_from_camera = upright(state_.fixed_from_camera);
  settle(new_from_frame, rig);
}

CameraView Follow::view(const CameraView& view_in_camera) const {
  const tf::RigidTransform& fixed_from_camera = state_.fixed_from_camera;
  CameraView view = view_in_camera;
  if (fixed_from_camera.rotation != glm::dquat(1.0, 0.0, 0.0, 0.0) ||
      fixed_from_camera.translation != glm::dvec3(0.0)) {
    view.eye_from_fixed = view_in_camera.eye_from_fixed * tf::toMatrix(tf::inverse(fixed_from_camera));
  }
  return view;
}

}  // namespace stillframe::scenegraph
