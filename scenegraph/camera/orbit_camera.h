#pragma once

#include <map>
#include <optional>
#include <osg/BoundingBox>
#include <string>

#include "scenegraph/camera/camera.h"

namespace stillframe::scenegraph {

/// Orbits a focal point: yaw and pitch round it, radius from it, Z up. Pure maths, no window. Any single thread.
///
/// Every setter keeps the state finite and in range: pitch within +-90 degrees (straight down is fine), radius
/// 1e-6..1e9 m, focal point within 1e12 m; non-finite input changes nothing. Pixels count as Qt's: x right, y down.
class OrbitCamera {
 public:
  struct State {
    glm::dvec3 focal_point{0.0, 0.0, 0.0};   ///< in the fixed frame
    double yaw_rad = 0.785398163397448279;   ///< azimuth of the eye seen from the focal point
    double pitch_rad = 0.52359877559829882;  ///< elevation of the eye above the focal point
    double radius_m = 10.0;
    double vertical_fov_rad = 0.87266462599716477;
    friend bool operator==(const State&, const State&) = default;
  };

  [[nodiscard]] const State& state() const noexcept { return state_; }
  void setState(const State& state);
  [[nodiscard]] CameraView view() const;
  [[nodiscard]] glm::dvec3 eye() const;

  /// Left drag: a full widget height turns by pi; the scene follows the cursor.
  void rotate(double dx_px, double dy_px, double height_px);
  /// Middle drag: the point under the cursor at the focal depth stays under it.
  void pan(double dx_px, double dy_px, double height_px);
  /// Wheel: radius shrinks by 10 % a step towards the fixed target; negative steps go away.
  void zoom(double steps);
  /// Right drag: along the axis; a full widget height down is ten times the radius, up a tenth.
  void dolly(double dy_px, double height_px);
  /// Sees all of `box` from the present direction; an invalid box changes nothing, a point keeps the radius.
  void frame(const osg::BoundingBoxd& box, double aspect);
  /// Eye and target as `render --eye --look-at` gives them.
  void setLookAt(const glm::dvec3& eye, const glm::dvec3& target);

  /// State as text that reads back exactly, by key; setTexts keeps what is missing, ignores unknown keys
  /// and refuses what is no finite number: it changes nothing then and returns false.
  [[nodiscard]] std::map<std::string, std::string> texts() const;
  bool setTexts(const std::map<std::string, std::string>& texts);

 private:
  State state_;
};

}  // namespace stillframe::scenegraph
