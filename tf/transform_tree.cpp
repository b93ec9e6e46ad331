#include "tf/transform_tree.h"

#include <algorithm>
#include <limits>

#include "tf/chain_accumulator.h"
#include "tf/wide_transform.h"

namespace stillframe::tf {

std::expected<TransformTree::CheckedSample, InsertError> TransformTree::check(
    const TransformSample& sample) const noexcept {
  const std::string_view parent = stripLeadingSlashes(sample.parent);
  const std::string_view child = stripLeadingSlashes(sample.child);
  if (parent.empty() || child.empty()) {
    return std::unexpected(InsertError::EmptyFrameName);
  }
  if (parent == child) {
    return std::unexpected(InsertError::SelfLoop);
  }
  if (!isFinite(sample.parent_from_child)) {
    return std::unexpected(InsertError::NotFinite);
  }
  const auto rotation = normalizedRotation(sample.parent_from_child.rotation);
  if (!rotation) {
    return std::unexpected(InsertError::ZeroQuaternion);
  }
  return CheckedSample{knownEdge(parent, child).value_or(kNoFrame), sample.stamp,
                       RigidTransform{*rotation, sample.parent_from_child.translation}, sample.is_static};
}

std::optional<FrameId> TransformTree::knownEdge(std::string_view parent, std::string_view child) const noexcept {
  const auto known = names_.find(child);
  if (known && parents_[*known] != kNoFrame && names_.name(parents_[*known]) == parent) {
    return known;
  }
  return std::nullopt;
}

FrameId TransformTree::internFrame(std::string_view name) {
  const FrameId frame = names_.intern(name);
  if (frame == parents_.size()) {
    edges_.emplace_back();
    has_children_.push_back(false);
    parents_.push_back(kNoFrame);
  }
  return frame;
}

std::expected<FrameId, InsertError> TransformTree::addEdge(std::string_view parent_name, std::string_view child_name) {
  parent_name = stripLeadingSlashes(parent_name);
  child_name = stripLeadingSlashes(child_name);
  const auto known_parent = names_.find(parent_name);
  const auto known_child = names_.find(child_name);
  if (known_child && parents_[*known_child] != kNoFrame) {
    return parents_[*known_child] == known_parent ? std::expected<FrameId, InsertError>(*known_child)
                                                  : std::unexpected(InsertError::ReparentConflict);
  }
  // Only a frame that has children can have the parent among its descendants.
  if (known_parent && known_child && has_children_[*known_child] && climb(*known_parent).root == *known_child) {
    return std::unexpected(InsertError::Cycle);
  }
  const FrameId parent = internFrame(parent_name);
  const FrameId child = internFrame(child_name);
  parents_[child] = parent;
  has_children_[parent] = true;
  return child;
}

void TransformTree::store(const CheckedSample& sample, std::optional<std::int64_t> retention_ns) {
  Edge& edge = edges_[sample.child];
  edge.is_static = edge.is_static && sample.is_static;
  edge.samples.insert(sample.stamp, sample.parent_from_child);
  if (retention_ns) {
    constexpr std::int64_t kEarliest = std::numeric_limits<std::int64_t>::min();
    const std::int64_t newest = edge.samples.last().ns;
    const bool reaches_past_start = newest < kEarliest + *retention_ns;
    edge.samples.dropBefore(TimePoint{reaches_past_start ? kEarliest : newest - *retention_ns});
  }
}

TransformTree::Climb TransformTree::climb(FrameId frame) const noexcept {
  std::size_t steps = 0;
  for (; parents_[frame] != kNoFrame; frame = parents_[frame]) {
    ++steps;
  }
  return {frame, steps};
}

std::optional<TimePoint> TransformTree::stampInForce(FrameId frame, TimePoint time) const noexcept {
  if (parent(frame) == kNoFrame) {
    return std::nullopt;
  }
  const Edge& edge = edges_[frame];
  if (const auto cursor = edge.samples.find(time)) {
    return edge.samples.stamp(*cursor);
  }
  return static_for_all_time && edge.is_static ? std::optional(edge.samples.first()) : std::nullopt;
}

LookupFailure TransformTree::noSample(FrameId target, FrameId source, FrameId child, TimePoint time) const noexcept {
  const EdgeCache& samples = edges_[child].samples;
  return {LookupError::NoSampleAtTime, target, source, child, time, samples.first(), samples.last()};
}

/// Fills segment.poses.
void TransformTree::resolve(Segment& segment, TimePoint time) const noexcept {
  // Each pass asks for the memory that the next one reads: in a long recording every edge costs a handful of cache
  // misses, and this way those of all edges are waited for together.
  std::array<EdgeCache::Probe, Segment::kEdges> probes;
  for (std::size_t i = 0; i < segment.count; ++i) {
    edges_[segment.children[i]].samples.prefetchIndex(time);
  }
  for (std::size_t i = 0; i < segment.count; ++i) {
    probes[i] = edges_[segment.children[i]].samples.probeBlock(time);
  }
  for (std::size_t i = 0; i < segment.count; ++i) {
    edges_[segment.children[i]].samples.prefetchSample(probes[i]);
  }
  for (std::size_t i = 0; i < segment.count; ++i) {
    const Edge& edge = edges_[segment.children[i]];
    if (const auto cursor = edge.samples.find(probes[i], time)) {
      segment.poses[i] = &edge.samples.pose(*cursor);
      __builtin_prefetch(segment.poses[i]);
      __builtin_prefetch(&segment.poses[i]->translation.z);
    } else {
      segment.poses[i] = static_for_all_time && edge.is_static ? &edge.samples.firstPose() : nullptr;
    }
  }
}

/// ancestor_from_frame, into `wide` as well unless null; or the child of the first edge without a sample.
std::expected<RigidTransform, FrameId> TransformTree::composeUpTo(FrameId ancestor, FrameId frame, TimePoint time,
                                                                  WideTransform* wide) const noexcept {
  WideTransform wide_top_from_frame;
  Segment segment;
  for (bool first = true;; first = false) {
    for (segment.count = 0; segment.count < Segment::kEdges && frame != ancestor; frame = parents_[frame]) {
      segment.add(frame);
    }
    resolve(segment, time);
    const auto end = segment.poses.begin() + static_cast<std::ptrdiff_t>(segment.count);
    if (const auto failing = std::find(segment.poses.begin(), end, nullptr); failing != end) {
      return std::unexpected(segment.children[static_cast<std::size_t>(failing - segment.poses.begin())]);
    }
    // From the top down: the first offset is taken as it is, so that a single edge answers with what was inserted.
    ChainAccumulator top_from_bottom;
    for (std::size_t i = segment.count; i-- > 0;) {
      top_from_bottom.append(*segment.poses[i]);
    }
    if (first && frame == ancestor && wide == nullptr) {
      return top_from_bottom.narrow();
    }
    wide_top_from_frame = compose(top_from_bottom.widen(), wide_top_from_frame);
    if (frame == ancestor) {
      break;
    }
  }
  if (wide != nullptr) {
    *wide = wide_top_from_frame;
  }
  return narrow(wide_top_from_frame);
}

std::expected<RigidTransform, LookupFailure> TransformTree::lookup(FrameId target, FrameId source,
                                                                   TimePoint time) const noexcept {
  const FrameId known_target = contains(target) ? target : kNoFrame;
  const FrameId known_source = contains(source) ? source : kNoFrame;
  const auto failed = [&](LookupError code) {
    return std::unexpected(LookupFailure{code, known_target, known_source, kNoFrame, time, {}, {}});
  };
  if (known_target == kNoFrame) {
    return failed(LookupError::UnknownTarget);
  }
  if (known_source == kNoFrame) {
    return failed(LookupError::UnknownSource);
  }
  if (target == source) {
    return RigidTransform{};
  }
  const Climb from_target = climb(target);
  const Climb from_source = climb(source);
  if (from_target.root != from_source.root) {
    return failed(LookupError::Disconnected);
  }
  // The lowest common ancestor: level both sides, then go up together.
  FrameId meet = source;
  FrameId other = target;
  for (std::size_t steps = from_source.steps; steps > from_target.steps; --steps) {
    meet = parents_[meet];
  }
  for (std::size_t steps = from_target.steps; steps > from_source.steps; --steps) {
    other = parents_[other];
  }
  while (meet != other) {
    meet = parents_[meet];
    other = parents_[other];
  }
  const auto noSampleOn = [&](FrameId child) { return std::unexpected(noSample(target, source, child, time)); };
  if (meet == target) {
    const auto target_from_source = composeUpTo(meet, source, time, nullptr);
    return target_from_source ? std::expected<RigidTransform, LookupFailure>(*target_from_source)
                              : noSampleOn(target_from_source.error());
  }
  WideTransform meet_from_source;
  if (const auto complete = composeUpTo(meet, source, time, &meet_from_source); !complete) {
    return noSampleOn(complete.error());
  }
  WideTransform meet_from_target;
  if (const auto complete = composeUpTo(meet, target, time, &meet_from_target); !complete) {
    return noSampleOn(complete.error());
  }
  return narrow(composeInverse(meet_from_target, meet_from_source));
}

void TransformTree::snapshot(FrameId root, TimePoint time, Snapshot& out) const {
  const std::size_t count = parents_.size();
  out.time = time;
  out.root = root;
  SnapshotScratch& scratch = out.scratch;
  scratch.done.assign(count, 0);
  scratch.root_from_frame.resize(count);
  scratch.poses.resize(count);
  out.root_from_frame.resize(count);
  if (!contains(root)) {
    for (FrameId frame = 0; frame < count; ++frame) {
      out.root_from_frame[frame] =
          std::unexpected(LookupFailure{LookupError::UnknownTarget, kNoFrame, frame, kNoFrame, time, {}, {}});
    }
    return;
  }
  resolveAll(time, scratch);
  out.root_from_frame[root] = RigidTransform{};
  scratch.root_from_frame[root] = ChainAccumulator{};
  scratch.done[root] = 1;
  snapshotAncestors(out);
  for (FrameId frame = 0; frame < count; ++frame) {
    // Up to the first resolved ancestor, and down again: each frame is composed once, from its parent's result.
    scratch.path.clear();
    for (FrameId at = frame; at != kNoFrame && scratch.done[at] == 0; at = parents_[at]) {
      scratch.path.push_back(at);
    }
    for (; !scratch.path.empty(); scratch.path.pop_back()) {
      snapshotFrame(scratch.path.back(), out);
    }
  }
}

void TransformTree::resolveAll(TimePoint time, SnapshotScratch& scratch) const {
  Segment segment;
  for (FrameId frame = 0; frame < parents_.size(); ++frame) {
    if (parents_[frame] != kNoFrame) {
      segment.add(frame);
    }
    if (segment.count == Segment::kEdges || frame + 1 == parents_.size()) {
      resolve(segment, time);
      for (std::size_t i = 0; i < segment.count; ++i) {
        scratch.poses[segment.children[i]] = segment.poses[i];
      }
      segment.count = 0;
    }
  }
}

void TransformTree::snapshotAncestors(Snapshot& out) const noexcept {
  SnapshotScratch& scratch = out.scratch;
  FrameId failing = kNoFrame;
  ChainAccumulator root_from_ancestor;
  for (FrameId frame = out.root; parents_[frame] != kNoFrame; frame = parents_[frame]) {
    const FrameId ancestor = parents_[frame];
    const RigidTransform* ancestor_from_frame = failing == kNoFrame ? scratch.poses[frame] : nullptr;
    if (ancestor_from_frame == nullptr) {
      failing = failing == kNoFrame ? frame : failing;
      out.root_from_frame[ancestor] = std::unexpected(noSample(out.root, ancestor, failing, out.time));
    } else {
      root_from_ancestor.appendInverse(*ancestor_from_frame);
      scratch.root_from_frame[ancestor] = root_from_ancestor;
      out.root_from_frame[ancestor] = root_from_ancestor.narrow();
    }
    scratch.done[ancestor] = 1;
  }
}

void TransformTree::snapshotFrame(FrameId frame, Snapshot& out) const {
  SnapshotScratch& scratch = out.scratch;
  auto& result = out.root_from_frame[frame];
  scratch.done[frame] = 1;
  const FrameId parent = parents_[frame];
  if (parent == kNoFrame) {  // the root of another tree
    result = std::unexpected(LookupFailure{LookupError::Disconnected, out.root, frame, kNoFrame, out.time, {}, {}});
    return;
  }
  const auto& from_parent = out.root_from_frame[parent];
  if (!from_parent && from_parent.error().code == LookupError::Disconnected) {
    result = from_parent;
    result.error().source = frame;
    return;
  }
  const RigidTransform* parent_from_frame = scratch.poses[frame];
  if (parent_from_frame == nullptr) {
    result = std::unexpected(noSample(out.root, frame, frame, out.time));
  } else if (!from_parent) {
    result = from_parent;
    result.error().source = frame;
  } else {
    scratch.root_from_frame[frame] = scratch.root_from_frame[parent];
    scratch.root_from_frame[frame].append(*parent_from_frame);
    result = scratch.root_from_frame[frame].narrow();
  }
}

std::size_t TransformTree::sampleBytes() const noexcept {
  std::size_t total = 0;
  for (const Edge& edge : edges_) {
    total += edge.samples.bytes();
  }
  return total;
}

}  // namespace stillframe::tf
