#include "nodes/point_cloud/cloud_points.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <set>
#include <tuple>

#include "nodes/own_buffer.h"
#include "scenegraph/pipeline/point_boxes.h"
#include "scenegraph/raster/sample_order.h"

namespace stillframe::nodes {

/// What has been made on demand so far.
struct CloudPoints::Lazy {
  std::mutex mutex;  // guards what is above message_mutex
  std::map<std::string, CloudChannel, std::less<>> channels;
  std::map<std::tuple<std::string, double, double>, ValueRange> percentiles;
  osg::ref_ptr<osg::Vec4ubArray> colors;
  std::set<std::string> prepared;
  std::mutex message_mutex;  // guards the rest; taken after `mutex` where both are
  std::weak_ptr<const scenegraph::PointCloud> message;
  std::shared_ptr<const scenegraph::PointCloud> held_message;
};

CloudPoints::CloudPoints() : lazy_(std::make_unique<Lazy>()) {}
CloudPoints::CloudPoints(CloudPoints&&) noexcept = default;
CloudPoints& CloudPoints::operator=(CloudPoints&&) noexcept = default;
CloudPoints::~CloudPoints() = default;

std::expected<CloudPoints, scenegraph::Status> CloudPoints::make(std::shared_ptr<const scenegraph::PointCloud> cloud,
                                                                 const CloudSupplement& supplement,
                                                                 const WantedChannel& wanted) {
  CloudPoints points;
  points.supplement_ = supplement;
  points.positions_ = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
  points.positions_->setVertexBufferObject(new osg::VertexBufferObject);
  points.channels_ = listChannels(*cloud);
  points.color_source_ = findColors(*cloud);
  const std::optional<std::string> name = wanted ? wanted(points) : std::nullopt;
  osg::ref_ptr<osg::FloatArray> values;
  std::optional<ChannelAlong> along;
  if (const ChannelInfo* const info = name ? points.findChannel(*name) : nullptr) {
    along.emplace(*cloud, *info, [&](std::size_t count) {
      values = makeArray<osg::FloatArray>(count);
      return values->asVector().data();
    });
  }
  const auto room = [&](std::size_t floats) {
    makeRoom(*points.positions_, floats / 3);
    return points.positions_->front().ptr();
  };
  auto converted = convertCloud(*cloud, room, along ? &*along : nullptr);
  if (!converted) {
    return std::unexpected(scenegraph::Status{
        scenegraph::StatusLevel::Error, std::string(toString(converted.error().code)), converted.error().message});
  }
  points.converted_ = std::move(*converted);
  points.positions_->resize(points.converted_.points);
  scenegraph::setBoxes(*points.positions_, std::move(points.converted_.boxes));
  if (values.valid()) {
    values->resize(points.converted_.points);
    points.lazy_->channels[*name] = {values, along->finish(points.converted_)};
  }
  points.message_bytes_ = cloud->data.bytes.size();
  points.cloud_ = std::move(cloud);
  return points;
}

void CloudPoints::settle(ReadMessage read) {
  if (message_bytes_ <= kSmallBytes) {
    return;
  }
  auto head = *cloud_;
  head.data = {};
  cloud_ = std::make_shared<const scenegraph::PointCloud>(std::move(head));
  read_ = std::move(read);
}

std::shared_ptr<const scenegraph::PointCloud> CloudPoints::message() const {
  if (!read_) {
    return cloud_;
  }
  const std::scoped_lock lock(lazy_->message_mutex);
  auto message = lazy_->message.lock();
  if (message == nullptr) {
    message = read_();
    // A file that was replaced meanwhile may hold another one there.
    message = message != nullptr && message->data.bytes.size() == message_bytes_ ? std::move(message) : nullptr;
    lazy_->message = message;
  }
  return message;
}

std::shared_ptr<const scenegraph::PointCloud> CloudPoints::holdMessage() const {
  auto message = this->message();
  const std::scoped_lock lock(lazy_->message_mutex);
  lazy_->held_message = message;
  return message;
}

const ChannelInfo* CloudPoints::findChannel(std::string_view name) const {
  const auto found = std::ranges::find(channels_, name, &ChannelInfo::name);
  return found != channels_.end() ? &*found : nullptr;
}

const CloudChannel* CloudPoints::channel(std::string_view name) const {
  const ChannelInfo* const info = findChannel(name);
  if (info == nullptr) {
    return nullptr;
  }
  const std::scoped_lock lock(lazy_->mutex);
  const auto [found, is_new] = lazy_->channels.try_emplace(info->name);
  CloudChannel& channel = found->second;
  if (is_new) {
    channel.values = makeArray<osg::FloatArray>(converted_.points);
    if (const auto cloud = message()) {
      channel.limits = convertChannel(*cloud, converted_, *info, channel.values->asVector());
    } else {
      std::ranges::fill(*channel.values, kMissingValue);
    }
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
    if (const auto cloud = message(); cloud != nullptr && converted_.points > 0) {
      convertColors(*cloud, converted_, *color_source_, std::span(lazy_->colors->front().ptr(), 4 * converted_.points));
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

std::array<ValueRange, 3> CloudPoints::sampledPercentiles(double low, double high) const {
  using scenegraph::kPassesOfSample;
  constexpr std::size_t kEnough = 16384;
  const std::size_t groups = (converted_.points + kPassesOfSample - 1) / kPassesOfSample;
  const std::size_t passes = std::min<std::size_t>(groups == 0 ? 0 : kEnough / groups + 1, kPassesOfSample);
  const std::size_t stride = groups / kEnough + 1;  // of one pass there may be too many as well
  std::array<std::vector<float>, 3> values;
  for (std::size_t group = 0; group < groups; group += stride) {
    for (std::size_t pass = 0; pass < passes; ++pass) {
      const std::size_t point = group * kPassesOfSample + scenegraph::placeInGroup(static_cast<std::uint32_t>(group),
                                                                                   static_cast<std::uint32_t>(pass));
      if (point < converted_.points) {
        for (std::size_t axis = 0; axis < values.size(); ++axis) {
          values[axis].push_back((*positions_)[point][static_cast<unsigned>(axis)]);
        }
      }
    }
  }
  std::array<ValueRange, 3> ranges;
  for (std::size_t axis = 0; axis < values.size(); ++axis) {
    ranges[axis] = percentileRange(values[axis], converted_.origin[static_cast<int>(axis)], low, high);
  }
  return ranges;
}

void CloudPoints::notePrepared(const std::string& work) const {
  const std::scoped_lock lock(lazy_->mutex);
  lazy_->prepared.insert(work);
}

bool CloudPoints::isPrepared(const std::string& work) const {
  const std::scoped_lock lock(lazy_->mutex);
  return lazy_->prepared.contains(work);
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
  const std::scoped_lock message_lock(lazy_->message_mutex);
  lazy_->held_message = nullptr;
}

std::size_t CloudPoints::byteSize() const {
  const std::scoped_lock lock(lazy_->mutex);
  std::size_t bytes = sizeof(*this) + cloud_->byteSize() + positions_->getTotalDataSize() +
                      scenegraph::knownBoxes(*positions_).size_bytes();
  for (const auto& [name, channel] : lazy_->channels) {
    bytes += channel.values->getTotalDataSize();
  }
  return bytes + (lazy_->colors.valid() ? lazy_->colors->getTotalDataSize() : 0);
}

}  // namespace stillframe::nodes
