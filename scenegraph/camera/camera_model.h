#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "scenegraph/camera/box.h"
#include "scenegraph/camera/camera.h"

namespace stillframe::scenegraph {

/// What is looked at, from where and how widely, in terms that every model of a camera understands.
///
/// The pitch stays within +-90 degrees (straight down is fine), the radius within 1e-6..1e9 m, the focal point within
/// 1e12 m.
struct Sight {
  glm::dvec3 focal_point{0.0, 0.0, 0.0};   ///< in the frame that the camera lives in
  double yaw_rad = 0.785398163397448279;   ///< azimuth of the eye seen from the focal point
  double pitch_rad = 0.52359877559829882;  ///< elevation of the eye above the focal point
  double radius_m = 10.0;                  ///< from the eye to the focal point
  double vertical_fov_rad = 0.87266462599716477;

  friend bool operator==(const Sight&, const Sight&) = default;
};

/// Which model of a camera.
enum class CameraKind : std::uint8_t {
  Orbit,         ///< turns round a focal point anywhere
  XyOrbit,       ///< turns round a focal point that stays at one height, on the ground
  TopDownOrtho,  ///< looks straight down, without perspective
  Fly,           ///< moves by itself, W A S D
};
inline constexpr CameraKind kCameraKinds[] = {CameraKind::Orbit, CameraKind::XyOrbit, CameraKind::TopDownOrtho,
                                              CameraKind::Fly};

/// One way to move through a scene, Z up: state, and gestures upon it. Pure maths. Any single thread.
///
/// Whatever the input, the state stays finite and in range; input that is not finite changes nothing. Pixels count as
/// Qt's: x right, y down.
class CameraModel {
 public:
  CameraModel() = default;
  CameraModel(const CameraModel&) = default;
  CameraModel& operator=(const CameraModel&) = default;
  virtual ~CameraModel() = default;

  [[nodiscard]] virtual CameraView view() const = 0;
  [[nodiscard]] virtual Sight sight() const = 0;
  /// Shows what `sight` shows, as nearly as the model can.
  virtual void adopt(const Sight& sight) = 0;
  /// Goes on showing the same when the frame it lives in is another: turned about Z by `yaw_rad`, then moved.
  virtual void carry(double yaw_rad, const glm::dvec3& translation) = 0;

  /// Left drag.
  virtual void rotate(double dx_px, double dy_px, double height_px) = 0;
  /// Middle drag: what is under the cursor at the focal depth stays under it.
  virtual void pan(double dx_px, double dy_px, double height_px) = 0;
  /// Wheel: a tenth nearer a step towards the fixed target; negative steps go away.
  virtual void zoom(double steps) = 0;
  /// Wheel towards what is under the cursor, `from_centre_px` from the middle of the picture.
  virtual void zoomAt(double steps, const glm::dvec2& from_centre_px, double height_px);
  /// Right drag: along the axis; a full height down is ten times as far, up a tenth.
  virtual void dolly(double dy_px, double height_px) = 0;
  /// Keys: `direction` is right, up and forward, each -1..1; a second takes it as far as what it looks at.
  virtual void walk(const glm::dvec3& direction, double seconds) = 0;
  /// Sees all of `box` from the present direction; an invalid box changes nothing, a point keeps the distance.
  virtual void frame(const Box& box, double aspect) = 0;
};

/// Axes of the eye in the frame it lives in; `back` points from what is looked at to the eye. Without a singular
/// direction.
struct EyeAxes {
  glm::dvec3 right;
  glm::dvec3 up;
  glm::dvec3 back;
};
[[nodiscard]] EyeAxes eyeAxes(double yaw_rad, double pitch_rad);
[[nodiscard]] glm::dvec3 eyeOf(const Sight& sight);
[[nodiscard]] bool isFinite(const Sight& sight);
/// A finite sight within its ranges; one in range is not touched in any bit.
[[nodiscard]] Sight inRange(Sight sight);
/// `sight` with its eye and focal point moved there; straight up and down, +y is up in the picture.
[[nodiscard]] Sight lookingFrom(const glm::dvec3& eye, const glm::dvec3& target, Sight sight);
/// The same place seen in a frame turned about Z and moved.
[[nodiscard]] Sight carried(Sight sight, double yaw_rad, const glm::dvec3& translation);
/// Distance from `focal_point` at which all of `box` fits the picture; 0 for a point there.
[[nodiscard]] double distanceToSee(const Box& box, const Sight& sight, double aspect);
/// Between two sights, 0..1: turned the short way, zoomed by equal ratios. Exactly the ends at the ends.
[[nodiscard]] Sight mix(const Sight& from, const Sight& to, double fraction);

}  // namespace stillframe::scenegraph
