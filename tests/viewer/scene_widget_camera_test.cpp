// The camera of the widget: models, follow, keys, saved views, smooth moves.
#include <gtest/gtest.h>

#include <QKeyEvent>
#include <QLabel>
#include <QTest>
#include <QThread>
#include <glm/geometric.hpp>
#include <numbers>
#include <osg/NodeCallback>

#include "tests/viewer/shown_widget.h"
#include "tests/viewer/viewer_support.h"
#include "viewer/widget/help_overlay.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using scenegraph::CameraKind;
using scenegraph::FollowMode;
using test::settle;
using test::waitFor;
using tf::TimePoint;

class WidgetCameraTest : public test::ShownWidgetTest {
 protected:
  glm::dvec2 pixelOf(const std::string& frame) {
    const QPointF at = ShownWidgetTest::pixelOf(frame);
    return {at.x(), at.y()};
  }
};

TEST_F(WidgetCameraTest, DigitsSwitchTheModelAndKeepWhatIsLookedAt) {
  const glm::dvec3 focal = widget_.camera().sight().focal_point;
  for (const auto& [digit, kind] : {std::pair{Qt::Key_3, CameraKind::TopDownOrtho},
                                    std::pair{Qt::Key_4, CameraKind::Fly}, std::pair{Qt::Key_1, CameraKind::Orbit}}) {
    key(digit);
    EXPECT_EQ(widget_.camera().rig().kind(), kind);
    EXPECT_NEAR(glm::length(widget_.camera().sight().focal_point - focal), 0.0, 1e-9);
    settle();
    EXPECT_GT(test::drawnPixels(widget_.grabFramebuffer()), 300);
  }
  key(Qt::Key_2);
  EXPECT_EQ(widget_.camera().rig().kind(), CameraKind::XyOrbit);
  EXPECT_EQ(widget_.camera().sight().focal_point.z, 0.0);
}

TEST_F(WidgetCameraTest, PoseKeepsTheFollowedFrameAtItsPixelWhileItMoves) {
  widget_.setDisplayFrame("base_link");
  const glm::dvec2 before = pixelOf("base_link");
  widget_.setFollow(FollowMode::Pose);
  EXPECT_NEAR(glm::length(pixelOf("base_link") - before), 0.0, 1e-9) << "switching it on moves nothing";
  const glm::dvec2 map_before = pixelOf("map");
  for (const std::int64_t second : {3, 7, 9, 4}) {
    goTo(second * 1_s);
    EXPECT_NEAR(glm::length(pixelOf("base_link") - before), 0.0, 1e-6);
    EXPECT_GT(glm::length(pixelOf("map") - map_before), 1.0);
  }
}

TEST_F(WidgetCameraTest, CameraAndDataAreOfOneTick) {
  widget_.setDisplayFrame("base_link");
  widget_.setFollow(FollowMode::Position);
  const glm::dmat4 before = widget_.shownView().eye_from_fixed;
  widget_.setTime(TimePoint{8_s});
  EXPECT_EQ(widget_.shownView().eye_from_fixed, before) << "a frame drawn now shows the old tick from the old place";
  widget_.applyTick();
  EXPECT_NE(widget_.shownView().eye_from_fixed, before);
  EXPECT_EQ(widget_.scene()->time(), TimePoint{8_s});
}

TEST_F(WidgetCameraTest, OrbitAndZoomGoOnWhileFollowing) {
  widget_.setDisplayFrame("base_link");
  key(Qt::Key_T);
  EXPECT_EQ(widget_.camera().follow().mode(), FollowMode::Position);
  key(Qt::Key_Left, Qt::ShiftModifier);
  key(Qt::Key_PageUp);
  const auto sight = widget_.camera().sight();
  goTo(9_s);
  EXPECT_EQ(widget_.camera().sight(), sight) << "the user's orbit and zoom are kept";
  key(Qt::Key_R);
  EXPECT_NEAR(glm::length(pixelOf("base_link") - glm::dvec2(200, 150)), 0.0, 1e-6);
  EXPECT_DOUBLE_EQ(widget_.camera().sight().radius_m, sight.radius_m);
}

TEST_F(WidgetCameraTest, AnAbsentFollowTargetStaysInertUntilItAppears) {
  auto viewpoint = widget_.camera().state();
  viewpoint.display_frame = "drone";
  viewpoint.follow.mode = FollowMode::Pose;
  viewpoint.follow.base_from_camera.translation = {0, 0, 5};
  widget_.setViewpoint(viewpoint);
  settle();
  const glm::dmat4 inert = widget_.shownView().eye_from_fixed;
  goTo(5_s);
  EXPECT_EQ(widget_.shownView().eye_from_fixed, inert);
  EXPECT_EQ(widget_.camera().state(), viewpoint);
}

TEST_F(WidgetCameraTest, AnotherFixedFrameLeavesTheViewOfTheData) {
  key(Qt::Key_Left, Qt::ShiftModifier);
  for (const FollowMode mode : scenegraph::kFollowModes) {
    widget_.setFixedFrame("map");
    goTo(5_s);
    widget_.setDisplayFrame("lidar");
    widget_.setFollow(mode);
    const glm::dvec2 lidar = pixelOf("lidar");
    const glm::dvec2 map = pixelOf("map");
    widget_.setFixedFrame("base_link");
    settle();
    EXPECT_NEAR(glm::length(pixelOf("lidar") - lidar), 0.0, 1e-6) << toString(mode);
    EXPECT_NEAR(glm::length(pixelOf("map") - map), 0.0, 1e-6) << toString(mode);
  }
}

TEST_F(WidgetCameraTest, FFramesTheSelectionAndShiftFEverything) {
  goTo(9_s);
  widget_.setSelection(Selection{"lidar", {0, 0, 0}, 0.5});
  key(Qt::Key_F);
  EXPECT_NEAR(glm::length(pixelOf("lidar") - glm::dvec2(200, 150)), 0.0, 1e-6);
  const double near_m = widget_.camera().sight().radius_m;
  EXPECT_LT(near_m, 3.0);
  key(Qt::Key_F, Qt::ShiftModifier);
  EXPECT_GT(widget_.camera().sight().radius_m, 2.0 * near_m);
}

TEST_F(WidgetCameraTest, AxisKeysLookFromThatSide) {
  const glm::dvec3 focal = widget_.camera().sight().focal_point;
  key(Qt::Key_X);
  EXPECT_NEAR(widget_.camera().sight().pitch_rad, 0.0, 1e-12);
  EXPECT_NEAR(widget_.camera().sight().yaw_rad, 0.0, 1e-12);
  key(Qt::Key_Z, Qt::ShiftModifier);
  EXPECT_NEAR(widget_.camera().sight().pitch_rad, -std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(widget_.camera().sight().focal_point, focal);
}

TEST_F(WidgetCameraTest, WalkingKeysCarryTheCameraWhileTheyAreHeldAndThenItRests) {
  key(Qt::Key_4);
  const glm::dvec3 eye = widget_.camera().rig().fly().state().eye;
  QTest::keyPress(&widget_, Qt::Key_W);
  ASSERT_TRUE(waitFor([&] { return glm::length(widget_.camera().rig().fly().state().eye - eye) > 0.5; }));
  QTest::keyRelease(&widget_, Qt::Key_W);
  settle();
  const glm::dvec3 there = widget_.camera().rig().fly().state().eye;
  const auto frames = widget_.framesDrawn();
  settle();
  EXPECT_EQ(widget_.camera().rig().fly().state().eye, there);
  EXPECT_EQ(widget_.framesDrawn(), frames) << "standing still costs nothing";
  EXPECT_TRUE(widget_.isCameraTouched());
}

TEST_F(WidgetCameraTest, LosingTheFocusEndsAWalk) {
  QTest::keyPress(&widget_, Qt::Key_D);
  settle();
  QFocusEvent gone(QEvent::FocusOut);
  QCoreApplication::sendEvent(&widget_, &gone);
  settle();
  const auto sight = widget_.camera().sight();
  settle();
  EXPECT_EQ(widget_.camera().sight(), sight);
}

TEST_F(WidgetCameraTest, SavedViewsComeBackByNameAndByKey) {
  key(Qt::Key_B);
  const auto first = widget_.camera().state();
  ASSERT_EQ(widget_.savedViews().size(), 1U);
  EXPECT_EQ(widget_.savedViews()[0].name, "View 1");
  key(Qt::Key_3);
  key(Qt::Key_Up, Qt::ControlModifier);
  widget_.saveView("from above");
  const auto above = widget_.camera().state();
  key(Qt::Key_1, Qt::ControlModifier);
  EXPECT_EQ(widget_.camera().state(), first);
  EXPECT_TRUE(widget_.showSavedView("from above"));
  EXPECT_EQ(widget_.camera().state(), above);
  EXPECT_FALSE(widget_.showSavedView("no such view"));
  widget_.saveView("from above");
  EXPECT_EQ(widget_.savedViews().size(), 2U) << "replaced";
}

TEST_F(WidgetCameraTest, AFrameWithoutAPlaceIsToldWhenItIsToBeLookedAt) {
  goTo(9_s);
  QStringList refused;
  QObject::connect(&widget_, &viewer::SceneWidget::refused, [&](const QString& why) { refused << why; });
  const auto before = widget_.camera().sight().focal_point;
  widget_.frameOrigin("no such frame");
  EXPECT_EQ(refused, QStringList{"no such frame has no place in map at this time"});
  widget_.setDisplayFrame("arm");
  refused.clear();
  widget_.recenter();
  EXPECT_EQ(refused, QStringList{"arm has no place in map at this time"});
  EXPECT_EQ(widget_.camera().sight().focal_point, before);
  widget_.setDisplayFrame("lidar");
  refused.clear();
  widget_.recenter();
  EXPECT_TRUE(refused.isEmpty());
}

TEST_F(WidgetCameraTest, SmoothMovesEndExactlyWhereTheOthersDo) {
  goTo(9_s);
  const auto start = widget_.camera().state();
  widget_.frameOrigin("lidar");
  const auto at_once = widget_.camera().state();
  widget_.setViewpoint(start);
  settle();
  widget_.setSmoothMoves(true);
  widget_.frameOrigin("lidar");
  const glm::dmat4 on_the_way = widget_.shownView().eye_from_fixed;
  EXPECT_EQ(widget_.camera().state(), at_once) << "what is saved meanwhile is where it goes";
  ASSERT_TRUE(waitFor([&] {
    QCoreApplication::processEvents();
    return glm::length(pixelOf("lidar") - glm::dvec2(200, 150)) < 1e-6;
  }));
  EXPECT_NE(widget_.shownView().eye_from_fixed, on_the_way);
  const auto frames = widget_.framesDrawn();
  EXPECT_GT(frames, 2U);
  settle();
  settle();
  const auto rested = widget_.framesDrawn();
  settle();
  EXPECT_EQ(widget_.framesDrawn(), rested) << "idle again";
}

TEST_F(WidgetCameraTest, ASmoothMoveEndsThoughOneFrameTakesLongerThanAllOfIt) {
  struct SlowCull : osg::NodeCallback {
    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
      QThread::msleep(400);
      traverse(node, visitor);
    }
  };
  goTo(9_s);
  widget_.setSmoothMoves(true);
  const auto before = widget_.framesDrawn();
  widget_.scene()->root().setCullCallback(new SlowCull);
  widget_.frameOrigin("lidar");
  EXPECT_TRUE(waitFor([&] {
    QCoreApplication::processEvents();
    return widget_.framesDrawn() >= before + 2;
  })) << "the first shows the camera on its way";
  widget_.scene()->root().setCullCallback(nullptr);
}

TEST_F(WidgetCameraTest, WhatIsRestoredStaysWhenTheLastDataBringsAnotherFixedFrame) {
  auto state = widget_.camera().state();
  state.camera.orbit.radius_m = 33.0;
  for (const bool is_touched : {false, true}) {
    widget_.scene()->setPreferredFrame(std::nullopt);
    widget_.restoreViewpoint(state, is_touched);
    settle();
    widget_.scene()->setPreferredFrame("base_link");  // as frames do that come last, before any tick
    EXPECT_TRUE(widget_.endRestoring());
    settle();
    EXPECT_EQ(widget_.scene()->fixedFrame(), "base_link");
    EXPECT_EQ(widget_.camera().state(), state);
    EXPECT_FALSE(widget_.endRestoring());
  }
}

TEST_F(WidgetCameraTest, QuestionMarkShowsTheHelpAndEscapeHidesIt) {
  auto* help = widget_.findChild<HelpOverlay*>();
  ASSERT_NE(help, nullptr);
  EXPECT_FALSE(help->isShown());
  widget_.resize(900, 700);
  key(Qt::Key_Question, Qt::ShiftModifier);
  EXPECT_TRUE(help->isShown());
  EXPECT_TRUE(help->text().contains(QStringLiteral("Home")));
  const QSize wide = help->size();
  widget_.resize(wide.width() - 100, widget_.height());
  test::settle();
  EXPECT_EQ(help->x(), 0);
  EXPECT_EQ(help->width(), widget_.width()) << "nothing is cut off";
  EXPECT_GT(help->height(), wide.height());
  key(Qt::Key_Escape);
  EXPECT_FALSE(help->isShown());
}

TEST_F(WidgetCameraTest, HoverNamesAllFramesAtOnePlace) {
  goTo(1_s);
  const glm::dvec2 at = pixelOf("map");  // odom is there too
  hover({at.x, at.y});
  const auto labels = widget_.findChildren<QLabel*>();
  const bool is_named = std::ranges::any_of(labels, [](const QLabel* label) {
    return label->isVisible() && label->text().startsWith(QStringLiteral("map\nodom"));
  });
  EXPECT_TRUE(is_named);
}

TEST_F(WidgetCameraTest, OrthographicHoverAndFramingWork) {
  key(Qt::Key_3);
  key(Qt::Key_Home);
  settle();
  const glm::dvec2 at = pixelOf("lidar");
  EXPECT_GE(at.x, 0.0);
  EXPECT_LE(at.x, kSize.width_px);
  QString hovered;
  QObject::connect(&widget_, &SceneWidget::frameHovered, &widget_, [&](const QString& frame) { hovered = frame; });
  hover({at.x, at.y});
  EXPECT_EQ(hovered, QStringLiteral("lidar"));
}

}  // namespace
}  // namespace stillframe::viewer
