// What TfAxesLayer says of itself: a frame that is picked, where frames lie, its nodes and counts.
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

std::vector<scenegraph::Box> TfAxesLayer::bulkInFixed() const {
  std::vector<scenegraph::Box> boxes;
  for (const Shown& shown : shown_) {
    if (const auto fixed_from_frame = context_->frames.fixedFromFrame(shown.name)) {
      const glm::dvec3& at = fixed_from_frame->translation;
      boxes.push_back({at - settings_.axis_length_m, at + settings_.axis_length_m});
    }
  }
  return boxes;
}

void TfAxesLayer::collectNodes(std::vector<osg::Node*>& nodes) const {
  for (const Shown& shown : shown_) {
    nodes.push_back(shown.group);
  }
}

scenegraph::LayerCounts TfAxesLayer::counts() const {
  scenegraph::LayerCounts counts{{"frames", shown_.size()}, {"unresolved", shown_.size() - resolved_}};
  if (const auto stale = std::ranges::count_if(shown_, &Shown::is_stale); stale > 0) {
    counts.emplace_back("stale", static_cast<std::uint64_t>(stale));
  }
  if (left_out_ > 0) {
    counts.emplace_back("left_out", left_out_);
  }
  return counts;
}

}  // namespace stillframe::nodes
