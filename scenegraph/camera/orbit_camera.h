#pragma once

#include "scenegraph/camera/camera_model.h"

namespace stillframe::scenegraph {

/// Orbits a focal point: yaw and pitch round it, radius from it. Its state is a Sight.
class OrbitCamera : public CameraModel {
 public:
  using State = Sight;

  [[nodiscard]] const State& state() const noexcept { return state_; }
  void setState(const State& state);
  [[nodiscard]] glm::dvec3 eye() const { return eyeOf(state_); }
  /// Eye and target as `render --eye --look-at` gives them.
  void setLookAt(const glm::dvec3& eye, const glm::dvec3& target) { setState(lookingFrom(eye, target, state_)); }

  [[nodiscard]] CameraView view() const override;
  [[nodiscard]] Sight sight() const override { return state_; }
  void adopt(const Sight& sight) override { setState(sight); }
  void carry(double yaw_rad, const glm::dvec3& translation) override;
  /// A full widget height turns by pi; the scene follows the cursor.
  void rotate(double dx_px, double dy_px, double height_px) override;
  void pan(double dx_px, double dy_px, double height_px) override;
  void zoom(double steps) override;
  void dolly(double dy_px, double height_px) override;
  /// The focal point moves level, by its distance from the eye a second.
  void walk(const glm::dvec3& direction, double seconds) override;
  void frame(const Box& box, double aspect) override;

 protected:
  /// What `box` is framed round.
  [[nodiscard]] virtual glm::dvec3 focalPointFor(const Box& box) const { return box.centre(); }

 private:
  State state_;
};

/// Orbits a focal point that keeps its height: panning slides along the ground, z = 0 unless the state says otherwise.
class XyOrbitCamera final : public OrbitCamera {
 public:
  XyOrbitCamera();

  /// The focal point becomes where the line of sight meets the ground, so that the view stays as it is; where it meets
  /// it nowhere near, what was looked at is brought to the ground.
  void adopt(const Sight& sight) override;
  void pan(double dx_px, double dy_px, double height_px) override;
  void walk(const glm::dvec3& direction, double seconds) override;

 protected:
  [[nodiscard]] glm::dvec3 focalPointFor(const Box& box) const override;
};

}  // namespace stillframe::scenegraph
