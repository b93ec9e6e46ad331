#pragma once

#include <numbers>

#include "scenegraph/camera/camera_model.h"

namespace stillframe::scenegraph {

/// Looks straight down without perspective, as at a map: a metre has the same size anywhere in the picture.
class TopDownCamera final : public CameraModel {
 public:
  struct State {
    glm::dvec3 centre{0.0, 0.0, 0.0};          ///< of the picture; its height is the middle of the depths drawn
    double yaw_rad = -std::numbers::pi / 2.0;  ///< direction of the picture's bottom; at first +x right and +y up
    double vertical_extent_m = 10.0;           ///< height of the picture, 1e-6..1e9
    double vertical_fov_rad = Sight{}.vertical_fov_rad;  ///< for the other models, when they take over
    friend bool operator==(const State&, const State&) = default;
  };

  [[nodiscard]] const State& state() const noexcept { return state_; }
  void setState(const State& state);

  [[nodiscard]] CameraView view() const override;
  [[nodiscard]] Sight sight() const override;
  void adopt(const Sight& sight) override;
  void carry(double yaw_rad, const glm::dvec3& translation) override;
  /// Turns the map; a full widget height is pi. dy does nothing.
  void rotate(double dx_px, double dy_px, double height_px) override;
  void pan(double dx_px, double dy_px, double height_px) override;
  void zoom(double steps) override;
  void dolly(double dy_px, double height_px) override;
  void walk(const glm::dvec3& direction, double seconds) override;
  void frame(const Box& box, double aspect) override;

 private:
  void scale(double factor);

  State state_;
};

}  // namespace stillframe::scenegraph
