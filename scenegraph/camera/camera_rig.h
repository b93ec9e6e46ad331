#pragma once

#include <array>
#include <expected>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "scenegraph/camera/fly_camera.h"
#include "scenegraph/camera/orbit_camera.h"
#include "scenegraph/camera/top_down_camera.h"
#include "scenegraph/settings.h"

namespace stillframe::scenegraph {

/// All that a rig is: which model is in use, and the state of each.
struct CameraState {
  CameraKind kind = CameraKind::Orbit;
  OrbitCamera::State orbit;
  OrbitCamera::State xy_orbit;
  TopDownCamera::State top_down;
  FlyCamera::State fly;
  /// Models (by CameraKind) that were left for the one in use, with nothing moved since: they come back as they were.
  std::array<bool, 4> is_in_step{};
  friend bool operator==(const CameraState&, const CameraState&) = default;
};

/// The four models of a view's camera, one of them in use. Pure maths. Any single thread.
class CameraRig {
 public:
  [[nodiscard]] CameraKind kind() const noexcept { return kind_; }
  [[nodiscard]] const CameraModel& model() const noexcept { return model(kind_); }
  /// The model in use, to be moved: the others show something else from now on.
  CameraModel& change() noexcept;
  [[nodiscard]] const FlyCamera& fly() const noexcept { return fly_; }
  void changePace(double steps) { fly_.changePace(steps); }

  /// Switches. Back at a model with nothing moved since it was left, exactly its own state returns; else it shows what
  /// the last one showed, as nearly as it can, and keeps of its own what that does not tell.
  void setKind(CameraKind kind);
  [[nodiscard]] CameraView view() const { return model().view(); }
  /// The view on the way from another sight to the present one; from 1 on exactly view().
  [[nodiscard]] CameraView viewFrom(const Sight& from, double fraction) const;

  /// Shows `sight` with the model in use; the ground of XyOrbit goes along, as adopt() leaves it.
  void look(const Sight& sight);
  /// The default direction of the model in use.
  void reset();
  /// Carries every model into another frame.
  void carry(double yaw_rad, const glm::dvec3& translation);

  [[nodiscard]] CameraState state() const;
  /// What is not finite is left as it is, what is out of range comes into it.
  void setState(const CameraState& state);

 private:
  [[nodiscard]] const CameraModel& model(CameraKind kind) const noexcept;
  [[nodiscard]] CameraModel& model(CameraKind kind) noexcept;

  CameraKind kind_ = CameraKind::Orbit;
  OrbitCamera orbit_;
  XyOrbitCamera xy_orbit_;
  TopDownCamera top_down_;
  FlyCamera fly_;
  std::array<bool, 4> is_in_step_{};
};

/// "orbit", "xyorbit", "topdown", "fly".
[[nodiscard]] std::string_view toString(CameraKind kind) noexcept;
[[nodiscard]] std::optional<CameraKind> cameraKindOf(std::string_view text) noexcept;

/// The state as text that reads back bit for bit, by key ("kind", "orbit.yaw_rad", ...).
[[nodiscard]] SettingTexts cameraTexts(const CameraState& state);
/// Reads texts over `state`: keeps what is missing, ignores unknown keys. On an error nothing is changed.
std::expected<void, SettingError> applyCameraTexts(const SettingTexts& texts, CameraState& state);

}  // namespace stillframe::scenegraph
