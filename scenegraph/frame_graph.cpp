#include "scenegraph/frame_graph.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <glm/gtc/type_ptr.hpp>
#include <osg/Matrixd>
#include <utility>
#include <vector>

#include "scenegraph/buffer_patches.h"

namespace stillframe::scenegraph {
namespace {

constexpr osg::Node::NodeMask kShown = ~0U;
constexpr std::size_t kAsksAhead = 8;

/// Has the memory come that posing a node reads and writes: nodes lie all over it.
void askFor(const osg::MatrixTransform& node) {
  constexpr std::ptrdiff_t kLine = 64;
  const char* const first = reinterpret_cast<const char*>(&node);
  const char* const end = first + sizeof node;
  for (const char* line = first; line < end; line += kLine) {
    __builtin_prefetch(line, 1);
  }
}

/// The state must not depend on which of 0 and -0 was there before.
bool isSameByBits(const tf::RigidTransform& a, const tf::RigidTransform& b) {
  using Bits = std::array<std::uint64_t, 7>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

template <typename Key>
void sortChildren(osg::Group& group, const Key& key_of) {
  std::vector<std::pair<decltype(key_of(nullptr)), osg::ref_ptr<osg::Node>>> sorted;
  for (unsigned i = 0; i < group.getNumChildren(); ++i) {
    sorted.emplace_back(key_of(group.getChild(i)), group.getChild(i));
  }
  using Keyed = typename decltype(sorted)::value_type;
  if (std::ranges::is_sorted(sorted, {}, &Keyed::first)) {
    return;
  }
  std::ranges::stable_sort(sorted, {}, &Keyed::first);
  for (unsigned i = 0; i < group.getNumChildren(); ++i) {
    group.setChild(i, sorted[i].second);
  }
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
  const bool has_new_ids = ids_revision_ != snapshot_.revision;
  ids_revision_ = snapshot_.revision;
  const auto fixed = fixed_frame_.empty() ? places_.end() : places_.find(fixed_frame_);
  const std::size_t place_of_fixed = fixed == places_.end() ? nodes_.size() : fixed->second;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (i + kAsksAhead < nodes_.size()) {
      askFor(*nodes_[i + kAsksAhead].transform);
    }
    Node& node = nodes_[i];
    if (has_new_ids) {
      node.id = idOf(node.transform->getName());
    }
    pose(node, i == place_of_fixed ? Pose{} : poseInTree(node.id));
  }
}

void FrameGraph::pose(Node& node, const Pose& fixed_from_frame) {
  const osg::Node::NodeMask mask = fixed_from_frame ? kShown : 0U;
  if (fixed_from_frame && !isSameByBits(node.posed, *fixed_from_frame)) {
    node.transform->setMatrix(osg::Matrixd(glm::value_ptr(tf::toMatrix(*fixed_from_frame))));
    node.posed = *fixed_from_frame;
    ++counts_.matrices_written;
  }
  if (node.transform->getNodeMask() != mask) {
    node.transform->setNodeMask(mask);
    ++counts_.masks_changed;
  }
}

osg::MatrixTransform& FrameGraph::acquire(std::string_view frame) {
  const auto [found, is_new] = places_.try_emplace(std::string(tf::stripLeadingSlashes(frame)), nodes_.size());
  if (is_new) {
    Node& made = nodes_.emplace_back();
    made.transform = new osg::MatrixTransform;
    made.transform->setName(found->first);
    made.transform->setDataVariance(osg::Object::DYNAMIC);
    made.transform->setNodeMask(0U);
    made.id = idOf(found->first);
    pose(made, poseOf(found->first, made.id));
    root_->addChild(made.transform);
  }
  Node& node = nodes_[found->second];
  ++node.users;
  ++hang_revision_;
  return *node.transform;
}

void FrameGraph::release(std::string_view frame) {
  const auto found = places_.find(std::string(tf::stripLeadingSlashes(frame)));
  ++hang_revision_;
  if (found == places_.end() || --nodes_[found->second].users > 0) {
    return;
  }
  const std::size_t place = found->second;
  root_->removeChild(nodes_[place].transform);
  places_.erase(found);
  if (place + 1 < nodes_.size()) {
    nodes_[place] = std::move(nodes_.back());
    places_[nodes_[place].transform->getName()] = place;
  }
  nodes_.pop_back();
}

void FrameGraph::hang(std::optional<std::string_view> frame, osg::Node& child) {
  osg::Group& parent = frame ? static_cast<osg::Group&>(acquire(*frame)) : *root_;
  parent.addChild(&child);
  ++hang_revision_;
}

void FrameGraph::unhang(std::optional<std::string_view> frame, osg::Node& child) {
  if (osg::Group* const parent = frame ? static_cast<osg::Group*>(node(*frame)) : root_.get()) {
    parent->removeChild(&child);
  }
  if (frame) {
    release(*frame);
  }
  ++hang_revision_;
}

void FrameGraph::arrange(std::span<osg::Node* const> nodes) {
  std::unordered_map<const osg::Node*, std::size_t> places;
  for (osg::Node* const node : nodes) {
    places.try_emplace(node, places.size());
  }
  const auto placeOf = [&](const osg::Node* node) {
    const auto found = places.find(node);
    return found == places.end() ? places.size() : found->second;
  };
  std::unordered_map<const osg::Node*, std::size_t> firsts;
  for (const Node& node : nodes_) {
    sortChildren(*node.transform, placeOf);
    firsts[node.transform.get()] =
        node.transform->getNumChildren() > 0 ? placeOf(node.transform->getChild(0)) : places.size();
  }
  sortChildren(*root_, [&](const osg::Node* child) {
    const auto found = firsts.find(child);
    return std::pair(found == firsts.end() ? placeOf(child) : found->second, std::string_view(child->getName()));
  });
}

osg::MatrixTransform* FrameGraph::node(std::string_view frame) const {
  const auto found = places_.find(std::string(tf::stripLeadingSlashes(frame)));
  return found == places_.end() ? nullptr : nodes_[found->second].transform.get();
}

tf::FrameId FrameGraph::idOf(std::string_view frame) const { return buffer_->findFrame(frame).value_or(tf::kNoFrame); }

FrameGraph::Pose FrameGraph::fixedFromFrame(std::string_view frame) const {
  frame = tf::stripLeadingSlashes(frame);
  return poseOf(frame, idOf(frame));
}

FrameGraph::Pose FrameGraph::poseOf(std::string_view frame, tf::FrameId source) const {
  if (is_ticked_ && !frame.empty() && frame == fixed_frame_) {
    return tf::RigidTransform{};
  }
  return poseInTree(source);
}

FrameGraph::Pose FrameGraph::poseInTree(tf::FrameId source) const {
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
