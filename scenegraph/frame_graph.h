#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/ref_ptr>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tf/transform_buffer.h"

namespace stillframe::scenegraph {

/// The frames of one view: a MatrixTransform beneath root() for each frame that something is attached to.
///
/// Flat: every node holds fixed_from_frame itself (DESIGN.md §3). GUI thread only. A tick costs O(frames in the buffer)
/// for the snapshot and writes only the matrices that changed; a tick at the same time, fixed frame and buffer revision
/// costs nothing.
class FrameGraph {
 public:
  explicit FrameGraph(std::shared_ptr<const tf::TransformBuffer> buffer);

  [[nodiscard]] osg::Group& root() noexcept { return *root_; }
  [[nodiscard]] const tf::TransformBuffer& buffer() const noexcept { return *buffer_; }

  /// Poses every node for `time` in `fixed_frame`; frames that cannot be expressed are masked off.
  /// An unknown fixed frame masks everything except what hangs in that frame itself.
  void setTick(std::string_view fixed_frame, tf::TimePoint time);
  [[nodiscard]] const std::string& fixedFrame() const noexcept { return fixed_frame_; }
  [[nodiscard]] tf::TimePoint time() const noexcept { return time_; }

  /// The node of `frame`, made on first use and posed at once. Each acquire() needs one release(); the node leaves the
  /// graph with the last. The frame need not be known to the buffer yet.
  osg::MatrixTransform& acquire(std::string_view frame);
  void release(std::string_view frame);
  /// Acquires the node of `frame` and puts `child` beneath it; without a frame beneath root() itself.
  void hang(std::optional<std::string_view> frame, osg::Node& child);
  /// Takes `child` off again, and releases.
  void unhang(std::optional<std::string_view> frame, osg::Node& child);
  /// Another number whenever something was hung or acquired, taken off or released.
  [[nodiscard]] std::uint64_t hangRevision() const noexcept { return hang_revision_; }
  /// Puts what hangs beneath each frame, and the frames by the first of it, into this order, so that what is drawn
  /// first does not depend on what was hung first; what is not among `nodes` comes after them. O(what hangs in the
  /// graph).
  void arrange(std::span<osg::Node* const> nodes);
  /// The node when somebody holds it, else nullptr.
  [[nodiscard]] osg::MatrixTransform* node(std::string_view frame) const;

  /// fixed_from_frame at the current tick, or why there is none. The fixed frame in itself is always the identity.
  [[nodiscard]] std::expected<tf::RigidTransform, tf::LookupFailure> fixedFromFrame(std::string_view frame) const;
  /// The same by the frame's id in the buffer as well, for who has it: no name is looked up.
  [[nodiscard]] std::expected<tf::RigidTransform, tf::LookupFailure> fixedFromFrame(std::string_view frame,
                                                                                    tf::FrameId id) const {
    return poseOf(frame, id);
  }
  /// All frames of the buffer at the current tick.
  [[nodiscard]] const tf::Snapshot& snapshot() const noexcept { return snapshot_; }

  /// Counters for tests and benchmarks: what the last setTick() did.
  struct TickCounts {
    std::size_t matrices_written = 0;
    std::size_t masks_changed = 0;
    bool snapshot_taken = false;
  };
  [[nodiscard]] const TickCounts& lastTick() const noexcept { return counts_; }

 private:
  struct Node {
    osg::ref_ptr<osg::MatrixTransform> transform;  // named as the frame
    std::size_t users = 0;
    tf::FrameId id = tf::kNoFrame;  // in the buffer, as of ids_revision_
    tf::RigidTransform posed{};     // what its matrix says
  };
  using Pose = std::expected<tf::RigidTransform, tf::LookupFailure>;
  void pose(Node& node, const Pose& fixed_from_frame);
  [[nodiscard]] tf::FrameId idOf(std::string_view frame) const;
  [[nodiscard]] Pose poseOf(std::string_view frame, tf::FrameId source) const;
  [[nodiscard]] Pose poseInTree(tf::FrameId source) const;

  std::shared_ptr<const tf::TransformBuffer> buffer_;
  osg::ref_ptr<osg::Group> root_;
  std::vector<Node> nodes_;                              // side by side: a tick goes through all of them
  std::unordered_map<std::string, std::size_t> places_;  // in nodes_, by frame
  std::string fixed_frame_;
  tf::TimePoint time_;
  bool is_ticked_ = false;
  std::optional<std::uint64_t> ids_revision_;  // of the buffer when the nodes' ids were looked up
  std::uint64_t hang_revision_ = 0;
  tf::Snapshot snapshot_;
  TickCounts counts_;
};

}  // namespace stillframe::scenegraph
