#include "nodes/poses/pose_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>

#include "nodes/points/convert_cloud.h"
#include "nodes/poses/polygon_fill.h"
#include "tf/wide_transform.h"

namespace stillframe::nodes {
namespace {

using scenegraph::PosesKind;

constexpr std::array<std::pair<std::string_view, PoseValue>, 6> kNames{{{"flat", PoseValue::None},
                                                                        {"time", PoseValue::Time},
                                                                        {"order", PoseValue::Order},
                                                                        {"x", PoseValue::X},
                                                                        {"y", PoseValue::Y},
                                                                        {"z", PoseValue::Z}}};

bool isFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool isNear(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= 0.5 * LineBuilder::kReach;  // from any origin
}

bool isFinite(const glm::dquat& q) {
  return std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
}

bool isUnit(const glm::dquat& q) {
  const double square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  return std::abs(square - 1.0) < 0.02;
}

bool isZero(const glm::dquat& q) { return q.x == 0.0 && q.y == 0.0 && q.z == 0.0 && q.w == 0.0; }

}  // namespace

PoseValue poseValueOf(std::string_view name) {
  const auto* const found = std::ranges::find(kNames, name, &std::pair<std::string_view, PoseValue>::first);
  return found != kNames.end() ? found->second : PoseValue::None;
}

struct PoseSet::Lazy {
  std::mutex mutex;  // guards all of it
  std::map<PoseValue, Line> lines;
  std::optional<std::optional<std::vector<std::uint32_t>>> fill;
};

PoseSet::PoseSet(std::shared_ptr<const scenegraph::PosesInFrame> source)
    : source_(std::move(source)), lazy_(std::make_unique<Lazy>()) {
  glm::dvec3 low(LineBuilder::kReach);
  glm::dvec3 high(-LineBuilder::kReach);
  const bool has_rotations = source_->kind != PosesKind::Point && source_->kind != PosesKind::Polygon;
  for (const tf::RigidTransform& pose : source_->poses) {
    if (!isFinite(pose.translation)) {
      ++faults_.not_finite;
      continue;
    }
    if (!isNear(pose.translation)) {
      ++faults_.out_of_reach;
      continue;
    }
    low = glm::min(low, pose.translation);
    high = glm::max(high, pose.translation);
    if (has_rotations && !isUnit(pose.rotation)) {
      std::size_t& count = !isFinite(pose.rotation) ? faults_.bad_rotations
                           : isZero(pose.rotation)  ? faults_.zero_rotations
                                                    : faults_.unnormalised;
      ++count;
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double middle = low[axis] / 2 + high[axis] / 2;
    origin_[axis] = low[axis] <= high[axis] && std::abs(middle) > ConvertedCloud::kNearby ? middle : 0.0;
  }
  has_times_ = source_->stamps.size() == source_->poses.size() &&
               std::ranges::any_of(source_->stamps, [&](tf::TimePoint t) { return t != source_->stamps.front(); });
}

PoseSet::PoseSet(PoseSet&&) noexcept = default;
PoseSet& PoseSet::operator=(PoseSet&&) noexcept = default;
PoseSet::~PoseSet() = default;

std::optional<glm::dvec3> PoseSet::point(std::size_t index) const {
  const glm::dvec3& place = source_->poses[index].translation;
  return isFinite(place) && isNear(place) ? std::optional(place) : std::nullopt;
}

std::optional<tf::RigidTransform> PoseSet::pose(std::size_t index) const {
  const auto place = point(index);
  const glm::dquat& sent = source_->poses[index].rotation;
  if (!place || !isFinite(sent)) {
    return std::nullopt;
  }
  return tf::RigidTransform{tf::normalizedRotation(sent).value_or(glm::dquat(1.0, 0.0, 0.0, 0.0)), *place};
}

double PoseSet::value(PoseValue by, std::size_t index) const {
  switch (by) {
    case PoseValue::Time:
      return tf::secondsBetween(source_->stamps.front(), source_->stamps[index]);
    case PoseValue::X:
      return source_->poses[index].translation.x;
    case PoseValue::Y:
      return source_->poses[index].translation.y;
    case PoseValue::Z:
      return source_->poses[index].translation.z;
    default:
      return static_cast<double>(index);
  }
}

const PoseSet::Line& PoseSet::line(PoseValue by) const {
  if (by == PoseValue::Time && !has_times_) {
    by = PoseValue::Order;
  }
  const std::scoped_lock lock(lazy_->mutex);
  const auto [found, is_new] = lazy_->lines.try_emplace(by);
  Line& line = found->second;
  if (!is_new) {
    return line;
  }
  line.offset = by == PoseValue::X ? origin_.x : by == PoseValue::Y ? origin_.y : by == PoseValue::Z ? origin_.z : 0.0;
  LineBuilder builder(origin_, by == PoseValue::None ? LineBuilder::Channel::None : LineBuilder::Channel::Values);
  builder.reserve(source_->poses.size());
  builder.begin(source_->kind == PosesKind::Polygon ? LineBuilder::Kind::Loop : LineBuilder::Kind::Strip);
  bool has_limits = false;
  for (std::size_t i = 0; i < source_->poses.size(); ++i) {
    const double value_here = by == PoseValue::None ? 0.0 : value(by, i);
    if (const auto place = point(i)) {
      line.limits.low = has_limits ? std::min(line.limits.low, value_here) : value_here;
      line.limits.high = has_limits ? std::max(line.limits.high, value_here) : value_here;
      has_limits = true;
    }
    builder.add(source_->poses[i].translation, {}, static_cast<float>(value_here - line.offset));
  }
  builder.end();
  line.arrays = builder.take();
  return line;
}

const std::vector<std::uint32_t>* PoseSet::fill() const {
  const std::scoped_lock lock(lazy_->mutex);
  if (!lazy_->fill) {
    lazy_->fill.emplace();
    if (faults_.not_finite + faults_.out_of_reach == 0) {
      std::vector<glm::dvec3> corners;
      for (const tf::RigidTransform& pose : source_->poses) {
        corners.push_back(pose.translation);
      }
      *lazy_->fill = fillPolygon(corners);
    }
  }
  return *lazy_->fill ? &**lazy_->fill : nullptr;
}

void PoseSet::releaseGlObjects() const {
  const std::scoped_lock lock(lazy_->mutex);
  for (const auto& [by, line] : lazy_->lines) {
    line.arrays.releaseGlObjects();
  }
}

std::size_t PoseSet::byteSize() const noexcept {
  return sizeof(*this) + source_->byteSize() + source_->poses.size() * (sizeof(osg::Vec4) + sizeof(float));
}

}  // namespace stillframe::nodes
