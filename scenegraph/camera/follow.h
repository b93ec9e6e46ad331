#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string_view>

#include "scenegraph/camera/camera_rig.h"
#include "tf/rigid_transform.h"

namespace stillframe::scenegraph {

/// How the frame that a camera lives in goes along with the followed frame.
enum class FollowMode : std::uint8_t {
  Off,       ///< stands still in the fixed frame
  Position,  ///< goes along, keeps its direction
  Heading,   ///< goes along and turns about the vertical
  Pose,      ///< goes along rigidly: the followed frame stands still in the picture
};
inline constexpr FollowMode kFollowModes[] = {FollowMode::Off, FollowMode::Position, FollowMode::Heading,
                                              FollowMode::Pose};

/// All that a follow is. The base is the place and direction that `mode` takes from the followed frame.
struct FollowState {
  FollowMode mode = FollowMode::Off;
  /// The camera's own frame in the base: the identity, or what keeps the view as it was when that cannot be told to the
  /// camera, whose models stand upright.
  tf::RigidTransform base_from_camera;
  /// Heading: an attitude of the followed frame that counts as heading zero. The heading is what has turned about the
  /// vertical since: a frame may pitch through 90 degrees, or be mounted upside down, and the view does not flip.
  glm::dquat heading_zero{1.0, 0.0, 0.0, 0.0};
  /// Where the camera's own frame was last: it stays there while the followed frame has no place.
  tf::RigidTransform fixed_from_camera;
  /// The followed frame had no place when the mode was chosen: the view is taken up when it has one.
  bool is_waiting = false;
};
[[nodiscard]] bool operator==(const FollowState& a, const FollowState& b) noexcept;

/// Carries a camera along with a frame, without a jump when it is switched. Pure maths. Any single thread.
///
/// `fixed_from_frame` is the followed frame at the very tick that the data is drawn for; absent while it has no place.
class Follow {
 public:
  using Pose = std::optional<tf::RigidTransform>;

  [[nodiscard]] const FollowState& state() const noexcept { return state_; }
  /// Goes on from there; what is not finite is refused.
  void setState(const FollowState& state);
  [[nodiscard]] FollowMode mode() const noexcept { return state_.mode; }

  /// Another mode, or another frame in the same mode. The view stays as it is: what the camera can express is carried
  /// over in `rig`, the rest (the tilt of a frame) stays between the base and the camera.
  void setMode(FollowMode mode, const Pose& fixed_from_frame, CameraRig& rig);
  /// A new tick. Returns whether the camera was moved.
  bool track(const Pose& fixed_from_frame, CameraRig& rig);
  /// The frame comes to the middle of the picture, seen upright from where it was seen, at the same distance.
  void recenter(const Pose& fixed_from_frame, CameraRig& rig);
  /// Upright in the base, for a new view; in the fixed frame until the followed one has a place. Frames nothing.
  void reset(const Pose& fixed_from_frame);
  /// The fixed frame is another now: the view of the data stays, upright in the new frame unless the mode is Pose.
  void changeFixedFrame(const tf::RigidTransform& new_from_old, const Pose& new_from_frame, CameraRig& rig);

  [[nodiscard]] const tf::RigidTransform& fixedFromCamera() const noexcept { return state_.fixed_from_camera; }
  /// The rig's view, from the fixed frame.
  [[nodiscard]] CameraView view(const CameraView& view_in_camera) const;

 private:
  [[nodiscard]] tf::RigidTransform base(const tf::RigidTransform& fixed_from_frame) const;
  void settle(const Pose& fixed_from_frame, CameraRig& rig);

  FollowState state_;
};

/// "off", "position", "heading", "pose".
[[nodiscard]] std::string_view toString(FollowMode mode) noexcept;
[[nodiscard]] std::optional<FollowMode> followModeOf(std::string_view text) noexcept;

/// What `rotation` turns about Z: the twist of a swing-twist decomposition, which flips nowhere but upside down.
[[nodiscard]] glm::dquat twistAboutZ(const glm::dquat& rotation) noexcept;
/// Direction of the X axis in the plane; where that stands upright, of the twist.
[[nodiscard]] double headingOf(const glm::dquat& rotation) noexcept;

/// The state as text that reads back bit for bit, by key ("mode", "offset.x", ...), as cameraTexts().
[[nodiscard]] SettingTexts followTexts(const FollowState& state);
std::expected<void, SettingError> applyFollowTexts(const SettingTexts& texts, FollowState& state);

}  // namespace stillframe::scenegraph
