#include "nodes/topic_layer.h"

#include "nodes/osg_math.h"
#include "scenegraph/geometry.h"
#include "scenegraph/placement.h"
#include "scenegraph/store/tf_clock.h"

namespace stillframe::nodes {

using scenegraph::Status;
using scenegraph::StatusLevel;

namespace {

osg::BoundingBoxd boxInFixed(const tf::RigidTransform& fixed_from_data, const osg::BoundingBoxd& box_in_data) {
  osg::BoundingBoxd box_in_fixed;
  for (unsigned i = 0; i < 8; ++i) {
    const osg::Vec3d corner = box_in_data.corner(i);
    box_in_fixed.expandBy(toOsg(tf::transformPoint(fixed_from_data, {corner.x(), corner.y(), corner.z()})));
  }
  return box_in_fixed;
}

}  // namespace

void TopicLayer::attach(const scenegraph::LayerContext& context) {
  context_.emplace(context);
  node_ = new osg::MatrixTransform;
  node_->setName(topic_);
  open(*context_);
}

void TopicLayer::detach() {
  if (!context_) {
    return;
  }
  leave();
  close();
  node_ = nullptr;
  context_.reset();
}

void TopicLayer::changeVisible(bool visible) {
  visible_ = visible;
  if (!visible && context_) {
    leave();
  }
}

void TopicLayer::leave() {
  clear();
  hold(std::nullopt);
  status_ = {};
  bounds_.init();
}

void TopicLayer::update(const scenegraph::Tick& tick) {
  if (!context_ || !visible_) {
    return;
  }
  const auto anchor = load(tick);
  hold(anchor ? std::optional(std::string(tf::stripLeadingSlashes(anchor->frame))) : std::nullopt);
  Placement placement = std::unexpected(tf::LookupFailure{});
  bounds_.init();
  if (anchor) {
    placement = context_->frames.fixedFromFrame(*held_frame_);
    if (placement) {
      placement = *placement * anchor->frame_from_data;
    }
    draw(placement);
    if (const osg::BoundingBoxd extent = box(); placement && extent.valid()) {
      fixed_from_data_ = *placement;
      bounds_ = boxInFixed(fixed_from_data_, extent);
    }
  }
  status_ = judge(anchor.has_value(), placement);
}

std::vector<scenegraph::Box> TopicLayer::bulkInFixed() const {
  return {bounds_.valid() ? scenegraph::toBox(boxInFixed(fixed_from_data_, bulk())) : scenegraph::Box()};
}

std::optional<scenegraph::Picked> TopicLayer::describe(const scenegraph::PickHit& hit) const {
  const bool is_ours = visible_ && context_ && held_frame_ == hit.frame && hit.isBeneath(*node_);
  return is_ours ? describeData(hit) : std::nullopt;
}

void TopicLayer::collectNodes(std::vector<osg::Node*>& nodes) const {
  if (held_frame_) {
    nodes.push_back(node_);
  }
}

void TopicLayer::hold(const std::optional<std::string>& frame) {
  if (held_frame_ == frame) {
    return;
  }
  if (held_frame_) {
    context_->frames.unhang(*held_frame_, *node_);
  }
  held_frame_ = frame;
  if (held_frame_) {
    context_->frames.hang(*held_frame_, *node_);
  }
}

Status TopicLayer::judge(bool has_data, const Placement& placement) const {
  if (has_data && !placement) {
    return scenegraph::placementStatus(context_->frames, *held_frame_, placement.error());
  }
  if (!has_data || sourceStatus().level != StatusLevel::Ok) {
    return sourceStatus();
  }
  return remark();
}

osg::ref_ptr<osg::Geometry> TopicLayer::addGeometry(osg::StateSet* state) const {
  osg::ref_ptr<osg::Geometry> geometry = scenegraph::makeGeometry();
  geometry->setName(topic_);
  node_->setStateSet(state);
  node_->addChild(geometry);
  return geometry;
}

std::string TopicLayer::sampleText(const scenegraph::Entry& entry) const {
  return "'" + topic_ + "' at " + scenegraph::timeText(entry.log_time) + ": ";
}

}  // namespace stillframe::nodes
