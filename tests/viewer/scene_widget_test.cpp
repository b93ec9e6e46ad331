#include "viewer/widget/scene_widget.h"

#include <gtest/gtest.h>

#include <QHBoxLayout>
#include <QMouseEvent>
#include <QTest>
#include <QWheelEvent>
#include <cmath>
#include <glm/geometric.hpp>
#include <osg/MatrixTransform>

#include "scenegraph/camera/picking.h"
#include "scenegraph/osg_matrix.h"
#include "tests/scenegraph/pipeline/shader_scene.h"
#include "tests/viewer/viewer_support.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using test::settle;
using test::waitFor;
using tf::TimePoint;

class SceneWidgetTest : public testing::Test {
 protected:
  SceneWidgetTest() {
    widget_->resize(400, 300);
    widget_->setSmoothMoves(false);
    widget_->setDataset(dataset_, *executor_);
    widget_->scene()->addDefaultLayers();
    widget_->setTime(TimePoint{1_s});
  }

  void TearDown() override {
    if (widget_ != nullptr) {
      EXPECT_EQ(widget_->glMessages(), 0U) << "OpenGL debug output must be silent";
      EXPECT_EQ(widget_->problem(), QString());
    }
  }

  void show() {
    widget_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(widget_.get()));
    settle();
    ASSERT_GT(widget_->framesDrawn(), 0U);
  }

  /// Without buttons; QTest::mouseMove() goes by way of the X server's pointer, which is nobody's here.
  void moveMouse(QPointF position) {
    QMouseEvent event(QEvent::MouseMove, position, widget_->mapToGlobal(position), Qt::NoButton, Qt::NoButton,
                      Qt::NoModifier);
    QCoreApplication::sendEvent(widget_.get(), &event);
  }

  void look(const scenegraph::Sight& sight) {
    auto viewpoint = widget_->camera().state();
    viewpoint.camera.orbit = sight;
    widget_->setViewpoint(viewpoint);
  }

  int drawn() { return test::drawnPixels(widget_->grabFramebuffer()); }

  std::shared_ptr<scenegraph::Dataset> dataset_ = test::makeRobotDataset();
  std::unique_ptr<scenegraph::Executor> executor_ = scenegraph::makeSynchronousExecutor();
  std::unique_ptr<SceneWidget> widget_ = std::make_unique<SceneWidget>();
};

TEST_F(SceneWidgetTest, PaintsTheScene) {
  show();
  EXPECT_GT(drawn(), 500);
}

TEST_F(SceneWidgetTest, IdleDrawsNothing) {
  show();
  const auto frames = widget_->framesDrawn();
  settle();
  EXPECT_EQ(widget_->framesDrawn(), frames);
}

TEST_F(SceneWidgetTest, UpdateThatChangesNothingDrawsNothing) {
  show();
  const auto frames = widget_->framesDrawn();
  widget_->setTime(TimePoint{1_s});
  widget_->requestTick();
  settle();
  EXPECT_EQ(widget_->framesDrawn(), frames);
}

TEST_F(SceneWidgetTest, ManyTicksBetweenTwoFramesDrawOnce) {
  show();
  const auto frames = widget_->framesDrawn();
  for (int i = 0; i < 50; ++i) {
    widget_->setTime(TimePoint{2_s + i * 1'000'000});
  }
  settle();
  EXPECT_EQ(widget_->scene()->time(), TimePoint{2_s + 49'000'000});
  EXPECT_LE(widget_->framesDrawn(), frames + 2);
  EXPECT_GT(widget_->framesDrawn(), frames);
}

TEST_F(SceneWidgetTest, TickMovesThePicture) {
  show();
  const QImage before = widget_->grabFramebuffer();
  widget_->setTime(TimePoint{9_s});
  settle();
  EXPECT_NE(widget_->grabFramebuffer(), before);
  widget_->setTime(TimePoint{1_s});
  settle();
  EXPECT_EQ(widget_->grabFramebuffer(), before) << "back at the same time, the same picture";
}

TEST_F(SceneWidgetTest, MouseChangesTheCameraAsDocumented) {
  show();
  const auto start = widget_->camera().sight();
  QTest::mousePress(widget_.get(), Qt::LeftButton, {}, {200, 150});
  QTest::mouseMove(widget_.get(), {260, 150});
  QTest::mouseRelease(widget_.get(), Qt::LeftButton, {}, {260, 150});
  const auto turned = widget_->camera().sight();
  EXPECT_GT(std::abs(turned.yaw_rad - start.yaw_rad), 0.1);
  EXPECT_EQ(turned.focal_point, start.focal_point);

  QTest::mousePress(widget_.get(), Qt::MiddleButton, {}, {200, 150});
  QTest::mouseMove(widget_.get(), {200, 190});
  QTest::mouseRelease(widget_.get(), Qt::MiddleButton, {}, {200, 190});
  const auto panned = widget_->camera().sight();
  EXPECT_GT(glm::length(panned.focal_point - turned.focal_point), 1e-3);
  EXPECT_EQ(panned.yaw_rad, turned.yaw_rad);

  QWheelEvent wheel({200, 150}, widget_->mapToGlobal(QPointF(200, 150)), {}, {0, 120}, Qt::NoButton, Qt::NoModifier,
                    Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(widget_.get(), &wheel);
  EXPECT_NEAR(widget_->camera().sight().radius_m, panned.radius_m * 0.9, 1e-9);
  EXPECT_TRUE(widget_->isCameraTouched());

  QTest::keyClick(widget_.get(), Qt::Key_Home);
  settle();
  EXPECT_FALSE(widget_->isCameraTouched());
  EXPECT_EQ(widget_->camera().sight(), start);
}

TEST_F(SceneWidgetTest, DefaultViewWaitsForTheFirstData) {
  widget_->setTime(TimePoint{0});
  show();
  const auto axes_only = widget_->camera().sight();
  widget_->setTime(TimePoint{1_s});
  settle();
  const auto with_cloud = widget_->camera().sight();
  EXPECT_NE(with_cloud.radius_m, axes_only.radius_m);
  widget_->setTime(TimePoint{9_s});
  settle();
  EXPECT_EQ(widget_->camera().sight(), with_cloud) << "once: scrubbing must not move the camera";
}

TEST_F(SceneWidgetTest, HoverNamesTheFrameUnderTheCursor) {
  show();
  QString hovered;
  QObject::connect(widget_.get(), &SceneWidget::frameHovered, widget_.get(),
                   [&](const QString& frame) { hovered = frame; });
  widget_->setTime(TimePoint{5_s});
  settle();
  const auto fixed_from_lidar = widget_->scene()->frames().fixedFromFrame("lidar");
  ASSERT_TRUE(fixed_from_lidar.has_value());
  const auto at = scenegraph::toScreen(widget_->shownView(), {400.0, 300.0}, fixed_from_lidar->translation);
  ASSERT_TRUE(at.has_value());
  moveMouse({at->position_px.x + 3.0, at->position_px.y});
  EXPECT_EQ(hovered, QStringLiteral("lidar"));
  moveMouse({2.0, 2.0});
  EXPECT_EQ(hovered, QString());
}

TEST_F(SceneWidgetTest, DoubleClickDoesNothing) {
  show();
  const auto before = widget_->camera().sight();
  QTest::mouseDClick(widget_.get(), Qt::LeftButton, {}, {100, 100});
  EXPECT_EQ(widget_->camera().sight(), before);
}

TEST_F(SceneWidgetTest, FKeyFramesEverythingFromThePresentDirection) {
  show();
  auto state = widget_->camera().sight();
  state.focal_point = {500.0, 500.0, 0.0};
  state.yaw_rad = 1.0;
  look(state);
  QTest::keyClick(widget_.get(), Qt::Key_F);
  const auto framed = widget_->camera().sight();
  EXPECT_DOUBLE_EQ(framed.yaw_rad, 1.0);
  EXPECT_LT(glm::length(framed.focal_point), 20.0);
}

TEST_F(SceneWidgetTest, ResizingToNothingAndBackKeepsDrawing) {
  show();
  widget_->resize(0, 0);
  settle();
  widget_->resize(1, 1);
  settle();
  widget_->resize(500, 350);
  settle();
  EXPECT_GT(drawn(), 500);
}

TEST_F(SceneWidgetTest, DrawsOneFrameForSeveralSizes) {
  show();
  const auto frames = widget_->framesDrawn();
  for (const int width : {420, 440, 460}) {
    widget_->resize(width, 300);
  }
  EXPECT_EQ(widget_->framesDrawn(), frames) << "within a resize nothing is drawn";
  settle();
  EXPECT_GT(widget_->framesDrawn(), frames);
  EXPECT_GT(drawn(), 500);
}

TEST_F(SceneWidgetTest, HidingAndShowingKeepsDrawingAndTakesUpTheTime) {
  show();
  widget_->hide();
  settle();
  const auto frames = widget_->framesDrawn();
  widget_->setTime(TimePoint{9_s});
  settle();
  EXPECT_EQ(widget_->framesDrawn(), frames) << "a hidden view does no work";
  EXPECT_EQ(widget_->scene()->time(), TimePoint{1_s});
  widget_->show();
  ASSERT_TRUE(waitFor([&] { return widget_->framesDrawn() > frames; }));
  settle();
  EXPECT_EQ(widget_->scene()->time(), TimePoint{9_s});
  EXPECT_GT(drawn(), 500);
}

TEST_F(SceneWidgetTest, MovingToAnotherWindowKeepsDrawing) {
  show();
  for (int i = 0; i < 3; ++i) {
    QWidget window;
    auto* layout = new QHBoxLayout(&window);
    layout->addWidget(widget_.get());
    window.resize(420, 320);
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
    settle();
    EXPECT_GT(drawn(), 500);
    widget_->setParent(nullptr);
    widget_->show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(widget_.get()));
    settle();
    EXPECT_GT(drawn(), 500);
  }
}

TEST_F(SceneWidgetTest, AnotherDatasetReplacesTheScene) {
  show();
  widget_->setDataset(test::makeRobotDataset(), *executor_);
  settle();
  EXPECT_EQ(drawn(), 0) << "no layers yet";
  widget_->scene()->addDefaultLayers();
  widget_->requestTick();
  settle();
  EXPECT_GT(drawn(), 500);
}

TEST_F(SceneWidgetTest, DestroyedWhileShownAndBeforeItWasShown) {
  show();
  EXPECT_EQ(widget_->glMessages(), 0U);
  widget_.reset();
  settle();
  SceneWidget never_shown;
  never_shown.setDataset(dataset_, *executor_);
}

TEST_F(SceneWidgetTest, TwoViewsOfOneDatasetHaveTheirOwnFixedFrames) {
  show();
  SceneWidget other;
  other.resize(400, 300);
  other.setDataset(dataset_, *executor_);
  other.scene()->addDefaultLayers();
  other.setFixedFrame("base_link");
  other.setTime(TimePoint{5_s});
  widget_->setTime(TimePoint{5_s});
  other.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&other));
  settle();
  const auto map_from_base = widget_->scene()->frames().fixedFromFrame("base_link");
  const auto base_from_base = other.scene()->frames().fixedFromFrame("base_link");
  ASSERT_TRUE(map_from_base && base_from_base);
  EXPECT_DOUBLE_EQ(map_from_base->translation.x, 5.0);
  EXPECT_DOUBLE_EQ(base_from_base->translation.x, 0.0);
  EXPECT_GT(drawn(), 500);
  EXPECT_GT(test::drawnPixels(other.grabFramebuffer()), 500);
  EXPECT_EQ(other.glMessages(), 0U);
}

TEST_F(SceneWidgetTest, FixedFrameChangeKeepsLookingAtTheSamePlace) {
  widget_->setTime(TimePoint{5_s});
  show();
  auto state = widget_->camera().sight();
  state.focal_point = {5.0, 1.0, 0.0};
  look(state);
  widget_->setFixedFrame("base_link");
  settle();
  const auto carried = widget_->camera().sight();
  EXPECT_NEAR(carried.focal_point.x, 0.0, 1e-12);
  EXPECT_NEAR(carried.focal_point.y, 1.0, 1e-12);
}

TEST_F(SceneWidgetTest, UnknownFixedFrameIsSurvived) {
  show();
  widget_->setFixedFrame("no_such_frame");
  settle();
  EXPECT_EQ(widget_->problem(), QString());
  widget_->setFixedFrame(std::nullopt);
  settle();
  EXPECT_GT(drawn(), 500);
}

TEST_F(SceneWidgetTest, HidingALayerByItsSwitchChangesThePicture) {
  show();
  const QImage before = widget_->grabFramebuffer();
  for (const auto& slot : widget_->scene()->layers()) {
    slot->layer->setVisible(false);
  }
  widget_->requestTick();
  settle();
  EXPECT_EQ(drawn(), 0);
  EXPECT_NE(widget_->grabFramebuffer(), before);
}

TEST(SceneWidgetContext, CoreProfileIsRefusedWithAMessage) {
  SceneWidget widget;
  QSurfaceFormat core = widget.format();
  core.setProfile(QSurfaceFormat::CoreProfile);
  core.setOption(QSurfaceFormat::DeprecatedFunctions, false);
  widget.setFormat(core);
  widget.resize(300, 200);
  widget.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&widget));
  settle();
  EXPECT_TRUE(widget.problem().contains(QStringLiteral("compatibility"))) << widget.problem().toStdString();
}

}  // namespace
}  // namespace stillframe::viewer
