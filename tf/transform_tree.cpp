#include "tf/transform_tree.h"

#include <algorithm>
#include <limits>

#include "tf/chain_accumulator.h"
#include "tf/wide_transform.h"

namespace stillframe::tf {
namespace {

/// What a frame of a snapshot has come to, in SnapshotScratch::states.
enum class SnapshotState : std::uint8_t { Pending, Placed, Failed };

SnapshotState stateOf(const SnapshotScratch& scratch, FrameId frame) noexcept {
  return static_cast<SnapshotState>(scratch.states[frame]);
}

void setState(SnapshotScratch& scratch, FrameId frame, SnapshotState state) noexcept {
  scratch.states[frame] = static_cast<std::uint8_t>(state);
}

}  // namespace

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
  if (const EdgeCache::Sample* sample = edge.samples.find(time)) {
    return TimePoint{sample->stamp_ns};
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
  std::array<std::size_t, Segment::kEdges> blocks;
  std::array<EdgeCache::Probe, Segment::kEdges> probes;
  for (std::size_t i = segment.begin; i < Segment::kEdges; ++i) {
    blocks[i] = edges_[segment.children[i]].samples.guessBlock(time);
  }
  for (std::size_t i = segment.begin; i < Segment::kEdges; ++i) {
    blocks[i] = edges_[segment.children[i]].samples.guessBlockAgain(blocks[i], time);
  }
  for (std::size_t i = segment.begin; i < Segment::kEdges; ++i) {
    probes[i] = edges_[segment.children[i]].samples.probe(blocks[i], time);
    EdgeCache::prefetchSample(probes[i]);
  }
  for (std::size_t i = segment.begin; i < Segment::kEdges; ++i) {
    if (const EdgeCache::Sample* sample = EdgeCache::find(probes[i], time)) {
      segment.poses[i] = &sample->parent_from_child;
    } else {
      const Edge& edge = edges_[segment.children[i]];
      segment.poses[i] = static_for_all_time && edge.is_static ? &edge.samples.front().parent_from_child : nullptr;
    }
  }
}

/// The child of the lowest edge of a resolved chain that has no sample.
std::optional<FrameId> TransformTree::lowestUnresolved(const Segment& segment) noexcept {
  for (std::size_t i = Segment::kEdges; i-- > segment.begin;) {
    if (segment.poses[i] == nullptr) {
      return segment.children[i];
    }
  }
  return std::nullopt;
}

/// ancestor_from_frame, or the child of the lowest edge without a sample.
std::expected<WideTransform, FrameId> TransformTree::composeUpTo(FrameId ancestor, FrameId frame,
                                                                 TimePoint time) const noexcept {
  WideTransform top_from_frame;
  Segment segment;
  while (frame != ancestor) {
    for (segment.clear(); !segment.full() && frame != ancestor; frame = parents_[frame]) {
      segment.add(frame);
    }
    resolve(segment, time);
    if (const auto unresolved = lowestUnresolved(segment)) {
      return std::unexpected(*unresolved);
    }
    ChainAccumulator top_from_bottom;
    top_from_bottom.append(std::span(segment.poses).subspan(segment.begin));
    top_from_frame = compose(top_from_bottom.widen(), top_from_frame);
  }
  return top_from_frame;
}

std::expected<RigidTransform, LookupFailure> TransformTree::lookup(FrameId target, FrameId source,
                                                                   TimePoint time) const noexcept {
  const FrameId known_target = contains(target) ? target : kNoFrame;
  const FrameId known_source = contains(source) ? source : kNoFrame;
  if (known_target == kNoFrame || known_source == kNoFrame) {
    const auto code = known_target == kNoFrame ? LookupError::UnknownTarget : LookupError::UnknownSource;
    return std::unexpected(LookupFailure{code, known_target, known_source, kNoFrame, time, {}, {}});
  }
  if (target == source) {
    return RigidTransform{};
  }
  // What nearly every lookup is: the target lies above the source, by no more than one segment.
  Segment segment;
  FrameId frame = source;
  for (; frame != target && frame != kNoFrame && !segment.full(); frame = parents_[frame]) {
    segment.add(frame);
  }
  if (frame != target) {
    return lookupAcross(target, source, time);
  }
  resolve(segment, time);
  if (const auto unresolved = lowestUnresolved(segment)) {
    return std::unexpected(noSample(target, source, *unresolved, time));
  }
  // From the top down: the first offset is taken as it is, so that a single edge answers with what was inserted.
  ChainAccumulator target_from_source;
  target_from_source.append(std::span(segment.poses).subspan(segment.begin));
  return target_from_source.narrow();
}

/// lookup() between any two frames.
std::expected<RigidTransform, LookupFailure> TransformTree::lookupAcross(FrameId target, FrameId source,
                                                                         TimePoint time) const noexcept {
  const Climb from_target = climb(target);
  const Climb from_source = climb(source);
  if (from_target.root != from_source.root) {
    return std::unexpected(LookupFailure{LookupError::Disconnected, target, source, kNoFrame, time, {}, {}});
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
  const auto meet_from_source = composeUpTo(meet, source, time);
  const auto meet_from_target = composeUpTo(meet, target, time);
  if (!meet_from_source || !meet_from_target) {
    const FrameId unresolved = !meet_from_source ? meet_from_source.error() : meet_from_target.error();
    return std::unexpected(noSample(target, source, unresolved, time));
  }
  return narrow(meet == target ? *meet_from_source : composeInverse(*meet_from_target, *meet_from_source));
}

void TransformTree::snapshot(FrameId root, TimePoint time, Snapshot& out) const {
  const std::size_t count = parents_.size();
  out.time = time;
  out.root = root;
  SnapshotScratch& scratch = out.scratch;
  scratch.states.assign(count, static_cast<std::uint8_t>(SnapshotState::Pending));
  scratch.root_from_frame.resize(count);
  scratch.poses.resize(count);
  scratch.steps.clear();
  scratch.step_frames.clear();
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
  setState(scratch, root, SnapshotState::Placed);
  snapshotAncestors(out);
  for (FrameId frame = 0; frame < count; ++frame) {
    // Up to the first planned ancestor, and down again: each frame is composed once, from its parent's result.
    for (FrameId at = frame; at != kNoFrame && stateOf(scratch, at) == SnapshotState::Pending; at = parents_[at]) {
      scratch.path.push_back(at);
    }
    for (; !scratch.path.empty(); scratch.path.pop_back()) {
      planFrame(scratch.path.back(), out);
    }
  }
  ChainKernels::best().append_each(scratch.steps);
  for (std::size_t i = 0; i < scratch.steps.size(); ++i) {
    out.root_from_frame[scratch.step_frames[i]] = scratch.steps[i].rounded;
  }
}

void TransformTree::resolveAll(TimePoint time, SnapshotScratch& scratch) const {
  Segment segment;
  for (FrameId frame = 0; frame < parents_.size(); ++frame) {
    if (parents_[frame] != kNoFrame) {
      segment.add(frame);
    }
    if (segment.full() || frame + 1 == parents_.size()) {
      resolve(segment, time);
      for (std::size_t i = segment.begin; i < Segment::kEdges; ++i) {
        scratch.poses[segment.children[i]] = segment.poses[i];
      }
      segment.clear();
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
    setState(scratch, ancestor, failing == kNoFrame ? SnapshotState::Placed : SnapshotState::Failed);
  }
}

/// Plans the step from the parent, which has its state, or writes why there is none.
void TransformTree::planFrame(FrameId frame, Snapshot& out) const {
  SnapshotScratch& scratch = out.scratch;
  auto& result = out.root_from_frame[frame];
  const FrameId parent = parents_[frame];
  if (parent == kNoFrame) {  // the root of another tree
    result = std::unexpected(LookupFailure{LookupError::Disconnected, out.root, frame, kNoFrame, out.time, {}, {}});
    setState(scratch, frame, SnapshotState::Failed);
    return;
  }
  const RigidTransform* parent_from_frame = scratch.poses[frame];
  const bool parent_placed = stateOf(scratch, parent) == SnapshotState::Placed;
  if (parent_placed && parent_from_frame != nullptr) {
    scratch.steps.push_back(
        {&scratch.root_from_frame[parent].parts, parent_from_frame, &scratch.root_from_frame[frame].parts, {}});
    scratch.step_frames.push_back(frame);
    setState(scratch, frame, SnapshotState::Placed);
    return;
  }
  const bool disconnected = !parent_placed && out.root_from_frame[parent].error().code == LookupError::Disconnected;
  if (parent_from_frame == nullptr && !disconnected) {
    result = std::unexpected(noSample(out.root, frame, frame, out.time));
  } else {
    result = out.root_from_frame[parent];
    result.error().source = frame;
  }
  setState(scratch, frame, SnapshotState::Failed);
}

std::size_t TransformTree::sampleBytes() const noexcept {
  std::size_t total = 0;
  for (const Edge& edge : edges_) {
    total += edge.samples.bytes();
  }
  return total;
}

}  // namespace stillframe::tf
