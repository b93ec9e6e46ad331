#include "nodes/point_cloud/cloud_points.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

#include "scenegraph/pipeline/point_boxes.h"

namespace stillframe::nodes {
namespace {

/// An array with a buffer of its own: OSG would put all arrays of a geometry into one, and upload all when one changes.
template <typename Array>
osg::ref_ptr<Array> makeArray(std::size_t size) {
  osg::ref_ptr<Array> array = new Array(osg::Array::BIND_PER_VERTEX);
  array->resize(size);
  array->setVertexBufferObject(new osg::VertexBufferObject);
  return array;
}

}  // namespace

/// What has been made on demand so far.
struct CloudPoints::Lazy {
  std::mutex mutex;  // guards everything below
  std::map<std::string, CloudChannel, std::less<>> channels;
  std::map<std::tuple<std::string, double, double>, ValueRange> percentiles;
  osg::ref_ptr<osg::Vec4ubArray> colors;
};

CloudPoints::CloudPoints() : lazy_(std::make_unique<Lazy>()) {}
CloudPoints::CloudPoints(CloudPoints&&) noexcept = default;
CloudPoints& CloudPoints::operator=(CloudPoints&&) noexcept = default;
CloudPoints::~CloudPoints() = default;

std::expected<CloudPoints, scenegraph::Status> CloudPoints::make(std::shared_ptr<const scenegraph::PointCloud> cloud,
                                                                 const CloudSupplement& supplement) {
  CloudPoints points;
  points.supplement_ = supplement;
  points.positions_ = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
  points.positions_->setVertexBufferObject(new osg::VertexBufferObject);
  auto converted = convertCloud(*cloud, [&](std::size_t floats) {
    points.positions_->resize(floats / 3);
    return points.positions_->front().ptr();
  });
  if (!converted) {
    return std::unexpected(scenegraph::Status{
        scenegraph::StatusLevel::Error, std::string(toString(converted.error().code)), converted.error().message});
  }
  points.converted_ = std::move(*converted);
  points.positions_->resize(points.converted_.points);
  scenegraph::findBoxes(*points.positions_);
  points.channels_ = listChannels(*cloud);
  points.color_source_ = findColors(*cloud);
  points.cloud_ = std::move(cloud);
  return points;
}

const CloudChannel* CloudPoints::channel(std::string_view name) const {
  const auto info = std::ranges::find(channels_, name, &ChannelInfo::name);
  if (info == channels_.end()) {
    return nullptr;
  }
  const std::scoped_lock lock(lazy_->mutex);
  const auto [found, is_new] = lazy_->channels.try_emplace(info->name);
  CloudChannel& channel = found->second;
  if (is_new) {
    channel.values = makeArray<osg::FloatArray>(converted_.points);
    channel.limits = convertChannel(*cloud_, converted_, *info, channel.values->asVector());
  }
  return &channel;
}

osg::Vec4ubArray* CloudPoints::colors() const {
  if (!color_source_) {
    return nullptr;
  }
  const std::scoped_lock lock(lazy_->mutex);
  if (!lazy_->colors.valid()) {
    lazy_->colors = makeArray<osg::Vec4ubArray>(converted_.points);
    if (converted_.points > 0) {
      convertColors(*cloud_, converted_, *color_source_,
                    std::span(lazy_->colors->front().ptr(), 4 * converted_.points));
    }
  }
  return lazy_->colors.get();
}

ValueRange CloudPoints::channelPercentiles(std::string_view name, double low, double high) const {
  const CloudChannel* const values = channel(name);
  if (values == nullptr) {
    return {0.0, 0.0};
  }
  const std::scoped_lock lock(lazy_->mutex);
  const auto [found, is_new] = lazy_->percentiles.try_emplace({"channel " + std::string(name), low, high});
  if (is_new) {
    found->second = percentileRange(values->values->asVector(), values->limits.offset, low, high);
  }
  return found->second;
}

ValueRange CloudPoints::axisPercentiles(int axis, double low, double high) const {
  const std::scoped_lock lock(lazy_->mutex);
  const auto [found, is_new] = lazy_->percentiles.try_emplace({"axis " + std::to_string(axis), low, high});
  if (is_new && converted_.points > 0) {
    found->second = percentileRangeOfAxis(std::span(positions_->front().ptr(), 3 * converted_.points), axis,
                                          converted_.origin[axis], low, high);
  }
  return found->second;
}

void CloudPoints::releaseGlObjects() const {
  positions_->releaseGLObjects();
  const std::scoped_lock lock(lazy_->mutex);
  if (lazy_->colors.valid()) {
    lazy_->colors->releaseGLObjects();
  }
  for (const auto& [name, channel] : lazy_->channels) {
    channel.values->releaseGLObjects();
  }
}

std::size_t CloudPoints::byteSize() const noexcept {
  return sizeof(*this) + cloud_->byteSize() + converted_.points * (sizeof(osg::Vec3) + sizeof(float));
}

}  // namespace stillframe::nodes
