#pragma once

#include <optional>
#include <string>

#include "scenegraph/camera/follow.h"

namespace stillframe::scenegraph {

/// All that a view looks with, in plain values: what is saved and restored, exactly.
struct ViewpointState {
  CameraState camera;
  FollowState follow;
  std::optional<std::string>
      display_frame;  ///< the frame that is followed; absent: the fixed frame, which stands still
  friend bool operator==(const ViewpointState&, const ViewpointState&) = default;
};

/// A named place to look from.
struct SavedView {
  std::string name;
  ViewpointState viewpoint;
  friend bool operator==(const SavedView&, const SavedView&) = default;
};

/// The camera of one view: its models, what it goes along with, and smooth moves between two places. Pure maths, its
/// clock is the caller's seconds. Any single thread.
class ViewCamera {
 public:
  using Pose = Follow::Pose;

  [[nodiscard]] const CameraRig& rig() const noexcept { return rig_; }
  [[nodiscard]] const Follow& follow() const noexcept { return follow_; }
  [[nodiscard]] const std::optional<std::string>& displayFrame() const noexcept { return display_frame_; }
  [[nodiscard]] ViewpointState state() const { return {rig_.state(), follow_.state(), display_frame_}; }
  /// At once; where the followed frame has no place, the view is that of the moment it was saved.
  void setState(const ViewpointState& state);

  /// What the models show, seen from the frame the camera lives in; the end of a move under way.
  [[nodiscard]] Sight sight() const { return rig_.model().sight(); }
  /// The view from the fixed frame at that moment of a move.
  [[nodiscard]] CameraView view(double now_s) const;
  [[nodiscard]] bool isMoving(double now_s) const noexcept { return move_ && now_s < move_->start_s + kMoveSeconds; }

  /// The model in use, for a gesture: a move under way ends where it is.
  CameraModel& grasp(double now_s);
  void changePace(double steps) { rig_.changePace(steps); }
  /// The changes that follow are made at once, or reached smoothly when `is_smooth`.
  void beginMove(double now_s, bool is_smooth);
  /// Glides from `from`, in the frame the camera lives in, to where the camera is.
  void glideFrom(const Sight& from, double now_s) { move_ = Move{from, now_s}; }
  void look(const Sight& sight) { rig_.look(sight); }
  /// Sees a box of the fixed frame from the present direction.
  void frame(const Box& box_in_fixed, double aspect);
  /// Upright, from the default direction.
  void reset(const Pose& fixed_from_display);
  /// A point of the fixed frame comes to the middle of the picture.
  void lookAtPoint(const glm::dvec3& point_in_fixed);

  void setKind(CameraKind kind, double now_s);
  void setFollow(FollowMode mode, const Pose& fixed_from_display, double now_s);
  void setDisplayFrame(std::optional<std::string> frame, const Pose& fixed_from_display, double now_s);
  /// Snaps the followed frame to the middle; smoothly within a move.
  void recenter(const Pose& fixed_from_display);
  /// A new tick: the followed frame is there now. Returns whether the camera was moved.
  bool track(const Pose& fixed_from_display);
  void changeFixedFrame(const tf::RigidTransform& new_from_old, const Pose& new_from_display);

  static constexpr double kMoveSeconds = 0.25;

 private:
  struct Move {
    Sight from;
    double start_s = 0.0;
  };
  [[nodiscard]] Sight shown(double now_s) const;
  void endMove(double now_s);

  CameraRig rig_;
  Follow follow_;
  std::optional<std::string> display_frame_;
  std::optional<Move> move_;
};

}  // namespace stillframe::scenegraph
