#include "nodes/laser_scan/sensor_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>

#include "scenegraph/store/tf_clock.h"

namespace stillframe::nodes {
namespace {

using scenegraph::Status;
using scenegraph::StatusLevel;

bool isSame(const tf::RigidTransform& a, const tf::RigidTransform& b) {
  return a.rotation == b.rotation && a.translation == b.translation;
}

/// The earliest stamp of the edge above `child` after `time`, at or before `limit`; nullopt when there is none.
std::optional<tf::TimePoint> stampAfter(const tf::TransformBuffer& buffer, tf::FrameId child, tf::TimePoint time,
                                        tf::TimePoint limit) {
  auto above = buffer.stampInForce(child, limit);
  if (!above || *above <= time) {
    return std::nullopt;
  }
  // Halves what is left until the stamp before `above` is not after `time`.
  while (true) {
    const auto before = buffer.stampInForce(child, {above->ns - 1});
    if (!before || *before <= time) {
      return above;
    }
    const auto gap = static_cast<std::uint64_t>(before->ns) - static_cast<std::uint64_t>(time.ns);
    const tf::TimePoint middle{time.ns + static_cast<std::int64_t>(gap / 2)};
    const auto half = buffer.stampInForce(child, middle);
    if (half && *half > time) {
      above = half;
    } else {
      above = before;
      time = middle;
    }
  }
}

}  // namespace

std::expected<SensorMotion, Status> SensorMotion::sample(const tf::TransformBuffer& buffer, std::string_view inertial,
                                                         std::string_view sensor, tf::TimePoint begin,
                                                         tf::TimePoint end) {
  SensorMotion motion;
  const auto top = buffer.findFrame(inertial);
  const auto bottom = buffer.findFrame(sensor);
  if (!top || !bottom) {
    return std::unexpected(Status{StatusLevel::Info, "NotDeskewed",
                                  "no transform has named '" + std::string(!top ? inertial : sensor) + "' yet"});
  }
  for (tf::FrameId child = *bottom; child != *top;) {
    const tf::FrameId parent = buffer.parent(child);
    const auto info = buffer.edge(child);
    if (parent == tf::kNoFrame || !info) {
      return std::unexpected(Status{StatusLevel::Info, "NotDeskewed",
                                    "'" + std::string(inertial) + "' is no ancestor of '" + std::string(sensor) + "'"});
    }
    Edge edge;
    const auto add = [&](tf::TimePoint stamp) {
      if (const auto pose = buffer.tryLookupTransform(parent, child, stamp)) {
        edge.push_back({stamp, *pose});
        return true;
      }
      return false;
    };
    if (info->is_static) {
      if (const auto pose = buffer.tryLookupTransform(parent, child, begin)) {
        edge.push_back({begin, *pose});
      }
    } else if (auto stamp = buffer.stampInForce(child, begin)) {
      const std::int64_t least_gap = (end.ns - begin.ns) / static_cast<std::int64_t>(kMaxKnots);
      while (stamp && add(*stamp) && *stamp < end) {
        stamp = stampAfter(buffer, child, {std::max(stamp->ns, begin.ns) + (edge.size() > 1 ? least_gap : 0)},
                           std::max(info->last, end));
      }
    }
    if (edge.empty()) {
      return std::unexpected(Status{
          StatusLevel::Info, "NotDeskewed",
          "'" + info->parent + "' <- '" + info->child + "' has no sample at or before " + scenegraph::timeText(begin)});
    }
    motion.edges_.push_back(std::move(edge));
    child = parent;
  }
  return motion;
}

tf::RigidTransform SensorMotion::interpolate(const Edge& edge, tf::TimePoint time) {
  const auto after = std::ranges::upper_bound(edge, time, {}, &Knot::stamp);
  if (after == edge.begin()) {
    return edge.front().parent_from_child;
  }
  const Knot& a = *(after - 1);
  if (after == edge.end() || isSame(a.parent_from_child, after->parent_from_child)) {
    return a.parent_from_child;
  }
  const double share = tf::secondsBetween(a.stamp, time) / tf::secondsBetween(a.stamp, after->stamp);
  return {
      .rotation = glm::normalize(glm::slerp(a.parent_from_child.rotation, after->parent_from_child.rotation, share)),
      .translation = glm::mix(a.parent_from_child.translation, after->parent_from_child.translation, share)};
}

tf::RigidTransform SensorMotion::at(tf::TimePoint time) const {
  tf::RigidTransform above_from_sensor;
  for (const Edge& edge : edges_) {
    above_from_sensor = interpolate(edge, time) * above_from_sensor;
  }
  return above_from_sensor;
}

bool SensorMotion::isStill() const {
  return std::ranges::all_of(edges_, [](const Edge& edge) {
    return std::ranges::all_of(
        edge, [&](const Knot& knot) { return isSame(knot.parent_from_child, edge.front().parent_from_child); });
  });
}

bool operator==(const SensorMotion& a, const SensorMotion& b) {
  return std::ranges::equal(a.edges_, b.edges_, [](const SensorMotion::Edge& x, const SensorMotion::Edge& y) {
    return std::ranges::equal(x, y, [](const SensorMotion::Knot& p, const SensorMotion::Knot& q) {
      return p.stamp == q.stamp && isSame(p.parent_from_child, q.parent_from_child);
    });
  });
}

std::string inertialFrame(const tf::TransformBuffer& buffer, std::string_view sensor) {
  std::string name(tf::stripLeadingSlashes(sensor));
  auto frame = buffer.findFrame(sensor);
  while (frame && name != "odom") {
    const tf::FrameId parent = buffer.parent(*frame);
    if (parent == tf::kNoFrame) {
      break;
    }
    frame = parent;
    name = buffer.frameName(parent);
  }
  return name;
}

scenegraph::PointCloud deskew(const scenegraph::PointCloud& cloud, const SensorMotion& motion,
                              tf::TimePoint first_beam) {
  const auto field = std::ranges::find(cloud.fields, "t", &scenegraph::PackedField::name);
  auto bytes = std::make_shared<std::vector<std::byte>>(cloud.data.bytes.begin(), cloud.data.bytes.end());
  const tf::RigidTransform reference_from_inertial = tf::inverse(motion.at(first_beam));
  const tf::RigidTransform points_from_frame = tf::inverse(cloud.pose);
  double held_s = -1.0;  // the time that `moved` is for
  tf::RigidTransform moved;
  for (std::size_t i = 0; i < cloud.width && field != cloud.fields.end(); ++i) {
    std::byte* const at = bytes->data() + i * cloud.point_step;
    double after_first_s = 0.0;
    std::memcpy(&after_first_s, at + field->offset, sizeof after_first_s);
    if (i == 0 || after_first_s != held_s) {
      held_s = after_first_s;
      const tf::TimePoint time{first_beam.ns + std::llround(after_first_s * 1e9)};
      moved = points_from_frame * reference_from_inertial * motion.at(time) * cloud.pose;
    }
    float xyz[3];
    std::memcpy(xyz, at, sizeof xyz);
    const glm::dvec3 point = tf::transformPoint(moved, {xyz[0], xyz[1], xyz[2]});
    for (int axis = 0; axis < 3; ++axis) {
      xyz[axis] = static_cast<float>(point[axis]);
    }
    std::memcpy(at, xyz, sizeof xyz);
  }
  scenegraph::PointCloud result = cloud;
  result.data = {*bytes, bytes};
  return result;
}

}  // namespace stillframe::nodes
