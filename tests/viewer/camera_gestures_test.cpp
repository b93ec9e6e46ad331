#include "viewer/widget/camera_gestures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <numbers>

#include "scenegraph/camera/picking.h"

namespace stillframe::viewer {
namespace {

using scenegraph::ViewCamera;

constexpr QSizeF kSize(800.0, 600.0);

/// Where `point` in the fixed frame appears, in widget pixels.
QPointF onScreen(const ViewCamera& camera, const glm::dvec3& point) {
  const auto at = scenegraph::toScreen(camera.view(0.0), {kSize.width(), kSize.height()}, point);
  return at ? QPointF(at->position_px.x, at->position_px.y) : QPointF();
}

/// The point under `position` at the focal depth.
glm::dvec3 underCursor(const ViewCamera& camera, QPointF position) {
  const auto state = camera.sight();
  const double metres_per_px = 2.0 * state.radius_m * std::tan(state.vertical_fov_rad / 2.0) / kSize.height();
  const glm::dmat4 fixed_from_eye = glm::inverse(camera.view(0.0).eye_from_fixed);
  return glm::dvec3(fixed_from_eye * glm::dvec4((position.x() - kSize.width() / 2.0) * metres_per_px,
                                                (kSize.height() / 2.0 - position.y()) * metres_per_px, -state.radius_m,
                                                1.0));
}

bool drag(ViewCamera& camera, Qt::MouseButton button, Qt::KeyboardModifiers modifiers, QPointF from, QPointF to) {
  CameraGestures gestures;
  gestures.press(button, modifiers, from);
  const bool has_moved = gestures.move(to, kSize, camera, 0.0);
  gestures.release(button);
  return has_moved;
}

TEST(CameraGestures, LeftDragTurnsRoundTheFixedFocalPoint) {
  ViewCamera camera;
  const auto before = camera.sight();
  EXPECT_TRUE(drag(camera, Qt::LeftButton, {}, {100, 100}, {250, 100}));
  EXPECT_EQ(camera.sight().focal_point, before.focal_point);
  EXPECT_EQ(camera.sight().radius_m, before.radius_m);
  EXPECT_NEAR(std::abs(std::remainder(camera.sight().yaw_rad - before.yaw_rad, 2.0 * std::numbers::pi)),
              std::numbers::pi * 150.0 / 600.0, 1e-9);
}

TEST(CameraGestures, MiddleAndShiftLeftKeepThePointUnderTheCursor) {
  for (const auto& [button, modifiers] : {std::pair(Qt::MiddleButton, Qt::KeyboardModifiers(Qt::NoModifier)),
                                          std::pair(Qt::LeftButton, Qt::KeyboardModifiers(Qt::ShiftModifier))}) {
    ViewCamera camera;
    const glm::dvec3 grabbed = underCursor(camera, {300, 200});
    drag(camera, button, modifiers, {300, 200}, {420, 330});
    EXPECT_NEAR(onScreen(camera, grabbed).x(), 420.0, 1e-6);
    EXPECT_NEAR(onScreen(camera, grabbed).y(), 330.0, 1e-6);
  }
}

TEST(CameraGestures, WheelShrinksTheRadiusWithTheTargetFixed) {
  ViewCamera camera;
  const auto before = camera.sight();
  CameraGestures::wheel(1.0, Qt::NoModifier, {10, 10}, kSize, camera, 0.0);
  EXPECT_EQ(camera.sight().focal_point, before.focal_point);
  EXPECT_NEAR(camera.sight().radius_m, before.radius_m * 0.9, 1e-12);
}

TEST(CameraGestures, WheelWithControlKeepsThePointUnderTheCursor) {
  for (const double steps : {1.0, -2.0, 5.5}) {
    ViewCamera camera;
    const glm::dvec3 aimed_at = underCursor(camera, {650, 120});
    CameraGestures::wheel(steps, Qt::ControlModifier, {650, 120}, kSize, camera, 0.0);
    EXPECT_NEAR(onScreen(camera, aimed_at).x(), 650.0, 1e-6);
    EXPECT_NEAR(onScreen(camera, aimed_at).y(), 120.0, 1e-6);
  }
}

TEST(CameraGestures, RightDragMovesAlongTheAxisOnly) {
  ViewCamera camera;
  const auto before = camera.sight();
  EXPECT_TRUE(drag(camera, Qt::RightButton, {}, {100, 100}, {100, 180}));
  EXPECT_NE(camera.sight().radius_m, before.radius_m);
  EXPECT_EQ(camera.sight().yaw_rad, before.yaw_rad);
  EXPECT_EQ(camera.sight().focal_point, before.focal_point);
}

TEST(CameraGestures, SecondButtonDoesNotDisturbADrag) {
  ViewCamera camera;
  const auto before = camera.sight();
  CameraGestures gestures;
  gestures.press(Qt::LeftButton, {}, {0, 0});
  gestures.press(Qt::RightButton, {}, {0, 0});
  gestures.release(Qt::RightButton);
  EXPECT_TRUE(gestures.isDragging());
  EXPECT_TRUE(gestures.move({50, 0}, kSize, camera, 0.0));
  EXPECT_EQ(camera.sight().radius_m, before.radius_m);
}

TEST(CameraGestures, CollapsedWidgetMovesNothing) {
  ViewCamera camera;
  const auto before = camera.sight();
  CameraGestures gestures;
  gestures.press(Qt::MiddleButton, {}, {0, 0});
  EXPECT_FALSE(gestures.move({50, 50}, QSizeF(0, 0), camera, 0.0));
  CameraGestures::wheel(std::numeric_limits<double>::quiet_NaN(), Qt::ControlModifier, {}, QSizeF(0, 0), camera, 0.0);
  EXPECT_EQ(camera.sight(), before);
}

TEST(CameraGestures, NonsenseFromADriverMovesNothing) {
  for (const scenegraph::CameraKind kind : scenegraph::kCameraKinds) {
    ViewCamera camera;
    camera.setKind(kind, 0.0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CameraGestures gestures;
    gestures.press(Qt::LeftButton, {}, {nan, 0});
    EXPECT_FALSE(gestures.isDragging());
    gestures.press(Qt::LeftButton, {}, {10, 10});
    EXPECT_FALSE(gestures.move({nan, 50}, kSize, camera, 0.0));
    CameraGestures::wheel(nan, {}, {1, 1}, kSize, camera, 0.0);
    CameraGestures::wheel(1.0, Qt::ControlModifier, {nan, 1}, QSizeF(0, 0), camera, 0.0);
    EXPECT_EQ(camera.rig().kind(), kind);
    EXPECT_TRUE(scenegraph::isFinite(camera.sight()));
    gestures.move({11, 10}, kSize, camera, 0.0);
    EXPECT_TRUE(scenegraph::isFinite(camera.sight())) << "and the drag goes on";
  }
}

TEST(CameraGestures, ShiftWheelSetsThePaceOfFlyingOnly) {
  ViewCamera camera;
  camera.setKind(scenegraph::CameraKind::Fly, 0.0);
  const auto before = camera.rig().fly().state();
  CameraGestures::wheel(1.0, Qt::ShiftModifier, {10, 10}, kSize, camera, 0.0);
  EXPECT_EQ(camera.rig().fly().state().eye, before.eye);
  EXPECT_GT(camera.rig().fly().state().reach_m, before.reach_m);
}

}  // namespace
}  // namespace stillframe::viewer
