#include "tools/bench/point_scene.h"

#include <array>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tools/bench/memory_messages.h"

namespace stillframe::bench {
namespace {

constexpr std::uint32_t kStep = 16;  // bytes a point
constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kStepAngle = std::numbers::pi / 360.0;

/// Uniform over 0..1, the same on every machine.
class Uniform {
 public:
  explicit Uniform(std::uint32_t seed) : random_(seed) {}
  double operator()() { return static_cast<double>(random_()) * 0x1p-32; }

 private:
  std::mt19937 random_;
};

/// What a beam of that direction meets: a wall or a pole at some azimuths, else hills.
std::array<float, 4> pointOf(double azimuth, double elevation, Uniform& uniform) {
  const double sector = std::floor(azimuth / kTurn * 40.0);
  const bool is_wall = static_cast<int>(sector) % 3 == 0;
  const double rough = 0.02 * uniform();
  const double ground = 2.0 / std::tan(elevation) * (1.0 + 0.2 * std::sin(7.0 * azimuth));
  const double distance = (is_wall ? std::min(6.0 + sector, ground) : ground) + rough;
  const double height = is_wall && distance < ground ? 4.0 * uniform() - 2.0 : -2.0 + 0.5 * std::sin(0.2 * distance);
  return {static_cast<float>(distance * std::cos(azimuth)), static_cast<float>(distance * std::sin(azimuth)),
          static_cast<float>(height), static_cast<float>(100.0 * uniform())};
}

}  // namespace

scenegraph::PointCloud makePointCloud(std::size_t points, bool is_shuffled, std::uint32_t seed) {
  Uniform uniform(seed);
  std::vector<std::uint32_t> order(points);
  std::iota(order.begin(), order.end(), 0U);
  if (is_shuffled) {
    for (std::size_t i = points; i > 1; --i) {
      std::swap(order[i - 1], order[static_cast<std::size_t>(uniform() * static_cast<double>(i))]);
    }
  }
  constexpr std::size_t kBeams = 128;
  auto bytes = std::make_shared<std::vector<std::byte>>(points * kStep);
  for (std::size_t i = 0; i < points; ++i) {
    const std::size_t column = i / kBeams;
    const double azimuth = kTurn * static_cast<double>(column * kBeams) / static_cast<double>(points);
    const double elevation = 0.03 + 0.8 * static_cast<double>(i % kBeams) / kBeams;
    const std::array<float, 4> point = pointOf(azimuth, elevation, uniform);
    std::memcpy(bytes->data() + std::size_t{order[i]} * kStep, point.data(), sizeof point);
  }
  using scenegraph::FieldType;
  scenegraph::PointCloud cloud;
  cloud.frame_id = "map";
  cloud.width = static_cast<std::uint32_t>(points);
  cloud.point_step = kStep;
  cloud.row_step = cloud.width * kStep;
  cloud.fields = {{"x", 0, FieldType::Float32},
                  {"y", 4, FieldType::Float32},
                  {"z", 8, FieldType::Float32},
                  {"intensity", 12, FieldType::Float32}};
  cloud.data = {*bytes, bytes};
  return cloud;
}

std::shared_ptr<scenegraph::Dataset> makePointDataset(const PointSceneShape& shape) {
  auto dataset = std::make_shared<scenegraph::Dataset>("points");
  const auto layers = static_cast<std::size_t>(shape.layers);
  for (std::size_t layer = 0; layer < layers; ++layer) {
    std::vector<scenegraph::AnyObject> messages;
    for (int message = 0; message < shape.messages; ++message) {
      const auto seed = static_cast<std::uint32_t>(layer * 1000 + static_cast<std::size_t>(message));
      messages.push_back(scenegraph::AnyObject::make(makePointCloud(shape.points / layers, shape.is_shuffled, seed)));
    }
    addTopic(*dataset, "/points" + std::to_string(layer), scenegraph::ObjectType::PointCloud, std::move(messages),
             1'000'000'000);
  }
  return dataset;
}

scenegraph::CameraView viewOfPoints(int step) {
  const double angle = kStepAngle * step;
  return {.eye_from_fixed = scenegraph::lookAt({0, 0, 0}, {std::cos(angle), std::sin(angle), -0.2}, {0, 0, 1})};
}

namespace {

scenegraph::CameraView viewFrom(double times_as_far, int step) {
  const double angle = kStepAngle * step;
  const double reach_m = 110.0 * times_as_far;
  return {.eye_from_fixed = scenegraph::lookAt(
              {reach_m * std::cos(angle), reach_m * std::sin(angle), 90.0 * times_as_far}, {0, 0, -5}, {0, 0, 1})};
}

}  // namespace

scenegraph::CameraView viewOfAllPoints(int step) { return viewFrom(1.0, step); }

scenegraph::CameraView viewFromAfar(int step) { return viewFrom(10.0, step); }

}  // namespace stillframe::bench
