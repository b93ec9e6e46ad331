// FollowState as text.
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/camera/follow.h"

namespace stillframe::scenegraph {
namespace {

constexpr std::array<std::string_view, 4> kModeTexts = {"off", "position", "heading", "pose"};

using FollowNumbers = std::vector<std::pair<std::string, double*>>;

void addRotation(FollowNumbers& numbers, const std::string& key, glm::dquat& rotation) {
  numbers.emplace_back(key + ".qw", &rotation.w);
  numbers.emplace_back(key + ".qx", &rotation.x);
  numbers.emplace_back(key + ".qy", &rotation.y);
  numbers.emplace_back(key + ".qz", &rotation.z);
}

void addTransform(FollowNumbers& numbers, const std::string& key, tf::RigidTransform& transform) {
  numbers.emplace_back(key + ".x", &transform.translation.x);
  numbers.emplace_back(key + ".y", &transform.translation.y);
  numbers.emplace_back(key + ".z", &transform.translation.z);
  addRotation(numbers, key, transform.rotation);
}

/// Every number of a state, by key.
FollowNumbers numbersOf(FollowState& state) {
  FollowNumbers numbers;
  addTransform(numbers, "base_from_camera", state.base_from_camera);
  addRotation(numbers, "heading_zero", state.heading_zero);
  addTransform(numbers, "fixed_from_camera", state.fixed_from_camera);
  return numbers;
}

}  // namespace

std::string_view toString(FollowMode mode) noexcept { return kModeTexts[static_cast<std::size_t>(mode)]; }

std::optional<FollowMode> followModeOf(std::string_view text) noexcept {
  for (const FollowMode mode : kFollowModes) {
    if (toString(mode) == text) {
      return mode;
    }
  }
  return std::nullopt;
}

SettingTexts followTexts(const FollowState& state) {
  FollowState copy = state;
  SettingTexts texts{{"mode", std::string(toString(state.mode))}, {"is_waiting", settingText(state.is_waiting)}};
  for (const auto& [key, number] : numbersOf(copy)) {
    texts[key] = settingText(*number);
  }
  return texts;
}

std::expected<void, SettingError> applyFollowTexts(const SettingTexts& texts, FollowState& state) {
  FollowState changed = state;
  if (const auto found = texts.find("mode"); found != texts.end()) {
    const auto mode = followModeOf(found->second);
    if (!mode) {
      return std::unexpected(SettingError{
          "BadValue", "mode: '" + found->second + "' is no way to follow; there are off, position, heading and pose"});
    }
    changed.mode = *mode;
  }
  SettingSpec spec;
  if (const auto found = texts.find("is_waiting"); found != texts.end()) {
    spec.key = "is_waiting";
    spec.kind = SettingKind::Bool;
    const auto value = parseSetting(spec, found->second);
    if (!value) {
      return std::unexpected(value.error());
    }
    changed.is_waiting = std::get<bool>(*value);
  }
  spec.kind = SettingKind::Double;
  for (const auto& [key, number] : numbersOf(changed)) {
    if (const auto found = texts.find(key); found != texts.end()) {
      spec.key = key;
      const auto value = parseSetting(spec, found->second);
      if (!value) {
        return std::unexpected(value.error());
      }
      *number = std::get<double>(*value);
    }
  }
  state = changed;
  return {};
}

}  // namespace stillframe::scenegraph
