#pragma once

#include <array>
#include <expected>
#include <optional>
#include <vector>

#include "tf/edge_cache.h"
#include "tf/errors.h"
#include "tf/frame_names.h"
#include "tf/time.h"
#include "tf/transform_buffer.h"
#include "tf/wide_transform.h"

namespace stillframe::tf {

/// The frames, their parents and the samples between them: TransformBuffer without its lock.
///
/// Not thread-safe. The const functions neither allocate (except snapshot(), into its argument) nor throw.
class TransformTree {
 public:
  /// A sample that passed every check that does not need the tree to change.
  struct CheckedSample {
    FrameId child = kNoFrame;  ///< kNoFrame: the edge is not known yet, addEdge() comes first
    TimePoint stamp;
    RigidTransform parent_from_child;
    bool is_static = false;
  };

  /// Checks the sample and normalises its rotation. The edge is found if it exists.
  [[nodiscard]] std::expected<CheckedSample, InsertError> check(const TransformSample& sample) const noexcept;
  /// Makes the edge of a sample whose names are sound, or finds it; new names are taken only if it succeeds.
  std::expected<FrameId, InsertError> addEdge(std::string_view parent, std::string_view child);
  /// Stores a checked sample of a known edge, then drops what is older than `retention_ns` behind the newest.
  void store(const CheckedSample& sample, std::optional<std::int64_t> retention_ns);

  [[nodiscard]] std::expected<RigidTransform, LookupFailure> lookup(FrameId target, FrameId source,
                                                                    TimePoint time) const noexcept;
  void snapshot(FrameId root, TimePoint time, Snapshot& out) const;

  [[nodiscard]] const FrameNames& names() const noexcept { return names_; }
  [[nodiscard]] bool contains(FrameId frame) const noexcept { return frame < parents_.size(); }
  [[nodiscard]] FrameId parent(FrameId frame) const noexcept { return contains(frame) ? parents_[frame] : kNoFrame; }
  /// Samples above a frame; empty for a root. `frame` must be valid.
  [[nodiscard]] const EdgeCache& samples(FrameId frame) const noexcept { return edges_[frame].samples; }
  /// Replaces them by the same ones, differently kept.
  void swapSamples(FrameId frame, EdgeCache& samples) noexcept { std::swap(edges_[frame].samples, samples); }
  [[nodiscard]] bool isStatic(FrameId frame) const noexcept { return edges_[frame].is_static; }
  /// Stamp in force on the edge above `frame`.
  [[nodiscard]] std::optional<TimePoint> stampInForce(FrameId frame, TimePoint time) const noexcept;
  [[nodiscard]] std::size_t sampleBytes() const noexcept;

  bool static_for_all_time = false;

 private:
  struct Edge {
    EdgeCache samples;
    bool is_static = true;  // until a sample of a dynamic topic arrives
  };
  /// Edges that are resolved together, so that their cache misses overlap. Filled from the back: a chain collected from
  /// its bottom up stands in it from the top down.
  struct Segment {
    static constexpr std::size_t kEdges = 256;
    void clear() noexcept { begin = kEdges; }
    [[nodiscard]] bool full() const noexcept { return begin == 0; }
    void add(FrameId child) noexcept { children[--begin] = child; }

    std::size_t begin = kEdges;  // entries from here on are in use
    std::array<FrameId, kEdges> children;
    std::array<const RigidTransform*, kEdges> poses;  // parent_from_child in force, or nullptr
  };
  struct Climb {
    FrameId root;
    std::size_t steps;
  };

  [[nodiscard]] std::optional<FrameId> knownEdge(std::string_view parent, std::string_view child) const noexcept;
  [[nodiscard]] FrameId internFrame(std::string_view name);
  [[nodiscard]] Climb climb(FrameId frame) const noexcept;
  void resolve(Segment& segment, TimePoint time) const noexcept;
  [[nodiscard]] static std::optional<FrameId> lowestUnresolved(const Segment& segment) noexcept;
  [[nodiscard]] std::expected<RigidTransform, LookupFailure> lookupAcross(FrameId target, FrameId source,
                                                                          TimePoint time) const noexcept;
  [[nodiscard]] std::expected<WideTransform, FrameId> composeUpTo(FrameId ancestor, FrameId frame,
                                                                  TimePoint time) const noexcept;
  [[nodiscard]] LookupFailure noSample(FrameId target, FrameId source, FrameId child, TimePoint time) const noexcept;
  void resolveAll(TimePoint time, SnapshotScratch& scratch) const;
  void snapshotAncestors(Snapshot& out) const noexcept;
  void planFrame(FrameId frame, Snapshot& out) const;

  FrameNames names_;
  std::vector<FrameId> parents_;    // index = child
  std::vector<bool> has_children_;  // index = frame
  std::vector<Edge> edges_;         // index = child
};

}  // namespace stillframe::tf
