#include "tests/scenegraph/fake_layer.h"

#include <cstring>
#include <glm/vec3.hpp>
#include <osg/Point>
#include <osg/StateSet>

#include "scenegraph/geometry.h"
#include "scenegraph/objects/point_cloud.h"
#include "scenegraph/placement.h"

namespace stillframe::test {
namespace {

using scenegraph::AnyObject;
using scenegraph::Entry;
using scenegraph::LayerType;
using scenegraph::ObjectType;
using scenegraph::SettingKind;
using scenegraph::SettingsTable;
using scenegraph::Status;

std::expected<FakeLayer::Points, Status> convert(const AnyObject& object, const Entry& /*entry*/) {
  const auto cloud = object.get<scenegraph::PointCloud>();
  FakeLayer::Points points{cloud->frame_id, std::vector<osg::Vec3f>(cloud->width)};
  if (cloud->data.bytes.size() != points.positions.size() * sizeof(osg::Vec3f)) {
    return std::unexpected(Status{scenegraph::StatusLevel::Error, "MalformedCloud", "three floats a point are wanted"});
  }
  if (!points.positions.empty()) {
    std::memcpy(static_cast<void*>(points.positions.data()), cloud->data.bytes.data(), cloud->data.bytes.size());
  }
  return points;
}

const SettingsTable<FakeLayer::Settings>& table() {
  static const SettingsTable<FakeLayer::Settings> kTable{
      {{.key = "size",
        .label = "Size (px)",
        .help = "Size of a point.",
        .kind = SettingKind::Double,
        .minimum = 0.5,
        .maximum = 64.0},
       &FakeLayer::Settings::size_px},
      {{.key = "flat", .label = "Flat", .help = "Draws every point at z = 0.", .kind = SettingKind::Bool},
       &FakeLayer::Settings::is_flat}};
  return kTable;
}

}  // namespace

FakeLayer::FakeLayer(std::string_view topic) : topic_(topic) {}

void FakeLayer::attach(const scenegraph::LayerContext& context) {
  context_.emplace(context);
  loader_.emplace(context, ObjectType::PointCloud, topic_, "fake", convert);
}

void FakeLayer::update(const scenegraph::Tick& tick) {
  if (!is_visible_) {
    return;
  }
  const bool has_new_sample = loader_->update(tick.time);
  if (has_new_sample || has_new_settings_) {
    showPoints();
    has_new_settings_ = false;
  }
  status_ = loader_->status();
  if (held_frame_ && status_.level <= scenegraph::StatusLevel::Info) {
    if (const auto fixed_from_frame = context_->frames.fixedFromFrame(*held_frame_); !fixed_from_frame) {
      status_ = scenegraph::placementStatus(context_->frames, *held_frame_, fixed_from_frame.error());
    }
  }
}

void FakeLayer::showPoints() {
  const auto& points = loader_->product();
  if (points == nullptr || points->positions.empty()) {
    hangIn(std::nullopt);
    return;
  }
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array(points->positions.begin(), points->positions.end());
  for (osg::Vec3f& vertex : *vertices) {
    vertex.z() = settings_.is_flat ? 0.0F : vertex.z();
  }
  hangIn(std::nullopt);
  geometry_ = scenegraph::makeGeometry();
  geometry_->setVertexArray(vertices);
  geometry_->addPrimitiveSet(new osg::DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(vertices->size())));
  osg::ref_ptr<osg::Point> point = new osg::Point(static_cast<float>(settings_.size_px));
  geometry_->getOrCreateStateSet()->setAttributeAndModes(point);
  hangIn(points->frame_id);
}

void FakeLayer::hangIn(const std::optional<std::string>& frame) {
  if (held_frame_) {
    context_->frames.node(*held_frame_)->removeChild(geometry_);
    context_->frames.release(*held_frame_);
    geometry_ = nullptr;
  }
  held_frame_ = frame;
  if (held_frame_) {
    context_->frames.acquire(*held_frame_).addChild(geometry_);
  }
}

void FakeLayer::detach() {
  hangIn(std::nullopt);
  loader_.reset();
  context_.reset();
  has_new_settings_ = true;
}

void FakeLayer::changeVisible(bool visible) {
  is_visible_ = visible;
  has_new_settings_ = true;
  if (!visible && context_) {
    hangIn(std::nullopt);
  }
}

scenegraph::LayerCounts FakeLayer::counts() const {
  const bool has_points = loader_ && loader_->product() != nullptr;
  return {{"points", has_points ? loader_->product()->positions.size() : 0}};
}

osg::BoundingBoxd FakeLayer::boundsInFixed() const {
  osg::BoundingBoxd box;
  const auto fixed_from_frame =
      held_frame_ ? context_->frames.fixedFromFrame(*held_frame_) : std::unexpected(tf::LookupFailure{});
  if (fixed_from_frame) {
    for (const osg::Vec3f& vertex : static_cast<const osg::Vec3Array&>(*geometry_->getVertexArray())) {
      const glm::dvec3 in_fixed = tf::transformPoint(*fixed_from_frame, {vertex.x(), vertex.y(), vertex.z()});
      box.expandBy(in_fixed.x, in_fixed.y, in_fixed.z);
    }
  }
  return box;
}

std::vector<scenegraph::SettingSpec> FakeLayer::settingSpecs() const { return table().specs(); }

scenegraph::SettingTexts FakeLayer::settings() const { return table().texts(settings_); }

std::expected<void, scenegraph::SettingError> FakeLayer::changeSettings(const scenegraph::SettingTexts& texts) {
  has_new_settings_ = true;
  return table().apply(texts, settings_);
}

std::span<const LayerType> fakeTypes() {
  static const LayerType kTypes[] = {
      {"fake", "Fake", ObjectType::PointCloud, [](std::string_view topic) -> std::unique_ptr<scenegraph::Layer> {
         return std::make_unique<FakeLayer>(topic);
       }}};
  return kTypes;
}

}  // namespace stillframe::test
