#include "viewer/orbit_gestures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <numbers>

#include "scenegraph/camera/picking.h"

namespace stillframe::viewer {
namespace {

using scenegraph::OrbitCamera;

constexpr QSizeF kSize(800.0, 600.0);

/// Where `point` in the fixed frame appears, in widget pixels.
QPointF onScreen(const OrbitCamera& camera, const glm::dvec3& point) {
  const auto at = scenegraph::toScreen(camera.view(), {kSize.width(), kSize.height()}, point);
  return at ? QPointF(at->position_px.x, at->position_px.y) : QPointF();
}

/// The point under `position` at the focal depth.
glm::dvec3 underCursor(const OrbitCamera& camera, QPointF position) {
  const auto state = camera.state();
  const double metres_per_px = 2.0 * state.radius_m * std::tan(state.vertical_fov_rad / 2.0) / kSize.height();
  const glm::dmat4 fixed_from_eye = glm::inverse(camera.view().eye_from_fixed);
  return glm::dvec3(fixed_from_eye * glm::dvec4((position.x() - kSize.width() / 2.0) * metres_per_px,
                                                (kSize.height() / 2.0 - position.y()) * metres_per_px, -state.radius_m,
                                                1.0));
}

bool drag(OrbitCamera& camera, Qt::MouseButton button, Qt::KeyboardModifiers modifiers, QPointF from, QPointF to) {
  OrbitGestures gestures;
  gestures.press(button, modifiers, from);
  const bool has_moved = gestures.move(to, kSize, camera);
  gestures.release(button);
  return has_moved;
}

TEST(OrbitGestures, LeftDragTurnsRoundTheFixedFocalPoint) {
  OrbitCamera camera;
  const auto before = camera.state();
  EXPECT_TRUE(drag(camera, Qt::LeftButton, {}, {100, 100}, {250, 100}));
  EXPECT_EQ(camera.state().focal_point, before.focal_point);
  EXPECT_EQ(camera.state().radius_m, before.radius_m);
  EXPECT_NEAR(std::abs(std::remainder(camera.state().yaw_rad - before.yaw_rad, 2.0 * std::numbers::pi)),
              std::numbers::pi * 150.0 / 600.0, 1e-9);
}

TEST(OrbitGestures, MiddleAndShiftLeftKeepThePointUnderTheCursor) {
  for (const auto& [button, modifiers] : {std::pair(Qt::MiddleButton, Qt::KeyboardModifiers(Qt::NoModifier)),
                                          std::pair(Qt::LeftButton, Qt::KeyboardModifiers(Qt::ShiftModifier))}) {
    OrbitCamera camera;
    const glm::dvec3 grabbed = underCursor(camera, {300, 200});
    drag(camera, button, modifiers, {300, 200}, {420, 330});
    EXPECT_NEAR(onScreen(camera, grabbed).x(), 420.0, 1e-6);
    EXPECT_NEAR(onScreen(camera, grabbed).y(), 330.0, 1e-6);
  }
}

TEST(OrbitGestures, WheelShrinksTheRadiusWithTheTargetFixed) {
  OrbitCamera camera;
  const auto before = camera.state();
  OrbitGestures::wheel(1.0, false, {10, 10}, kSize, camera);
  EXPECT_EQ(camera.state().focal_point, before.focal_point);
  EXPECT_NEAR(camera.state().radius_m, before.radius_m * 0.9, 1e-12);
}

TEST(OrbitGestures, WheelWithControlKeepsThePointUnderTheCursor) {
  for (const double steps : {1.0, -2.0, 5.5}) {
    OrbitCamera camera;
    const glm::dvec3 aimed_at = underCursor(camera, {650, 120});
    OrbitGestures::wheel(steps, true, {650, 120}, kSize, camera);
    EXPECT_NEAR(onScreen(camera, aimed_at).x(), 650.0, 1e-6);
    EXPECT_NEAR(onScreen(camera, aimed_at).y(), 120.0, 1e-6);
  }
}

TEST(OrbitGestures, RightDragMovesAlongTheAxisOnly) {
  OrbitCamera camera;
  const auto before = camera.state();
  EXPECT_TRUE(drag(camera, Qt::RightButton, {}, {100, 100}, {100, 180}));
  EXPECT_NE(camera.state().radius_m, before.radius_m);
  EXPECT_EQ(camera.state().yaw_rad, before.yaw_rad);
  EXPECT_EQ(camera.state().focal_point, before.focal_point);
}

TEST(OrbitGestures, SecondButtonDoesNotDisturbADrag) {
  OrbitCamera camera;
  const auto before = camera.state();
  OrbitGestures gestures;
  gestures.press(Qt::LeftButton, {}, {0, 0});
  gestures.press(Qt::RightButton, {}, {0, 0});
  gestures.release(Qt::RightButton);
  EXPECT_TRUE(gestures.isDragging());
  EXPECT_TRUE(gestures.move({50, 0}, kSize, camera));
  EXPECT_EQ(camera.state().radius_m, before.radius_m);
}

TEST(OrbitGestures, CollapsedWidgetMovesNothing) {
  OrbitCamera camera;
  const auto before = camera.state();
  OrbitGestures gestures;
  gestures.press(Qt::MiddleButton, {}, {0, 0});
  EXPECT_FALSE(gestures.move({50, 50}, QSizeF(0, 0), camera));
  OrbitGestures::wheel(std::numeric_limits<double>::quiet_NaN(), true, {}, QSizeF(0, 0), camera);
  EXPECT_EQ(camera.state(), before);
}

}  // namespace
}  // namespace stillframe::viewer
