#pragma once

#include "scenegraph/camera/camera_model.h"

namespace stillframe::scenegraph {

/// Moves by itself: the eye stays where it is while it looks about, and W A S D carry it.
class FlyCamera final : public CameraModel {
 public:
  struct State {
    glm::dvec3 eye = eyeOf(Sight{});
    double yaw_rad = Sight{}.yaw_rad;      ///< azimuth that the back of the eye points to, as in a Sight
    double pitch_rad = Sight{}.pitch_rad;  ///< positive looks down
    double reach_m = Sight{}.radius_m;     ///< distance of what is looked at: it sets the pace of every move
    double vertical_fov_rad = Sight{}.vertical_fov_rad;
    friend bool operator==(const State&, const State&) = default;
  };

  [[nodiscard]] const State& state() const noexcept { return state_; }
  void setState(const State& state);

  [[nodiscard]] CameraView view() const override;
  [[nodiscard]] Sight sight() const override;
  void adopt(const Sight& sight) override;
  void carry(double yaw_rad, const glm::dvec3& translation) override;
  /// Looks about: a full widget height is the field of view.
  void rotate(double dx_px, double dy_px, double height_px) override;
  void pan(double dx_px, double dy_px, double height_px) override;
  /// Forward by a tenth of the reach a step, which itself stays.
  void zoom(double steps) override;
  void zoomAt(double steps, const glm::dvec2& from_centre_px, double height_px) override;
  void dolly(double dy_px, double height_px) override;
  /// By the reach a second; up is that of the frame.
  void walk(const glm::dvec3& direction, double seconds) override;
  void frame(const Box& box, double aspect) override;

  /// Multiplies the pace by 1.25 a step.
  void changePace(double steps);

 private:
  State state_;
};

}  // namespace stillframe::scenegraph
