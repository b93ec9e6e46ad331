#include <cmath>
#include <cstdio>

#include "tools/sample/marker_messages.h"
#include "tools/sample/sign_markers.h"
#include "tools/sample/topic.h"

namespace stillframe::sample {
namespace {

/// What the robot makes of its surroundings, four times a second: the vehicle's box and name, where the robot is going,
/// and a trail of crumbs that fade away after three seconds. With the first message comes what stands about for good.
class Markers final : public Topic {
 public:
  explicit Markers(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/markers"; }
  Ros2Type type() const override { return markerArrayType(); }
  std::int64_t periodNs() const override { return kPeriod_ns; }

  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    const auto in = [&](const char* frame, const char* ns, std::int32_t id, Marker::Type type) {
      Marker marker;
      marker.stamp_ns = stage_.start_ns + elapsed_ns;
      marker.frame_id = frame;
      marker.ns = ns;
      marker.id = id;
      marker.type = type;
      return marker;
    };
    const double seconds = static_cast<double>(elapsed_ns) * 1e-9;
    const Solid vehicle = World::vehicle(seconds);

    Marker box = in("map", "vehicle", 0, Marker::Type::Cube);
    box.pose = toRigid({vehicle.centre.x, vehicle.centre.y, vehicle.yaw_rad});
    box.pose.translation.z = vehicle.centre.z;
    box.scale = 2.0 * vehicle.half + glm::dvec3(0.1);
    box.rgba = {1.0F, 0.6F, 0.1F, 0.5F};

    Marker name = in("map", "vehicle_name", 0, Marker::Type::Text);
    name.pose.translation = {vehicle.centre.x, vehicle.centre.y, vehicle.centre.z + vehicle.half.z + 0.6};
    name.scale = {0.0, 0.0, 0.5};
    std::array<char, 40> text{};
    (void)std::snprintf(text.data(), text.size(), "vehicle\n%.1f s", seconds);
    name.text = text.data();

    Marker heading = in("base_link", "heading", 0, Marker::Type::Arrow);
    heading.pose.translation.z = 1.2;
    heading.scale = {0.9, 0.12, 0.12};
    heading.rgba = {0.2F, 0.9F, 0.4F, 1.0F};

    Marker ahead = in("map", "ahead", 0, Marker::Type::LineStrip);
    ahead.scale = {0.06, 0.0, 0.0};
    ahead.rgba = {0.3F, 0.7F, 1.0F, 1.0F};
    for (int i = 0; i <= 20; ++i) {
      const Pose2 pose = stage_.robot.truth(elapsed_ns + i * 100'000'000LL);
      ahead.points.emplace_back(pose.x, pose.y, 0.05);
    }

    const Pose2 here = stage_.robot.truth(elapsed_ns);
    Marker crumb = in("map", "trail", static_cast<std::int32_t>(elapsed_ns / kPeriod_ns), Marker::Type::Sphere);
    crumb.pose.translation = {here.x, here.y, 0.1};
    crumb.scale = glm::dvec3(0.2);
    crumb.rgba = {0.9F, 0.3F, 0.6F, 1.0F};
    crumb.lifetime_ns = 3'000'000'000;
    std::vector<Marker> markers{box, name, heading, ahead, crumb};
    if (elapsed_ns == 0) {  // what stays is said once
      for (Marker& sign : makeSigns()) {
        sign.stamp_ns = stage_.start_ns;
        markers.push_back(std::move(sign));
      }
    }
    return serializeMarkerArray(markers);
  }

 private:
  static constexpr std::int64_t kPeriod_ns = 250'000'000;

  Stage stage_;
};

}  // namespace

std::unique_ptr<Topic> makeMarkers(const Stage& stage) { return std::make_unique<Markers>(stage); }

}  // namespace stillframe::sample
