#include "nodes/depth_image/depth_image_layer.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "nodes/images/depth_map.h"
#include "nodes/points/record_fields.h"
#include "nodes/points/value_histogram.h"
#include "scenegraph/geometry.h"

namespace stillframe::nodes {

using scenegraph::Status;
using scenegraph::StatusLevel;

std::unique_ptr<scenegraph::Layer> DepthImageLayer::create(std::string_view topic) {
  return std::make_unique<DepthImageLayer>(topic);
}

DepthImageLayer::DepthImageLayer(std::string_view topic)
    : SampleLayer(
          topic,
          {.type = scenegraph::ObjectType::Image,
           .tag = "depth",
           .convert = [](const scenegraph::AnyObject& object,
                         const DepthImageSettings&) { return DepthFrame::make(object.get<scenegraph::Image>()); },
           .is_reference = [](const DepthFrame& frame) { return frame.valid > 0; }},
          depthImageSettingsTable()) {}

void DepthImageLayer::open(const scenegraph::LayerContext& context) {
  SampleLayer::open(context);
  camera_.emplace(context, topic());
  color_.emplace(context, topic());
  geometry_ = addGeometry(state_.stateSet());
  geometry_->setNodeMask(scenegraph::kOpaquePoints);
}

void DepthImageLayer::close() {
  SampleLayer::close();
  camera_.reset();
  color_.reset();
  percentiles_ = {};
  geometry_ = nullptr;
}

void DepthImageLayer::clear() {
  SampleLayer::clear();
  range_.reset();
  show({});
  camera_->cancel();
  color_->cancel();
  is_joining_ = false;
  join_status_ = {};
}

bool DepthImageLayer::isWorking() const {
  return SampleLayer::isWorking() || camera_->isPending() || color_->isPending();
}

std::optional<TopicLayer::Anchor> DepthImageLayer::load(const scenegraph::Tick& tick) {
  loadSample(tick);
  auto joined = join(tick.time);
  is_joining_ = !joined.has_value();
  if (joined) {
    show(std::move(*joined));
  }
  measure();
  if (shown_.depth == nullptr) {
    return std::nullopt;
  }
  takeReference(shown_.depth);
  return anchorOf(*shown_.depth);
}

TopicLayer::Anchor DepthImageLayer::anchorOf(const DepthFrame& frame) const {
  return {chosen().frame == "auto" ? frame.source->frame_id : chosen().frame, {}};
}

osg::BoundingBoxd DepthImageLayer::box() const {
  return extent_.points > 0 ? osg::BoundingBoxd(extent_.box) : osg::BoundingBoxd();
}

void DepthImageLayer::draw(const Placement& /*fixed_from_data*/) {
  if (takeSettings()) {
    state_.apply(chosen());
  }
  const ValueRange range =
      chosen().range([&] { return ValueRange{reference()->nearest_m, reference()->farthest_m}; },
                     [&](double low, double high) { return percentiles_.of(reference(), low, high); });
  const bool is_flat = chosen().color_mode == "flat";
  range_.reset();
  if (!is_flat && shown_.colors == nullptr && shown_.depth != nullptr && shown_.rays != nullptr) {
    range_ = range;
  }
  state_.setColor(is_flat                    ? DepthColor::Flat
                  : shown_.colors != nullptr ? DepthColor::Rgb
                                             : DepthColor::Depth,
                  chosen().map(range));
}

std::optional<scenegraph::ColorLegend> DepthImageLayer::legend() const {
  return range_ ? std::optional(chosen().legend("depth", "m", *range_)) : std::nullopt;
}

std::function<scenegraph::ValueHistogram()> DepthImageLayer::histogramWork() const {
  if (!range_) {
    return nullptr;
  }
  return [depth = shown_.depth] {
    std::vector<float> depths;
    depths.reserve(depth->valid);
    std::ranges::copy_if(depth->depths->asVector(), std::back_inserter(depths),
                         [](float metres) { return metres > 0; });
    return histogramOf(depths, 0.0);
  };
}

std::optional<DepthImageLayer::Joined> DepthImageLayer::join(tf::TimePoint time) {
  Joined joined{.depth = loader().product(), .rays = nullptr, .colors = nullptr};
  if (joined.depth == nullptr || joined.depth->valid == 0) {
    camera_->cancel();
    color_->cancel();
    join_status_ = {};
    return joined;
  }
  const DepthFrame& depth = *joined.depth;
  const std::string frame(tf::stripLeadingSlashes(depth.source->frame_id));
  const auto rays = camera_->get(
      {frame, depth.width, depth.height, chosen().info_topic, depth.source->camera, chosen().rectify}, time);
  if (!rays) {
    return std::nullopt;
  }
  if (!*rays) {
    color_->cancel();
    join_status_ = rays->error();
    return joined;
  }
  joined.rays = **rays;
  if (chosen().color_mode != "rgb") {
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

void DepthImageLayer::show(Joined shown) {
  if (shown == shown_) {
    return;
  }
  if (shown_.depth != nullptr && shown_.depth != shown.depth) {
    shown_.depth->releaseGlObjects();
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
  const float limit = depthLimit(chosen());
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
  node().setMatrix(osg::Matrixd::scale(scale, scale, scale));
  state_.setUnit(static_cast<float>(1.0 / scale));
  geometry_->dirtyBound();
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

std::optional<scenegraph::Picked> DepthImageLayer::describeData(const scenegraph::PickHit& hit) const {
  const std::size_t i = hit.vertex;
  if (shown_.depth == nullptr || shown_.rays == nullptr || i >= shown_.depth->pixels() ||
      i >= shown_.rays->rays->size()) {
    return std::nullopt;
  }
  const DepthFrame& depth = *shown_.depth;
  const osg::Vec3& ray = (*shown_.rays->rays)[i];
  const float metres = (*depth.depths)[i];
  const std::size_t column = i % depth.width;
  const std::size_t row = i / depth.width;
  scenegraph::Picked picked{.kind = "pixel",
                            .id = std::to_string(column) + "," + std::to_string(row),
                            .point_in_frame = static_cast<double>(metres) * glm::dvec3(static_cast<double>(ray.x()),
                                                                                       static_cast<double>(ray.y()),
                                                                                       static_cast<double>(ray.z())),
                            .stamp = depth.source->stamp,
                            .fields = {},
                            .radius_m = 0.5};
  picked.add("column", column);
  picked.add("row", row);
  picked.add("depth_m", metres);
  picked.add("encoding", depth.source->encoding);
  if (shown_.colors != nullptr && i < shown_.colors->colors->size()) {
    const osg::Vec4ub& color = (*shown_.colors->colors)[i];
    picked.add("color", colorText(color.r(), color.g(), color.b()));
  }
  return picked;
}

Status DepthImageLayer::remark() const {
  const std::string sample = loadedText();
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
  auto specs = SampleLayer::settingSpecs();
  if (camera_) {
    for (std::string& name : camera_->topicNames()) {
      std::ranges::find(specs, "info_topic", &scenegraph::SettingSpec::key)->choices.push_back(std::move(name));
    }
  }
  return specs;
}

}  // namespace stillframe::nodes
