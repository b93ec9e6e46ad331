#include "scenegraph/frame_graph.h"

#include "scenegraph/buffer_patches.h"

#include <algorithm>
#include <bit>
#include <glm/gtc/type_ptr.hpp>
#include <osg/Matrixd>
#include <span>
#include <utility>

namespace stillframe::scenegraph {
namespace {

constexpr osg::Node::NodeMask kShown = ~0U;

/// The state must not depend on which of 0 and -0 was there before.
bool isSameByBits(const osg::Matrixd& a, const osg::Matrixd& b) {
  return std::ranges::equal(std::span(a.ptr(), 16), std::span(b.ptr(), 16), {}, std::bit_cast<std::uint64_t, double>,
                            std::bit_cast<std::uint64_t, double>);
}

}  // namespace

FrameGraph::FrameGraph(std::shared_ptr<const tf::TransformBuffer> buffer)
    : buffer_(std::move(buffer)), root_(new osg::Group) {
  root_->setName("frames");
  BufferPatches::hangOn(*root_);
  root_->setDataVariance(osg::Object::DYNAMIC);
}

void FrameGraph::setTick(std::string_view fixed_frame, tf::TimePoint time) {
  counts_ = {};
  fixed_frame = tf::stripLeadingSlashes(fixed_frame);
  const std::uint64_t revision = buffer_->revision();
  if (is_ticked_ && time == time_ && fixed_frame == fixed_frame_ && revision == snapshot_.revision) {
    return;
  }
  is_ticked_ = true;
  fixed_frame_ = fixed_frame;
  time_ = time;
  if (const auto fixed = buffer_->findFrame(fixed_frame_)) {
    buffer_->snapshot(*fixed, time, snapshot_);
    counts_.snapshot_taken = true;
  } else {
    snapshot_.time = time;
    snapshot_.root = tf::kNoFrame;
    snapshot_.revision = revision;
    snapshot_.root_from_frame.clear();
  }
  for (auto& [frame, node] : nodes_) {
    pose(frame, *node.transform);
  }
}

void FrameGraph::pose(const std::string& frame, osg::MatrixTransform& node) {
  const auto fixed_from_frame = fixedFromFrame(frame);
  const osg::Node::NodeMask mask = fixed_from_frame ? kShown : 0U;
  if (fixed_from_frame) {
    const osg::Matrixd matrix(glm::value_ptr(tf::toMatrix(*fixed_from_frame)));
    if (!isSameByBits(matrix, node.getMatrix())) {
      node.setMatrix(matrix);
      ++counts_.matrices_written;
    }
  }
  if (node.getNodeMask() != mask) {
    node.setNodeMask(mask);
    ++counts_.masks_changed;
  }
}

osg::MatrixTransform& FrameGraph::acquire(std::string_view frame) {
  const auto [found, is_new] = nodes_.try_emplace(std::string(tf::stripLeadingSlashes(frame)));
  Node& node = found->second;
  if (is_new) {
    node.transform = new osg::MatrixTransform;
    node.transform->setName(found->first);
    node.transform->setDataVariance(osg::Object::DYNAMIC);
    node.transform->setNodeMask(0U);
    pose(found->first, *node.transform);
    root_->addChild(node.transform);
  }
  ++node.users;
  return *node.transform;
}

void FrameGraph::release(std::string_view frame) {
  const auto found = nodes_.find(std::string(tf::stripLeadingSlashes(frame)));
  if (found == nodes_.end() || --found->second.users > 0) {
    return;
  }
  root_->removeChild(found->second.transform);
  nodes_.erase(found);
}

osg::MatrixTransform* FrameGraph::node(std::string_view frame) const {
  const auto found = nodes_.find(std::string(tf::stripLeadingSlashes(frame)));
  return found == nodes_.end() ? nullptr : found->second.transform.get();
}

std::expected<tf::RigidTransform, tf::LookupFailure> FrameGraph::fixedFromFrame(std::string_view frame) const {
  frame = tf::stripLeadingSlashes(frame);
  if (is_ticked_ && !frame.empty() && frame == fixed_frame_) {
    return tf::RigidTransform{};
  }
  const tf::FrameId source = buffer_->findFrame(frame).value_or(tf::kNoFrame);
  const auto failure = [&](tf::LookupError code) {
    return std::unexpected(tf::LookupFailure{.code = code,
                                             .target = snapshot_.root,
                                             .source = source,
                                             .edge_child = tf::kNoFrame,
                                             .time = time_,
                                             .edge_first = {},
                                             .edge_last = {}});
  };
  if (snapshot_.root == tf::kNoFrame) {
    return failure(tf::LookupError::UnknownTarget);
  }
  if (source >= snapshot_.root_from_frame.size()) {
    return failure(tf::LookupError::UnknownSource);
  }
  return snapshot_.root_from_frame[source];
}

}  // namespace stillframe::scenegraph
