#include "scenegraph/camera/camera_rig.h"

#include <utility>
#include <vector>

namespace stillframe::scenegraph {
namespace {

constexpr std::array<std::string_view, 4> kKindTexts = {"orbit", "xyorbit", "topdown", "fly"};

std::size_t indexOf(CameraKind kind) { return static_cast<std::size_t>(kind); }

using Numbers = std::vector<std::pair<std::string, double*>>;

void addPoint(Numbers& numbers, const std::string& key, glm::dvec3& point) {
  numbers.emplace_back(key + "_x", &point.x);
  numbers.emplace_back(key + "_y", &point.y);
  numbers.emplace_back(key + "_z", &point.z);
}

void addSight(Numbers& numbers, const std::string& key, Sight& sight) {
  addPoint(numbers, key + ".focal", sight.focal_point);
  numbers.emplace_back(key + ".yaw_rad", &sight.yaw_rad);
  numbers.emplace_back(key + ".pitch_rad", &sight.pitch_rad);
  numbers.emplace_back(key + ".radius_m", &sight.radius_m);
  numbers.emplace_back(key + ".fov_rad", &sight.vertical_fov_rad);
}

/// Every number of a state, by key.
Numbers numbersOf(CameraState& state) {
  Numbers numbers;
  addSight(numbers, "orbit", state.orbit);
  addSight(numbers, "xyorbit", state.xy_orbit);
  addPoint(numbers, "topdown.centre", state.top_down.centre);
  numbers.emplace_back("topdown.yaw_rad", &state.top_down.yaw_rad);
  numbers.emplace_back("topdown.extent_m", &state.top_down.vertical_extent_m);
  numbers.emplace_back("topdown.fov_rad", &state.top_down.vertical_fov_rad);
  addPoint(numbers, "fly.eye", state.fly.eye);
  numbers.emplace_back("fly.yaw_rad", &state.fly.yaw_rad);
  numbers.emplace_back("fly.pitch_rad", &state.fly.pitch_rad);
  numbers.emplace_back("fly.reach_m", &state.fly.reach_m);
  numbers.emplace_back("fly.fov_rad", &state.fly.vertical_fov_rad);
  return numbers;
}

std::string inStepKey(CameraKind kind) { return std::string(toString(kind)) + ".in_step"; }

}  // namespace

std::string_view toString(CameraKind kind) noexcept { return kKindTexts[indexOf(kind)]; }

std::optional<CameraKind> cameraKindOf(std::string_view text) noexcept {
  for (const CameraKind kind : kCameraKinds) {
    if (toString(kind) == text) {
      return kind;
    }
  }
  return std::nullopt;
}

const CameraModel& CameraRig::model(CameraKind kind) const noexcept {
  switch (kind) {
    case CameraKind::XyOrbit:
      return xy_orbit_;
    case CameraKind::TopDownOrtho:
      return top_down_;
    case CameraKind::Fly:
      return fly_;
    case CameraKind::Orbit:
      break;
  }
  return orbit_;
}

CameraModel& CameraRig::model(CameraKind kind) noexcept {
  return const_cast<CameraModel&>(std::as_const(*this).model(kind));  // this is not const, nor are its members
}

CameraModel& CameraRig::change() noexcept {
  is_in_step_.fill(false);
  return model(kind_);
}

void CameraRig::setKind(CameraKind kind) {
  if (kind == kind_) {
    return;
  }
  if (!is_in_step_[indexOf(kind)]) {
    model(kind).adopt(model().sight());
  }
  is_in_step_[indexOf(kind_)] = true;
  kind_ = kind;
  is_in_step_[indexOf(kind_)] = false;
}

CameraView CameraRig::viewFrom(const Sight& from, double fraction) const {
  if (!(fraction < 1.0)) {
    return view();
  }
  CameraRig between = *this;
  between.change().adopt(mix(from, model().sight(), fraction));
  return between.view();
}

void CameraRig::look(const Sight& sight) {
  CameraModel& model = change();
  if (kind_ == CameraKind::XyOrbit) {
    xy_orbit_.setState(sight);
  } else {
    model.adopt(sight);
  }
}

void CameraRig::reset() {
  Sight level;
  level.vertical_fov_rad = model().sight().vertical_fov_rad;
  if (kind_ == CameraKind::TopDownOrtho) {
    level.yaw_rad = TopDownCamera::State{}.yaw_rad;
  }
  look(level);
}

void CameraRig::carry(double yaw_rad, const glm::dvec3& translation) {
  for (const CameraKind kind : kCameraKinds) {
    model(kind).carry(yaw_rad, translation);
  }
}

CameraState CameraRig::state() const {
  return {kind_, orbit_.state(), xy_orbit_.state(), top_down_.state(), fly_.state(), is_in_step_};
}

void CameraRig::setState(const CameraState& state) {
  kind_ = indexOf(state.kind) < kKindTexts.size() ? state.kind : CameraKind::Orbit;
  orbit_.setState(state.orbit);
  xy_orbit_.setState(state.xy_orbit);
  top_down_.setState(state.top_down);
  fly_.setState(state.fly);
  is_in_step_ = state.is_in_step;
}

SettingTexts cameraTexts(const CameraState& state) {
  SettingTexts texts;
  texts["kind"] = toString(state.kind);
  CameraState copy = state;
  for (const auto& [key, number] : numbersOf(copy)) {
    texts[key] = settingText(*number);
  }
  for (const CameraKind kind : kCameraKinds) {
    texts[inStepKey(kind)] = settingText(state.is_in_step[indexOf(kind)]);
  }
  return texts;
}

std::expected<void, SettingError> applyCameraTexts(const SettingTexts& texts, CameraState& state) {
  CameraState changed = state;
  if (const auto found = texts.find("kind"); found != texts.end()) {
    const auto kind = cameraKindOf(found->second);
    if (!kind) {
      return std::unexpected(SettingError{
          "BadValue", "kind: '" + found->second + "' is no camera; there are orbit, xyorbit, topdown and fly"});
    }
    changed.kind = *kind;
  }
  SettingSpec spec;
  for (const auto& [key, number] : numbersOf(changed)) {
    if (const auto found = texts.find(key); found != texts.end()) {
      spec.key = key;
      spec.kind = SettingKind::Double;
      const auto value = parseSetting(spec, found->second);
      if (!value) {
        return std::unexpected(value.error());
      }
      *number = std::get<double>(*value);
    }
  }
  for (const CameraKind kind : kCameraKinds) {
    if (const auto found = texts.find(inStepKey(kind)); found != texts.end()) {
      spec.key = inStepKey(kind);
      spec.kind = SettingKind::Bool;
      const auto value = parseSetting(spec, found->second);
      if (!value) {
        return std::unexpected(value.error());
      }
      changed.is_in_step[indexOf(kind)] = std::get<bool>(*value);
    }
  }
  state = changed;
  return {};
}

}  // namespace stillframe::scenegraph
