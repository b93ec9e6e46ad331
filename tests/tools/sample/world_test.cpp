#include "tools/sample/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tools/sample/random.h"

namespace stillframe::sample {
namespace {

TEST(RayCaster, MeetsTheFloorBelow) {
  const World world(1);
  const RayCaster caster(world, 0.0, {-11.0, 3.0, 2.0});
  const auto hit = caster.cast({0.0, 0.0, -1.0}, 100.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range_m, 2.0, 1e-12);
  EXPECT_EQ(hit->material, Material::Floor);
}

TEST(RayCaster, MeetsTheWallAboveTheRacks) {
  const World world(1);
  const RayCaster caster(world, 0.0, {0.0, 0.0, 6.0});
  const auto hit = caster.cast({0.0, 1.0, 0.0}, 100.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range_m, 10.0, 1e-12);
  EXPECT_EQ(hit->material, Material::Wall);
  EXPECT_EQ(hit->normal_in_map, glm::dvec3(0.0, -1.0, 0.0));
}

TEST(RayCaster, MeetsTheRoundOfAPillar) {
  const World world(1);
  const RayCaster caster(world, 0.0, {-11.0, 0.1, 5.0});
  const auto hit = caster.cast({1.0, 0.0, 0.0}, 100.0);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->material, Material::Concrete);
  EXPECT_NEAR(hit->range_m, 2.0 - std::sqrt(0.09 - 0.01), 1e-12);
}

TEST(RayCaster, MeetsTheSlopeOfTheRamp) {
  const World world(1);
  const RayCaster caster(world, 0.0, {10.5, 8.4, 3.0});
  const auto hit = caster.cast({0.0, 0.0, -1.0}, 100.0);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->material, Material::Ramp);
  EXPECT_NEAR(hit->range_m, 2.5, 1e-12);  // half way up a ramp of 1 m
  EXPECT_LT(hit->normal_in_map.x, 0.0);
}

TEST(RayCaster, SeesNothingBeyondItsRange) {
  const World world(1);
  const RayCaster caster(world, 0.0, {0.0, 0.0, 6.0});
  EXPECT_FALSE(caster.cast({0.0, 1.0, 0.0}, 9.99));
}

TEST(RayCaster, SeesTheVehicleWhereItIs) {
  const World world(1);
  const auto below = [&](double seconds, double x) {
    return RayCaster(world, seconds, {x, 0.0, 3.0}).cast({0.0, 0.0, -1.0}, 100.0)->material;
  };
  const double later = World::vehicle(5.0).centre.x;
  ASSERT_GT(later, 2.0);
  EXPECT_EQ(below(0.0, 0.0), Material::Vehicle);
  EXPECT_EQ(below(0.0, later), Material::Floor);
  EXPECT_EQ(below(5.0, later), Material::Vehicle);
}

// The sectors leave out only what cannot be met. The world is closed, so a ray that met nothing would have passed a
// wall.
TEST(RayCaster, LosesNothingBetweenItsSectors) {
  const World world(3);
  Random random(5);
  for (int place = 0; place < 20; ++place) {
    const RayCaster caster(world, 0.0, {random.uniform(-8.0, 8.0), random.uniform(5.0, 7.0), 1.0});
    for (int i = 0; i < 5'000; ++i) {
      const double azimuth = random.uniform(-std::numbers::pi, std::numbers::pi);
      const auto hit = caster.cast({std::cos(azimuth), std::sin(azimuth), 0.0}, 100.0);
      ASSERT_TRUE(hit) << azimuth;
      ASSERT_LT(hit->range_m, 36.0);
    }
  }
}

}  // namespace
}  // namespace stillframe::sample
