// What TfAxesLayer says of a frame that is picked.
#include <algorithm>

#include "nodes/tf_axes/tf_axes_layer.h"

namespace stillframe::nodes {

std::optional<scenegraph::Picked> TfAxesLayer::describe(const scenegraph::PickHit& hit) const {
  const auto shown = std::ranges::find_if(
      shown_, [&](const Shown& one) { return one.name == hit.frame && hit.isBeneath(*one.group); });
  if (shown == shown_.end()) {
    return std::nullopt;
  }
  const tf::TransformBuffer& buffer = context_->frames.buffer();
  scenegraph::Picked picked{.kind = "frame",
                            .id = shown->name,
                            .point_in_frame = {},
                            .stamp = buffer.stampInForce(shown->id, applied_->time),
                            .fields = {},
                            .radius_m = std::max(1.0, 2.0 * settings_.axis_length_m)};
  if (shown->parent != tf::kNoFrame) {
    picked.add("parent", buffer.frameName(shown->parent));
    picked.add("is_static", shown->is_static);
    picked.add("is_stale", shown->is_stale);
    if (const auto parent_from_frame = buffer.tryLookupTransform(shown->parent, shown->id, applied_->time)) {
      picked.addPose("in_parent", *parent_from_frame);
    }
  }
  return picked;
}

}  // namespace stillframe::nodes
