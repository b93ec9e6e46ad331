#include "tools/sample/world.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "tools/sample/random.h"

namespace stillframe::sample {
namespace {

constexpr double kHalfLength = World::kHalfLength_m;
constexpr double kHalfWidth = World::kHalfWidth_m;
constexpr double kWallHeight = 7.0;

Solid box(Material material, const glm::dvec3& centre, const glm::dvec3& half, double yaw_rad = 0.0,
          float tint = 1.0F) {
  return {Solid::Shape::Box, material, centre, half, yaw_rad, tint};
}

Solid cylinder(Material material, const glm::dvec2& centre, double radius, double height) {
  return {Solid::Shape::Cylinder, material, {centre, 0.5 * height}, {radius, radius, 0.5 * height}};
}

void addWalls(std::vector<Solid>& solids) {
  const double z = 0.5 * kWallHeight;
  for (const double side : {-1.0, 1.0}) {
    solids.push_back(box(Material::Wall, {side * (kHalfLength + 0.15), 0, z}, {0.15, kHalfWidth + 0.3, z}));
    solids.push_back(box(Material::Wall, {0, side * (kHalfWidth + 0.15), z}, {kHalfLength, 0.15, z}));
  }
}

/// Uprights, boards on four levels, and cartons of random size on the boards.
void addRack(std::vector<Solid>& solids, Random& random, const glm::dvec2& centre, double half_length) {
  constexpr double kHalfDepth = 0.5;
  constexpr std::array kLevels{0.12, 1.2, 2.3, 3.4};
  for (double x = -half_length; x <= half_length + 1e-9; x += 2.0 * half_length / 4.0) {
    for (const double y : {-kHalfDepth, kHalfDepth}) {
      solids.push_back(box(Material::Steel, {centre.x + x, centre.y + y, 2.0}, {0.05, 0.05, 2.0}));
    }
  }
  for (const double level : kLevels) {
    solids.push_back(box(Material::Board, {centre, level}, {half_length, kHalfDepth, 0.03}));
    for (double x = -half_length + 0.45; x < half_length - 0.4; x += random.uniform(0.75, 1.5)) {
      if (random.uniform(0.0, 1.0) < 0.2) {
        continue;  // an empty place
      }
      const glm::dvec3 half{random.uniform(0.2, 0.34), random.uniform(0.2, 0.42), random.uniform(0.15, 0.42)};
      const double z = level + 0.03 + half.z;
      solids.push_back(box(Material::Carton, {centre.x + x, centre.y + random.uniform(-0.06, 0.06), z}, half,
                           random.uniform(-0.08, 0.08), static_cast<float>(random.uniform(0.7, 1.15))));
    }
  }
}

/// A stack of cartons on the floor, each turned a little.
void addStack(std::vector<Solid>& solids, Random& random, const glm::dvec2& centre) {
  double z = 0.0;
  double size = random.uniform(0.4, 0.6);
  const int levels = 1 + static_cast<int>(random.uniform(0.0, 3.0));
  for (int level = 0; level < levels; ++level) {
    const double half_height = random.uniform(0.2, 0.35);
    solids.push_back(box(Material::Carton, {centre, z + half_height}, {size, size * 0.8, half_height},
                         random.uniform(0.0, 3.1), static_cast<float>(random.uniform(0.7, 1.15))));
    z += 2.0 * half_height;
    size *= 0.8;
  }
}

}  // namespace

Appearance appearance(Material material) noexcept {
  switch (material) {
    case Material::Floor:
      return {0.25F, {0.42F, 0.43F, 0.45F}};
    case Material::Wall:
      return {0.70F, {0.82F, 0.80F, 0.74F}};
    case Material::Steel:
      return {0.95F, {0.12F, 0.28F, 0.62F}};
    case Material::Board:
      return {0.55F, {0.90F, 0.45F, 0.10F}};
    case Material::Carton:
      return {0.45F, {0.72F, 0.53F, 0.32F}};
    case Material::Concrete:
      return {0.35F, {0.58F, 0.58F, 0.57F}};
    case Material::Ramp:
      return {0.80F, {0.93F, 0.80F, 0.15F}};
    case Material::Vehicle:
      return {0.98F, {0.80F, 0.12F, 0.10F}};
  }
  return {};
}

World::World(std::uint64_t seed) {
  Random random(seed ^ 0x57A2E40053ULL);
  addWalls(solids_);
  for (const double y : {-2.7, 2.7}) {
    addRack(solids_, random, {0.0, y}, 7.0);
  }
  for (const double y : {-9.4, 9.4}) {
    addRack(solids_, random, {-2.0, y}, 8.0);
  }
  for (const glm::dvec2& centre : {glm::dvec2{-9.0, 0.0}, {9.0, 0.0}, {-13.0, -8.0}, {-13.0, 8.0}, {13.0, -8.0}}) {
    solids_.push_back(cylinder(Material::Concrete, centre, 0.3, kWallHeight));
  }
  // The ramp leads up to a loading dock in the corner.
  solids_.push_back({Solid::Shape::Wedge, Material::Ramp, {10.5, 8.4, 0.5}, {1.7, 1.2, 0.5}, 0.0, 1.0F});
  solids_.push_back(box(Material::Concrete, {13.6, 8.4, 0.5}, {1.4, 1.6, 0.5}));
  // Stacks stand where the loop does not pass: near the short walls, the corners and the middle aisle's ends.
  for (const glm::dvec2& centre : {glm::dvec2{-14.0, -3.5},
                                   {-14.0, 0.6},
                                   {-14.0, 4.2},
                                   {14.0, -4.5},
                                   {14.0, -0.8},
                                   {14.0, 3.0},
                                   {11.0, -9.0},
                                   {8.5, -9.2},
                                   {-11.8, 9.0},
                                   {-11.8, -9.0},
                                   {-7.6, 0.9},
                                   {7.5, -0.9}}) {
    addStack(solids_, random, centre + glm::dvec2{random.uniform(-0.25, 0.25), random.uniform(-0.25, 0.25)});
  }
}

std::optional<double> heightOver(const Solid& solid, double x, double y) {
  const double dx = x - solid.centre.x;
  const double dy = y - solid.centre.y;
  if (dx * dx + dy * dy > solid.half.x * solid.half.x + solid.half.y * solid.half.y) {
    return std::nullopt;  // most solids, without a sine
  }
  const double c = std::cos(solid.yaw_rad);
  const double s = std::sin(solid.yaw_rad);
  const glm::dvec2 local{c * dx + s * dy, c * dy - s * dx};
  const bool is_inside = solid.shape == Solid::Shape::Cylinder
                             ? glm::length(local) <= solid.half.x
                             : std::abs(local.x) <= solid.half.x && std::abs(local.y) <= solid.half.y;
  if (!is_inside) {
    return std::nullopt;
  }
  return solid.centre.z + (solid.shape == Solid::Shape::Wedge ? local.x / solid.half.x : 1.0) * solid.half.z;
}

Top World::topAt(double x, double y) const {
  Top top;
  for (const Solid& solid : solids_) {
    if (const auto height_m = heightOver(solid, x, y); height_m && *height_m > top.height_m) {
      top = {*height_m, solid.material};
    }
  }
  return top;
}

Solid World::vehicle(double seconds) {
  return box(Material::Vehicle, {5.5 * std::sin(0.23 * seconds), 0.0, 0.55}, {0.8, 0.5, 0.5});
}

}  // namespace stillframe::sample
