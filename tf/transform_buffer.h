#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tf/chain_accumulator.h"
#include "tf/chain_kernels.h"
#include "tf/errors.h"
#include "tf/rigid_transform.h"
#include "tf/time.h"

namespace stillframe::tf {

/// One stamped edge of the tree on its way into the buffer. The names are only read during the call.
struct TransformSample {
  std::string_view parent;
  std::string_view child;
  TimePoint stamp;
  RigidTransform parent_from_child;  ///< p_parent = parent_from_child * p_child; any non-zero quaternion norm
  bool is_static = false;            ///< from a static topic: see TransformBuffer::setStaticForAllTime()
};

/// What became of a bulk insert. Refusals never stop it.
struct BulkInsertReport {
  /// One kind of refusal on one edge.
  struct Refusal {
    InsertError error = InsertError::EmptyFrameName;
    std::string parent;
    std::string child;
    std::size_t count = 0;
    TimePoint first_stamp;
  };
  std::size_t inserted = 0;
  std::vector<Refusal> refusals;  ///< at most kMaxRefusals distinct ones, in order of first appearance
  std::size_t refused = 0;        ///< all of them, listed or not
  static constexpr std::size_t kMaxRefusals = 256;
};

/// What is known of one edge. Times are meaningful when samples > 0.
struct EdgeInfo {
  std::string parent;
  std::string child;
  std::size_t samples = 0;
  TimePoint first;
  TimePoint last;
  bool is_static = false;
};

/// A sample as it lies in the buffer.
struct StampedTransform {
  TimePoint stamp;
  RigidTransform parent_from_child;
};

/// What TransformBuffer::snapshot() works in; of no meaning outside it.
struct SnapshotScratch {
  std::vector<const RigidTransform*> poses;
  std::vector<ChainAccumulator> root_from_frame;
  std::vector<std::uint8_t> states;
  std::vector<FrameId> path;
  std::vector<ChainStep> steps;
  std::vector<FrameId> step_frames;
};

/// Every frame resolved against one root at one time; index = FrameId. Reuse it between ticks: no allocation then.
struct Snapshot {
  TimePoint time;
  FrameId root = kNoFrame;
  std::uint64_t revision = 0;  ///< of the buffer when it was taken
  std::vector<std::expected<RigidTransform, LookupFailure>> root_from_frame;
  SnapshotScratch scratch;  ///< kept so that the next tick does not allocate
};

/// Thrown by the throwing twin of a lookup.
class TransformException : public std::runtime_error {
 public:
  TransformException(const std::string& message, const LookupFailure& failure)
      : std::runtime_error(message), failure_(failure) {}
  [[nodiscard]] const LookupFailure& failure() const noexcept { return failure_; }

 private:
  LookupFailure failure_;
};

/// The tree of frames over time, answered by zero-order hold (REQUIREMENTS H1-H8; conventions of REP 105 and tf2).
///
/// One per dataset, shared by all of its views. Any thread may call anything at any time; readers do not wait for each
/// other. Names are stripped of leading slashes. A lookup costs O(depth * log samples per edge), independent of where
/// in the history the time lies, and does not allocate. An insert costs O(1) at the end of an edge and O(log n) out of
/// order. An edge is static while every sample of it came from a static topic.
class TransformBuffer {
 public:
  /// `retention_ns`: samples older than that behind the newest of their edge are dropped; nullopt keeps everything (a
  /// recording must: a window would break scrubbing).
  explicit TransformBuffer(std::optional<std::int64_t> retention_ns = std::nullopt);
  ~TransformBuffer();
  TransformBuffer(const TransformBuffer&) = delete;
  TransformBuffer& operator=(const TransformBuffer&) = delete;

  /// Adds one sample; a repeated stamp replaces. Nothing changes on refusal.
  std::expected<void, InsertError> insert(const TransformSample& sample);
  /// Adds many, the cheap way to load a file, in any order. Readers get in between batches of a few dozen, so they
  /// may see a part of it.
  BulkInsertReport insertBulk(std::span<const TransformSample> samples);
  /// Packs the edges whose samples came out of order as if they had come in order, so that lookups cost the same. To be
  /// called when a load is done. O(samples of those edges), and for a while the memory of one of them more; nothing
  /// else does it, and it costs O(frames) where there is nothing to do. Readers go on meanwhile.
  void pack();
  /// Forgets every frame and sample. Frame ids start anew.
  void clear();
  /// Whether edges fed from static topics also answer before their first stamp (DESIGN.md §5); off by default.
  void setStaticForAllTime(bool enabled);
  [[nodiscard]] bool isStaticForAllTime() const;

  /// T with p_target = T * p_source, from the samples in force at `time`. A frame in itself is the identity at any
  /// time.
  [[nodiscard]] std::expected<RigidTransform, LookupFailure> tryLookupTransform(std::string_view target,
                                                                                std::string_view source,
                                                                                TimePoint time) const noexcept;
  [[nodiscard]] std::expected<RigidTransform, LookupFailure> tryLookupTransform(FrameId target, FrameId source,
                                                                                TimePoint time) const noexcept;
  /// Throws TransformException instead.
  [[nodiscard]] RigidTransform lookupTransform(std::string_view target, std::string_view source, TimePoint time) const;
  /// All frames against `root` in one pass under one lock: O(frames), not O(frames * depth).
  void snapshot(FrameId root, TimePoint time, Snapshot& out) const;

  [[nodiscard]] std::size_t frameCount() const;
  /// Every frame ever seen, in order of first appearance (index = FrameId).
  [[nodiscard]] std::vector<std::string> frames() const;
  [[nodiscard]] std::optional<FrameId> findFrame(std::string_view name) const noexcept;
  /// Name of a valid id; "?" for any other.
  [[nodiscard]] std::string frameName(FrameId frame) const;
  /// Parent of a frame; kNoFrame for a root or an unknown frame. The hierarchy does not depend on time.
  [[nodiscard]] FrameId parent(FrameId frame) const noexcept;
  /// Roots in order of first appearance.
  [[nodiscard]] std::vector<FrameId> roots() const;
  /// The edge from `child` to its parent; nullopt for a root or an unknown frame.
  [[nodiscard]] std::optional<EdgeInfo> edge(FrameId child) const;
  /// A copy of every sample of the edge above `child`, oldest first; empty for a root or an unknown frame.
  [[nodiscard]] std::vector<StampedTransform> samples(FrameId child) const;
  /// Stamp of the sample in force at `time` on the edge above `child`.
  [[nodiscard]] std::optional<TimePoint> stampInForce(FrameId child, TimePoint time) const noexcept;
  /// Changes with every change of content: a view that has seen it needs no new tick.
  [[nodiscard]] std::uint64_t revision() const noexcept;
  /// Bytes held by samples, capacity included.
  [[nodiscard]] std::size_t sampleBytes() const;
  /// One sentence with the frames, the edge and its time span.
  [[nodiscard]] std::string describe(const LookupFailure& failure) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// `name` without leading slashes (ROS 1 style ids and ROS 2 ids name the same frame).
[[nodiscard]] std::string_view stripLeadingSlashes(std::string_view name) noexcept;

}  // namespace stillframe::tf
