#include "nodes/depth_image/depth_image_layer.h"

#include <algorithm>
#include <cmath>

#include "nodes/images/depth_map.h"
#include "nodes/osg_math.h"
#include "nodes/points/value_range.h"
#include "scenegraph/geometry.h"
#include "scenegraph/placement.h"

namespace stillframe::nodes {

using scenegraph::Status;
using scenegraph::StatusLevel;

std::unique_ptr<scenegraph::Layer> DepthImageLayer::create(std::string_view topic) {
  return std::make_unique<DepthImageLayer>(topic);
}

DepthImageLayer::DepthImageLayer(std::string_view topic) : topic_(topic) {}

DepthImageLayer::~DepthImageLayer() = default;

void DepthImageLayer::attach(const scenegraph::LayerContext& context) {
  context_.emplace(context);
  loader_.emplace(
      context, scenegraph::ObjectType::Image, topic_, "depth",
      [](const scenegraph::AnyObject& object, const scenegraph::Entry&) {
        return DepthFrame::make(object.get<scenegraph::Image>());
      },
      [](const DepthFrame& frame) { return frame.valid > 0; });
  camera_.emplace(context, topic_);
  color_.emplace(context, topic_);
  geometry_ = scenegraph::makeGeometry();
  geometry_->setName(topic_);
  node_ = new osg::MatrixTransform;
  node_->setName(topic_);
  node_->setStateSet(state_.stateSet());
  node_->addChild(geometry_);
  applied_.reset();
}

void DepthImageLayer::detach() {
  if (context_) {
    clear();
  }
  loader_.reset();
  camera_.reset();
  color_.reset();
  reference_ = nullptr;
  percentiles_ = {};
  geometry_ = nullptr;
  node_ = nullptr;
  context_.reset();
}

void DepthImageLayer::setVisible(bool visible) {
  visible_ = visible;
  if (!visible && context_) {
    clear();
  }
}

void DepthImageLayer::clear() {
  show({});
  hold(std::nullopt);
  camera_->cancel();
  color_->cancel();
  is_joining_ = false;
  applied_.reset();
  status_ = {};
  join_status_ = {};
  bounds_.init();
}

bool DepthImageLayer::isPending() const {
  return visible_ && loader_ && (loader_->isPending() || camera_->isPending() || color_->isPending());
}

void DepthImageLayer::update(const scenegraph::Tick& tick) {
  if (!context_ || !visible_) {
    return;
  }
  (void)loader_->update(tick.time);
  auto joined = join(tick.time);
  is_joining_ = !joined.has_value();
  if (joined) {
    show(std::move(*joined));
  }
  hold(shown_.depth != nullptr ? std::optional(std::string(tf::stripLeadingSlashes(shown_.depth->source->frame_id)))
                               : std::nullopt);
  if (applied_ != settings_) {
    state_.apply(settings_);
    applied_ = settings_;
  }
  measure();
  if (shown_.depth != nullptr) {
    const auto reference = loader_->reference();
    reference_ = reference != nullptr ? reference : shown_.depth;
    paint();
  }
  const Placement placement =
      held_frame_ ? context_->frames.fixedFromFrame(*held_frame_) : Placement(std::unexpected(tf::LookupFailure{}));
  bounds_.init();
  if (placement && extent_.points > 0) {
    for (unsigned i = 0; i < 8; ++i) {
      const osg::Vec3 corner = extent_.box.corner(i);
      bounds_.expandBy(toOsg(tf::transformPoint(*placement, {corner.x(), corner.y(), corner.z()})));
    }
  }
  status_ = judge(placement);
}

std::optional<DepthImageLayer::Shown> DepthImageLayer::join(tf::TimePoint time) {
  Shown joined{.depth = loader_->product(), .rays = nullptr, .colors = nullptr};
  if (joined.depth == nullptr || joined.depth->valid == 0) {
    camera_->cancel();
    color_->cancel();
    join_status_ = {};
    return joined;
  }
  const DepthFrame& depth = *joined.depth;
  const std::string frame(tf::stripLeadingSlashes(depth.source->frame_id));
  const auto rays = camera_->get({frame, depth.width, depth.height, settings_.info_topic, settings_.rectify}, time);
  if (!rays) {
    return std::nullopt;
  }
  if (!*rays) {
    color_->cancel();
    join_status_ = rays->error();
    return joined;
  }
  joined.rays = **rays;
  if (settings_.color_mode != "rgb") {
    color_->cancel();
    join_status_ = {};
    return joined;
  }
  const auto colors = color_->get(frame, depth.width, depth.height, time);
  if (!colors) {
    return std::nullopt;
  }
  joined.colors = colors->value_or(nullptr);
  join_status_ = *colors ? Status{} : colors->error();
  return joined;
}

void DepthImageLayer::show(Shown shown) {
  if (shown == shown_) {
    return;
  }
  if (shown_.depth != nullptr && shown_.depth != shown.depth) {
    shown_.depth->depths->releaseGLObjects();
  }
  if (shown_.rays != nullptr && shown_.rays != shown.rays) {
    shown_.rays->rays->releaseGLObjects();
  }
  if (shown_.colors != nullptr && shown_.colors != shown.colors) {
    shown_.colors->colors->releaseGLObjects();
  }
  shown_ = std::move(shown);
  measured_limit_.reset();
}

void DepthImageLayer::measure() {
  const float limit = depthLimit(settings_);
  if (measured_limit_ == limit) {
    return;
  }
  measured_limit_ = limit;
  extent_ = {};
  geometry_->removePrimitiveSet(0, geometry_->getNumPrimitiveSets());
  geometry_->setColorArray(nullptr);
  geometry_->setVertexAttribArray(DepthState::kDepthAttribute, nullptr);
  geometry_->setVertexArray(nullptr);
  if (shown_.rays != nullptr) {
    const osg::FloatArray& depths = *shown_.depth->depths;
    const osg::Vec3Array& rays = *shown_.rays->rays;
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const float depth = depths[i];
      if (depth > 0.0F && depth <= limit && rays[i].z() > 0.0F) {
        ++extent_.points;
        extent_.box.expandBy(rays[i] * depth);
      }
    }
  }
  if (extent_.points > 0) {
    const auto vertices = static_cast<GLsizei>(shown_.depth->depths->size());
    geometry_->setVertexArray(shown_.rays->rays);
    geometry_->setVertexAttribArray(DepthState::kDepthAttribute, shown_.depth->depths);
    geometry_->setColorArray(shown_.colors != nullptr ? shown_.colors->colors.get() : nullptr);
    geometry_->addPrimitiveSet(new osg::DrawArrays(GL_POINTS, 0, vertices));
  }
  // The vertices are rays of depth 1. Scaled by a power of two (exact) no less than the greatest depth they bound the
  // points for culling, near and far. An initial bound would not do: OSG 3.6.5 cannot read it back from .osgt.
  const double scale = extent_.points > 0 ? std::exp2(std::ceil(std::log2(extent_.box.zMax()))) : 1.0;
  node_->setMatrix(osg::Matrixd::scale(scale, scale, scale));
  state_.setUnit(static_cast<float>(1.0 / scale));
  geometry_->dirtyBound();
}

void DepthImageLayer::hold(const std::optional<std::string>& frame) {
  if (held_frame_ == frame) {
    return;
  }
  if (held_frame_) {
    if (osg::MatrixTransform* const parent = context_->frames.node(*held_frame_)) {
      parent->removeChild(node_);
    }
    context_->frames.release(*held_frame_);
  }
  held_frame_ = frame;
  if (held_frame_) {
    context_->frames.acquire(*held_frame_).addChild(node_);
  }
}

ValueRange DepthImageLayer::Percentiles::of(const std::shared_ptr<const DepthFrame>& frame, double low, double high) {
  if (of_frame != frame || of_low != low || of_high != high) {
    range = percentileRange(frame->depths->asVector(), 0.0, low, high);
    of_frame = frame;
    of_low = low;
    of_high = high;
  }
  return range;
}

void DepthImageLayer::paint() {
  const ValueRange range =
      settings_.range([&] { return ValueRange{reference_->nearest_m, reference_->farthest_m}; },
                      [&](double low, double high) { return percentiles_.of(reference_, low, high); });
  const bool is_flat = settings_.color_mode == "flat";
  state_.setColor(is_flat                    ? DepthColor::Flat
                  : shown_.colors != nullptr ? DepthColor::Rgb
                                             : DepthColor::Depth,
                  settings_.map(range));
}

Status DepthImageLayer::judge(const Placement& placement) const {
  if (shown_.depth == nullptr) {
    return loader_->status();
  }
  if (!placement) {
    return scenegraph::placementStatus(context_->frames, *held_frame_, placement.error());
  }
  if (loader_->status().level != StatusLevel::Ok) {
    return loader_->status();
  }
  const std::string sample = "'" + topic_ + "' at " + scenegraph::timeText(loader_->entry()->log_time) + ": ";
  if (is_joining_) {
    return {StatusLevel::Warn, "Decoding", sample + "its camera is being looked up"};
  }
  if (join_status_.level != StatusLevel::Ok) {
    return join_status_;
  }
  if (shown_.depth->valid == 0) {
    return {StatusLevel::Info, "NoDepth",
            sample + "none of its " + std::to_string(shown_.depth->pixels()) + " pixels has a depth"};
  }
  if (shown_.rays->without_ray > 0) {
    return {StatusLevel::Info, "NotRectified",
            sample + std::to_string(shown_.rays->without_ray) + " of " + std::to_string(shown_.depth->pixels()) +
                " pixels are left out, because the distortion model of the camera has no inverse there"};
  }
  return {};
}

scenegraph::LayerCounts DepthImageLayer::counts() const {
  if (shown_.depth == nullptr) {
    return {{"points", 0}, {"holes", 0}, {"left_out", 0}, {"bytes", 0}, {"residual_npx", 0}};
  }
  const DepthFrame& depth = *shown_.depth;
  const double residual_px = shown_.rays != nullptr ? shown_.rays->largest_residual_px : 0.0;
  return {{"points", extent_.points},
          {"holes", depth.pixels() - depth.valid},
          {"left_out", depth.valid - extent_.points},
          {"bytes", depth.source->data.bytes.size()},
          {"residual_npx", static_cast<std::uint64_t>(std::ceil(residual_px * 1e9))}};
}

std::vector<scenegraph::SettingSpec> DepthImageLayer::settingSpecs() const {
  auto specs = depthImageSettingsTable().specs();
  if (camera_) {
    for (std::string& name : camera_->topicNames()) {
      specs.back().choices.push_back(std::move(name));
    }
  }
  return specs;
}

scenegraph::SettingTexts DepthImageLayer::settings() const { return depthImageSettingsTable().texts(settings_); }

std::expected<void, scenegraph::SettingError> DepthImageLayer::applySettings(const scenegraph::SettingTexts& texts) {
  return depthImageSettingsTable().apply(texts, settings_);
}

}  // namespace stillframe::nodes
