#include "nodes/markers/entity_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace stillframe::nodes {
namespace {

using scenegraph::SceneEntity;
using tf::RigidTransform;

/// Where an instance puts a point of its mesh, in the frame.
glm::dvec3 placed(const ShapeRun& run, std::size_t index, const glm::dvec3& point) {
  const auto& m = run.instances[index].local_from_mesh;
  const auto row = [&](std::size_t r) { return m[r] * point.x + m[r + 1] * point.y + m[r + 2] * point.z + m[r + 3]; };
  return run.key.origin() + glm::dvec3(row(0), row(4), row(8));
}

void expectAt(const glm::dvec3& actual, const glm::dvec3& expected, double tolerance = 1e-5) {
  EXPECT_NEAR(actual.x, expected.x, tolerance);
  EXPECT_NEAR(actual.y, expected.y, tolerance);
  EXPECT_NEAR(actual.z, expected.z, tolerance);
}

TEST(EntityShapes, BuildsAnArrowOfAShaftAndACone) {
  SceneEntity entity;
  entity.arrows.push_back({.pose = {.translation = {1, 2, 3}},
                           .shaft_length = 4,
                           .shaft_diameter = 0.5,
                           .head_length = 2,
                           .head_diameter = 1,
                           .color = {},
                           .height_ratio = 3});
  const EntityShapes shapes = shapesOf(entity);
  ASSERT_EQ(shapes.runs.size(), 1U);
  const ShapeRun& run = shapes.runs[0];
  EXPECT_EQ(run.key.kind, ShapeKind::Frustum);
  ASSERT_EQ(run.instances.size(), 2U);
  expectAt(placed(run, 0, {0, 0, -0.5}), {1, 2, 3});
  expectAt(placed(run, 0, {0, 0, 0.5}), {5, 2, 3});
  expectAt(placed(run, 0, {0.5, 0, -0.5}), {1, 2.25, 3});
  expectAt(placed(run, 0, {0, 0.5, -0.5}), {1, 2, 3.75});
  expectAt(placed(run, 1, {0.5, 0, -0.5}), {5, 2.5, 3});
  expectAt(placed(run, 1, {0, 0, 0.5}), {7, 2, 3});
  EXPECT_EQ(run.instances[0].taper, 1.0F);
  EXPECT_EQ(run.instances[1].taper, 0.0F);
}

TEST(EntityShapes, TapersCylindersTowardsTheSmallerEnd) {
  SceneEntity entity;
  for (const auto& [bottom, top] : {std::pair{1.0, 1.0}, {2.0, 1.0}, {0.0, 3.0}}) {
    entity.cylinders.push_back({.pose = {}, .size = {1, 2, 5}, .bottom_scale = bottom, .top_scale = top, .color = {}});
  }
  const EntityShapes shapes = shapesOf(entity);
  ASSERT_EQ(shapes.runs.size(), 1U);
  const auto& instances = shapes.runs[0].instances;
  ASSERT_EQ(instances.size(), 3U);
  EXPECT_EQ(instances[0].taper, 1.0F);
  EXPECT_EQ(instances[1].taper, 0.5F);
  EXPECT_EQ(instances[1].local_from_mesh[0], 2.0F);
  EXPECT_EQ(instances[2].taper, 2.0F) << "nothing is left of the lower end";
  EXPECT_EQ(instances[2].local_from_mesh[5], 6.0F);
}

TEST(EntityShapes, SetsAxesOfThreeColoursAtRightAngles) {
  SceneEntity entity;
  entity.axes.push_back({.pose = {}, .length = 2, .thickness = 0.1});
  const EntityShapes shapes = shapesOf(entity);
  ASSERT_EQ(shapes.runs[0].instances.size(), 3U);
  expectAt(placed(shapes.runs[0], 0, {0, 0, 0.5}), {2, 0, 0});
  expectAt(placed(shapes.runs[0], 1, {0, 0, 0.5}), {0, 2, 0});
  expectAt(placed(shapes.runs[0], 2, {0, 0, 0.5}), {0, 0, 2});
}

TEST(EntityShapes, IsWithinATenthOfAMillimetreAnywhereOnEarth) {
  for (const double x : {0.0, 2047.9, 2048.1, 123'456.789, 6.378e6, -4.2e7}) {
    SceneEntity entity;
    entity.cubes.push_back({.pose = {.translation = {x, -x, 0.5 * x}}, .size = {1, 1, 1}, .color = {}});
    const EntityShapes shapes = shapesOf(entity);
    expectAt(placed(shapes.runs[0], 0, {0, 0, 0}), {x, -x, 0.5 * x}, 1.3e-4);
  }
}

TEST(EntityShapes, TakesAllZeroForNoRotationAndNormalisesAnyOther) {
  EXPECT_EQ(soundPose({.rotation = {0, 0, 0, 0}, .translation = {}}).rotation, glm::dquat(1, 0, 0, 0));
  EXPECT_NEAR(soundPose({.rotation = {0, 0, 0, 1e-200}, .translation = {}}).rotation.z, 1.0, 1e-15);
  EXPECT_NEAR(soundPose({.rotation = {1e300, 0, 0, 1e300}, .translation = {}}).rotation.z, std::sqrt(0.5), 1e-15);
}

TEST(EntityShapes, LeavesOutWhatHasNoPlaceOrColour) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SceneEntity entity;
  const auto add = [&](const glm::dvec3& at, const glm::dvec3& size, float alpha) {
    entity.spheres.push_back({.pose = {.translation = at}, .size = size, .color = {1, 1, 1, alpha}});
  };
  add({nan, 0, 0}, {1, 1, 1}, 1);
  add({0, 0, 1e15}, {1, 1, 1}, 1);
  add({0, 0, 0}, {1, HUGE_VAL, 1}, 1);
  add({0, 0, 0}, {1, 1, 1}, 0);
  add({0, 0, 0}, {1, 1, 0}, 1);
  add({0, 0, 0}, {-1, 1, 1}, 1);
  entity.spheres.push_back({.pose = {.rotation = {nan, 0, 0, 0}, .translation = {}}, .size = {1, 1, 1}, .color = {}});
  const EntityShapes shapes = shapesOf(entity);
  EXPECT_EQ(shapes.unsound, 4U);
  EXPECT_EQ(shapes.invisible, 1U);
  EXPECT_EQ(shapes.flat, 1U);
  ASSERT_EQ(shapes.runs.size(), 1U);
  EXPECT_EQ(shapes.runs[0].instances.size(), 2U);
}

TEST(EntityShapes, OpensNoMoreThanAFewBatchesForOneEntity) {
  SceneEntity entity;
  entity.points.push_back({.pose = {}, .width_m = 1, .height_m = 1, .points = {}, .color = {}, .colors = {}});
  for (int i = 0; i < 1000; ++i) {
    entity.points[0].points.emplace_back(1e5 * i, 0, 0);
  }
  const EntityShapes shapes = shapesOf(entity);
  EXPECT_LE(shapes.runs.size(), 65U);
  std::size_t count = 0;
  for (const ShapeRun& run : shapes.runs) {
    count += run.instances.size();
  }
  EXPECT_EQ(count, 1000U);
  EXPECT_EQ(shapesOf(entity, false).runs.size(), 1U);
}

}  // namespace
}  // namespace stillframe::nodes
