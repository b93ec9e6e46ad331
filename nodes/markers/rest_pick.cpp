// Which entity's line, triangle, model or text is hit.
#include <algorithm>

#include "nodes/markers/rest_parts.h"

namespace stillframe::nodes {
namespace {

/// The slot whose part holds number `index`.
std::optional<std::size_t> slotAt(const std::vector<std::pair<std::size_t, std::size_t>>& ends, std::size_t index) {
  const auto found = std::ranges::upper_bound(ends, index, {}, &std::pair<std::size_t, std::size_t>::first);
  return found == ends.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

std::optional<RestParts::RestHit> RestParts::entityAt(const scenegraph::PickHit& hit) const {
  for (const std::size_t i : {0U, 1U}) {
    if (hit.isBeneath(*strokes_[i].node)) {
      const auto segment = strokes_[i].lines->segmentAt(hit);
      const auto slot = segment ? slotAt(strokes_[i].ends, segment->end) : std::nullopt;
      return slot ? std::optional(RestHit{*slot, "line", segment->point_in_frame}) : std::nullopt;
    }
    if (hit.isBeneath(surfaces_[i]->node())) {
      const auto slot = slotAt(surface_ends_[i], hit.primitive);
      return slot ? std::optional(RestHit{*slot, "triangles", scenegraph::surfacePoint(hit)}) : std::nullopt;
    }
  }
  if (hit.isBeneath(models_.node())) {
    const auto slot = models_.slotOf(hit.childOf(models_.node()));
    return slot ? std::optional(RestHit{*slot, "model", scenegraph::surfacePoint(hit)}) : std::nullopt;
  }
  for (const auto& [slot, texts] : texts_) {
    if (hit.isBeneath(*texts.node)) {
      const osg::Vec3d at = hit.frame_from_local.getTrans();
      return RestHit{slot, "text", {at.x(), at.y(), at.z()}};
    }
  }
  return std::nullopt;
}

}  // namespace stillframe::nodes
