#include "scenegraph/pick/place_picks.h"

#include <array>
#include <cstdio>
#include <glm/common.hpp>
#include <set>

namespace stillframe::scenegraph {

PlacedPicks placePicks(const Scene& scene, const CameraView& view, const PictureSize& size, const PickMarks& picks) {
  PlacedPicks placed;
  const auto selected = picks.selected ? pointInFixedNow(scene, *picks.selected) : std::nullopt;
  if (const auto at = selected ? toScreen(view, size, *selected) : std::nullopt) {
    placed.ring_px = at->position_px;
  }
  for (const PickMarks::Pair& pair : picks.measured) {
    const auto from = pointInFixedNow(scene, pair.first);
    const auto to = pointInFixedNow(scene, pair.second);
    if (const auto seen = from && to ? toScreen(view, size, *from, *to) : std::nullopt) {
      placed.lines.push_back({seen->first, seen->second, measurementText(measure(*from, *to))});
    }
  }
  return placed;
}

std::optional<glm::dvec2> textCorner(const PlacedPicks::Line& line, const glm::dvec2& text_px,
                                     const PictureSize& size) {
  const glm::dvec2 picture_px(size.width_px, size.height_px);
  const glm::dvec2 middle = (line.from_px + line.to_px) / 2.0;
  if (!(middle.x > 0.0 && middle.y > 0.0 && middle.x < picture_px.x && middle.y < picture_px.y)) {
    return std::nullopt;
  }
  const glm::dvec2 wanted = middle - glm::dvec2(0.5, 1.5) * text_px;
  return glm::clamp(wanted, glm::dvec2(0.0), glm::max(picture_px - text_px, glm::dvec2(0.0)));
}

std::optional<Measurement> measureNow(const Scene& scene, const PickMarks::Pair& pair) {
  const auto from = pointInFixedNow(scene, pair.first);
  const auto to = pointInFixedNow(scene, pair.second);
  return from && to ? std::optional(measure(*from, *to)) : std::nullopt;
}

std::string measurementText(const Measurement& measurement) {
  const glm::dvec3& delta = measurement.delta_in_fixed;
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%.6g m  (dx %.6g, dy %.6g, dz %.6g)", measurement.length_m, delta.x, delta.y,
                delta.z);
  return text.data();
}

std::vector<std::string> framesOf(const PickMarks& picks) {
  std::set<std::string> frames;
  if (picks.selected) {
    frames.insert(picks.selected->frame);
  }
  for (const auto& [from, to] : picks.measured) {
    frames.insert(from.frame);
    frames.insert(to.frame);
  }
  return {frames.begin(), frames.end()};
}

}  // namespace stillframe::scenegraph
