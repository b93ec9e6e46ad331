#include "scenegraph/pick/scene_pick.h"

#include <glm/geometric.hpp>

namespace stillframe::scenegraph {

const char* toString(PickError error) noexcept {
  switch (error) {
    case PickError::NothingThere:
      return "NothingThere";
    case PickError::Undescribed:
      return "Undescribed";
  }
  return "NothingThere";
}

std::expected<PickResult, PickError> describeHits(const Scene& scene, std::span<const PickHit> hits) {
  for (const PickHit& hit : hits) {
    const auto fixed_from_frame = scene.frames().fixedFromFrame(hit.frame);
    for (const auto& slot : scene.layers()) {
      auto picked = slot->layer->isVisible() ? slot->layer->describe(hit) : std::nullopt;
      if (picked && fixed_from_frame) {
        const glm::dvec3 point_in_fixed = tf::transformPoint(*fixed_from_frame, picked->point_in_frame);
        return PickResult{slot->topic,          std::string(slot->type->label), hit.frame,
                          std::move(*picked),   scene.frames().fixedFrame(),    point_in_fixed,
                          scene.frames().time()};
      }
    }
  }
  return std::unexpected(hits.empty() ? PickError::NothingThere : PickError::Undescribed);
}

std::optional<glm::dvec3> pointIn(const Scene& scene, const PickResult& result, const std::string& frame) {
  if (frame == result.frame) {
    return result.picked.point_in_frame;
  }
  const auto fixed_from_source = scene.frames().fixedFromFrame(result.frame);
  const auto fixed_from_other = scene.frames().fixedFromFrame(frame);
  if (!fixed_from_source || !fixed_from_other) {
    return std::nullopt;
  }
  return tf::transformPoint(tf::inverse(*fixed_from_other) * *fixed_from_source, result.picked.point_in_frame);
}

std::optional<glm::dvec3> pointInFixedNow(const Scene& scene, const PickResult& result) {
  const auto fixed_from_frame = scene.frames().fixedFromFrame(result.frame);
  return fixed_from_frame ? std::optional(tf::transformPoint(*fixed_from_frame, result.picked.point_in_frame))
                          : std::nullopt;
}

std::string pointText(const glm::dvec3& point) {
  return pickText(point.x) + " " + pickText(point.y) + " " + pickText(point.z);
}

std::vector<std::pair<std::string, std::string>> pickRows(const Scene& scene, const PickResult& result,
                                                          const std::string& display_frame) {
  std::vector<std::pair<std::string, std::string>> rows;
  rows.emplace_back("topic", result.topic);
  rows.emplace_back(result.picked.kind, result.picked.id);
  if (result.picked.stamp) {
    rows.emplace_back("stamp_ns", std::to_string(result.picked.stamp->ns));
  }
  rows.emplace_back("in " + result.frame, pointText(result.picked.point_in_frame));
  std::vector<std::string> frames{scene.frames().fixedFrame()};
  if (!display_frame.empty() && display_frame != frames.front()) {
    frames.push_back(display_frame);
  }
  for (const std::string& frame : frames) {
    const auto point = frame == result.frame ? std::nullopt : pointIn(scene, result, frame);
    if (point) {
      rows.emplace_back("in " + frame, pointText(*point));
    }
  }
  for (const auto& [name, value] : result.picked.fields) {
    rows.emplace_back(name, pickText(value));
  }
  return rows;
}

Measurement measure(const glm::dvec3& from_in_fixed, const glm::dvec3& to_in_fixed) {
  const glm::dvec3 delta = to_in_fixed - from_in_fixed;
  return {delta, glm::length(delta)};
}

}  // namespace stillframe::scenegraph
