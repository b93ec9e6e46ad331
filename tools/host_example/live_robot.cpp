#include "live_robot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "scenegraph/objects/frame_transforms.h"
#include "scenegraph/objects/point_cloud.h"

namespace host_example {
namespace {

using namespace stillframe;

constexpr std::int64_t kPeriod_ns = 50'000'000;
constexpr double kRadius_m = 2.5;
constexpr double kTurn_rad_s = 0.5;
constexpr glm::dvec2 kHalfRoom_m{5.0, 4.0};
constexpr int kRays = 720;
constexpr std::array kHeights_m{0.0F, 0.4F, 0.8F};

struct Place {
  glm::dvec2 position;
  double yaw_rad = 0.0;
};

Place placeAt(tf::TimePoint time) {
  const double angle = kTurn_rad_s * static_cast<double>(time.ns) * 1e-9;
  return {{kRadius_m * std::cos(angle), kRadius_m * std::sin(angle)}, angle + std::numbers::pi / 2.0};
}

double rangeAt(const Place& place, double bearing_rad) {
  const glm::dvec2 direction{std::cos(place.yaw_rad + bearing_rad), std::sin(place.yaw_rad + bearing_rad)};
  const auto reach = [&](int axis) {
    const double wall = std::copysign(kHalfRoom_m[axis], direction[axis]);
    return std::abs(direction[axis]) < 1e-9 ? 1e9 : (wall - place.position[axis]) / direction[axis];
  };
  return std::min(reach(0), reach(1));
}

scenegraph::FrameTransforms transformsAt(tf::TimePoint time) {
  const Place place = placeAt(time);
  const auto turned = [](double yaw) { return glm::angleAxis(yaw, glm::dvec3(0.0, 0.0, 1.0)); };
  return {{{time, "map", "odom", {.translation = {0.2, 0.0, 0.0}}},
           {time,
            "odom",
            "base_link",
            {.rotation = turned(place.yaw_rad), .translation = {place.position.x - 0.2, place.position.y, 0.0}}},
           {time, "base_link", "lidar", {.translation = {0.0, 0.0, 0.5}}}}};
}

scenegraph::PointCloud cloudAt(tf::TimePoint time) {
  const Place place = placeAt(time);
  std::vector<std::array<float, 3>> points;
  for (int ray = 0; ray < kRays; ++ray) {
    const double bearing = 2.0 * std::numbers::pi * ray / kRays;
    const double range = rangeAt(place, bearing);
    for (const float height : kHeights_m) {
      points.push_back(
          {static_cast<float>(range * std::cos(bearing)), static_cast<float>(range * std::sin(bearing)), height});
    }
  }
  const auto bytes = std::make_shared<std::vector<std::byte>>(points.size() * sizeof(points[0]));
  std::memcpy(bytes->data(), points.data(), bytes->size());
  scenegraph::PointCloud cloud;
  cloud.stamp = time;
  cloud.frame_id = "lidar";
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.point_step = sizeof(points[0]);
  cloud.row_step = cloud.point_step * cloud.width;
  for (const auto& [name, offset] : {std::pair("x", 0U), std::pair("y", 4U), std::pair("z", 8U)}) {
    cloud.fields.push_back({name, offset, scenegraph::FieldType::Float32, 1});
  }
  cloud.data = {*bytes, bytes};
  return cloud;
}

/// Makes what is asked for, when it is asked for.
class Source : public scenegraph::EntrySource {
 public:
  std::expected<scenegraph::AnyObject, scenegraph::DecodeError> decode(const scenegraph::TopicInfo& topic,
                                                                       const scenegraph::Entry& entry) const override {
    return topic.type == scenegraph::ObjectType::PointCloud ? scenegraph::AnyObject::make(cloudAt(entry.log_time))
                                                            : scenegraph::AnyObject::make(transformsAt(entry.log_time));
  }
};

}  // namespace

LiveRobot::LiveRobot() : dataset_(std::make_shared<scenegraph::Dataset>("live robot")), newest_{-kPeriod_ns} {
  const auto source = std::make_shared<Source>();
  transforms_ = dataset_->store().addTopic({.name = "/tf",
                                            .type = scenegraph::ObjectType::FrameTransforms,
                                            .schema = "host/Transforms",
                                            .encoding = "none",
                                            .unsupported_reason = {}},
                                           source);
  cloud_ = dataset_->store().addTopic({.name = "/lidar/points",
                                       .type = scenegraph::ObjectType::PointCloud,
                                       .schema = "host/Cloud",
                                       .encoding = "none",
                                       .unsupported_reason = {}},
                                      source);
}

void LiveRobot::growTo(tf::TimePoint time) {
  std::vector<scenegraph::Entry> entries;
  while (newest_.ns + kPeriod_ns <= time.ns) {
    newest_.ns += kPeriod_ns;
    entries.push_back({.log_time = newest_, .payload_bytes = 1, .locator = 0, .sequence = 0});
  }
  if (!entries.empty()) {
    dataset_->store().append(transforms_, entries);
    dataset_->store().append(cloud_, entries);
    dataset_->takeTransforms();
  }
}

std::vector<Value> LiveRobot::values() const {
  std::vector<Value> values{{"robot.heading [rad]", [](tf::TimePoint time) { return placeAt(time).yaw_rad; }},
                            {"lidar.nearest [m]", [](tf::TimePoint time) -> std::optional<double> {
                               double nearest = 1e9;
                               for (int ray = 0; ray < kRays; ++ray) {
                                 nearest =
                                     std::min(nearest, rangeAt(placeAt(time), 2.0 * std::numbers::pi * ray / kRays));
                               }
                               return nearest;
                             }}};
  const auto buffer = dataset_->transforms();
  for (const tf::FrameId root : buffer->roots()) {
    const std::string root_name = buffer->frameName(root);
    for (const std::string& frame : buffer->frames()) {
      if (frame == root_name) {
        continue;
      }
      for (const auto& [axis, index] : {std::pair("x", 0), std::pair("y", 1), std::pair("z", 2)}) {
        values.push_back({QString::fromStdString(frame + "." + axis + " in " + root_name + " [m]"),
                          [buffer, root_name, frame, index](tf::TimePoint time) -> std::optional<double> {
                            const auto pose = buffer->tryLookupTransform(root_name, frame, time);
                            return pose ? std::optional(pose->translation[index]) : std::nullopt;
                          }});
      }
    }
  }
  return values;
}

}  // namespace host_example
