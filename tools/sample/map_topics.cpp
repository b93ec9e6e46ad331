#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <span>

#include "tools/sample/map_messages.h"
#include "tools/sample/topic.h"

namespace stillframe::sample {
namespace {

constexpr std::uint32_t kWidth = 312;  // the warehouse and its walls in cells of a decimetre
constexpr std::uint32_t kHeight = 212;
constexpr double kCell_m = 0.1;
constexpr std::int32_t kReach = 40;  // of the sensors, in cells
constexpr double kObstacle_m = 0.15;

/// A rectangle of the map's cells, with what stands there.
struct Patch {
  std::int32_t left = 0;
  std::int32_t bottom = 0;
  std::int32_t right = 0;  ///< behind the last column
  std::int32_t top = 0;
  std::vector<std::int8_t> cells;
};

std::int32_t cellOf(double at_m, std::uint32_t cells) {
  return static_cast<std::int32_t>(std::floor(at_m / kCell_m + 0.5 * cells));
}
double middleOf(std::int32_t cell, std::uint32_t cells) { return (cell + 0.5 - 0.5 * cells) * kCell_m; }

/// Marks the cells that the solid covers.
void paint(const Solid& solid, Patch& patch) {
  const double reach_m = glm::length(glm::dvec2(solid.half)) + kCell_m;
  const std::int32_t left = std::max(cellOf(solid.centre.x - reach_m, kWidth), patch.left);
  const std::int32_t right = std::min(cellOf(solid.centre.x + reach_m, kWidth), patch.right);
  const std::int32_t bottom = std::max(cellOf(solid.centre.y - reach_m, kHeight), patch.bottom);
  const std::int32_t top = std::min(cellOf(solid.centre.y + reach_m, kHeight), patch.top);
  for (std::int32_t y = bottom; y < top; ++y) {
    for (std::int32_t x = left; x < right; ++x) {
      if (heightOver(solid, middleOf(x, kWidth), middleOf(y, kHeight)).value_or(0.0) > kObstacle_m) {
        patch.cells[static_cast<std::size_t>((y - patch.bottom) * (patch.right - patch.left) + x - patch.left)] = 100;
      }
    }
  }
}

/// The floor before the robot starts: nothing of it is known.
class Map final : public Topic {
 public:
  explicit Map(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/map"; }
  Ros2Type type() const override { return occupancyGridType(); }
  std::int64_t periodNs() const override { return 0; }

  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    const std::vector<std::int8_t> cells(std::size_t{kWidth} * kHeight, -1);
    scenegraph::OccupancyGrid grid;
    grid.stamp = {stage_.start_ns + elapsed_ns};
    grid.frame_id = "map";
    grid.resolution_m = kCell_m;
    grid.width = kWidth;
    grid.height = kHeight;
    grid.origin.translation = {-0.5 * kWidth * kCell_m, -0.5 * kHeight * kCell_m, 0.0};
    grid.data.bytes = std::as_bytes(std::span(cells));
    return serializeOccupancyGrid(grid);
  }

 private:
  Stage stage_;
};

/// What the robot finds round itself, twice a second: a square of 8 m, cut off where the map ends.
class MapUpdates final : public Topic {
 public:
  explicit MapUpdates(const Stage& stage) : stage_(stage) {}
  std::string_view name() const override { return "/map_updates"; }
  Ros2Type type() const override { return occupancyGridUpdateType(); }
  std::int64_t periodNs() const override { return 500'000'000; }

  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    const Pose2 pose = stage_.robot.truth(elapsed_ns);
    const std::int32_t column = cellOf(pose.x, kWidth);
    const std::int32_t row = cellOf(pose.y, kHeight);
    Patch found{.left = std::max(column - kReach, 0),
                .bottom = std::max(row - kReach, 0),
                .right = std::min(column + kReach, static_cast<std::int32_t>(kWidth)),
                .top = std::min(row + kReach, static_cast<std::int32_t>(kHeight)),
                .cells = {}};
    for (std::int32_t y = found.bottom; y < found.top; ++y) {
      for (std::int32_t x = found.left; x < found.right; ++x) {
        const bool is_inside = std::abs(middleOf(x, kWidth)) <= World::kHalfLength_m &&
                               std::abs(middleOf(y, kHeight)) <= World::kHalfWidth_m;
        found.cells.push_back(is_inside ? 0 : -1);
      }
    }
    std::ranges::for_each(stage_.world.solids(), [&](const Solid& solid) { paint(solid, found); });
    paint(World::vehicle(static_cast<double>(elapsed_ns) * 1e-9), found);  // it covers what it has not left yet
    scenegraph::OccupancyGridUpdate patch;
    patch.stamp = {stage_.start_ns + elapsed_ns};
    patch.frame_id = "map";
    patch.x = found.left;
    patch.y = found.bottom;
    patch.width = static_cast<std::uint32_t>(found.right - found.left);
    patch.height = static_cast<std::uint32_t>(found.top - found.bottom);
    patch.data.bytes = std::as_bytes(std::span(found.cells));
    return serializeOccupancyGridUpdate(patch);
  }

 private:
  Stage stage_;
};

}  // namespace

std::unique_ptr<Topic> makeMap(const Stage& stage) { return std::make_unique<Map>(stage); }
std::unique_ptr<Topic> makeMapUpdates(const Stage& stage) { return std::make_unique<MapUpdates>(stage); }

}  // namespace stillframe::sample
