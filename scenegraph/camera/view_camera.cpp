#include "scenegraph/camera/view_camera.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stillframe::scenegraph {
namespace {

/// Slow at both ends.
double eased(double fraction) {
  const double x = std::clamp(fraction, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

}  // namespace

void ViewCamera::setState(const ViewpointState& state) {
  move_.reset();
  rig_.setState(state.camera);
  follow_.setState(state.follow);
  display_frame_ = state.display_frame;
}

Sight ViewCamera::shown(double now_s) const {
  return isMoving(now_s) ? mix(move_->from, sight(), eased((now_s - move_->start_s) / kMoveSeconds)) : sight();
}

CameraView ViewCamera::view(double now_s) const {
  return follow_.view(isMoving(now_s) ? rig_.viewFrom(move_->from, eased((now_s - move_->start_s) / kMoveSeconds))
                                      : rig_.view());
}

void ViewCamera::endMove(double now_s) {
  if (isMoving(now_s)) {
    rig_.look(shown(now_s));
  }
  move_.reset();
}

CameraModel& ViewCamera::grasp(double now_s) {
  endMove(now_s);
  return rig_.change();
}

void ViewCamera::beginMove(double now_s, bool is_smooth) {
  if (is_smooth) {
    move_ = Move{shown(now_s), now_s};
  } else {
    move_.reset();
  }
}

void ViewCamera::frame(const Box& box_in_fixed, double aspect) {
  rig_.change().frame(transformBox(tf::inverse(follow_.fixedFromCamera()), box_in_fixed), aspect);
}

void ViewCamera::reset(const Pose& fixed_from_display) {
  follow_.reset(fixed_from_display);
  rig_.reset();
}

void ViewCamera::lookAtPoint(const glm::dvec3& point_in_fixed) {
  Sight sight = this->sight();
  sight.focal_point = tf::transformPoint(tf::inverse(follow_.fixedFromCamera()), point_in_fixed);
  rig_.change().adopt(sight);
}

void ViewCamera::setKind(CameraKind kind, double now_s) {
  endMove(now_s);
  rig_.setKind(kind);
}

void ViewCamera::setFollow(FollowMode mode, const Pose& fixed_from_display, double now_s) {
  endMove(now_s);
  follow_.setMode(mode, fixed_from_display, rig_);
}

void ViewCamera::setDisplayFrame(std::optional<std::string> frame, const Pose& fixed_from_display, double now_s) {
  display_frame_ = std::move(frame);
  setFollow(follow_.mode(), fixed_from_display, now_s);
}

void ViewCamera::recenter(const Pose& fixed_from_display) {
  const tf::RigidTransform fixed_from_old = follow_.fixedFromCamera();
  follow_.recenter(fixed_from_display, rig_);
  if (move_) {
    const tf::RigidTransform new_from_old = tf::inverse(follow_.fixedFromCamera()) * fixed_from_old;
    move_->from = carried(move_->from, headingOf(new_from_old.rotation), new_from_old.translation);
  }
}

bool ViewCamera::track(const Pose& fixed_from_display) { return follow_.track(fixed_from_display, rig_); }

void ViewCamera::changeFixedFrame(const tf::RigidTransform& new_from_old, const Pose& new_from_display) {
  move_.reset();
  follow_.changeFixedFrame(new_from_old, new_from_display, rig_);
}

}  // namespace stillframe::scenegraph
