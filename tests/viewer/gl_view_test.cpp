// The ways in which views come to the screen.
#include "viewer/widget/gl_view.h"

#include <gtest/gtest.h>

#include <QHBoxLayout>
#include <QLabel>
#include <QOpenGLContext>
#include <QOpenGLWidget>
#include <QTest>

#include "tests/viewer/viewer_support.h"
#include "viewer/widget/gl_format.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using test::settle;
using test::waitFor;

/// The way of the program's other views comes back.
class GlViewWays : public testing::Test {
 protected:
  GlViewWays() : is_composed_(qEnvironmentVariable("STILLFRAME_TEST_VIEWS") == QStringLiteral("composed")) {}
  ~GlViewWays() override { GlView::setWay(is_composed_ ? ViewWay::Composed : ViewWay::Auto); }

  std::unique_ptr<SceneWidget> show(ViewWay way) {
    GlView::setWay(way);
    auto view = std::make_unique<SceneWidget>();
    view->resize(400, 300);
    view->setSmoothMoves(false);
    view->setDataset(dataset_, *executor_);
    view->scene()->addDefaultLayers();
    view->setTime(tf::TimePoint{2_s});
    view->show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(view.get()));
    settle();
    return view;
  }
  static bool hasCanvas(const QWidget& view) { return view.findChild<QOpenGLWidget*>() != nullptr; }

  bool is_composed_;
  std::shared_ptr<scenegraph::Dataset> dataset_ = test::makeRobotDataset();
  std::unique_ptr<scenegraph::Executor> executor_ = scenegraph::makeSynchronousExecutor();
};

TEST_F(GlViewWays, ShowTheSamePicture) {
  const auto composed = show(ViewWay::Composed);
  const QImage by_opengl = composed->grab().toImage();
  EXPECT_TRUE(hasCanvas(*composed));
  const auto image = show(ViewWay::Image);
  EXPECT_FALSE(hasCanvas(*image)) << "its window has no OpenGL";
  EXPECT_GT(test::drawnPixels(by_opengl), 500);
  EXPECT_EQ(image->grab().toImage().convertToFormat(QImage::Format_RGB32),
            by_opengl.convertToFormat(QImage::Format_RGB32));
  EXPECT_EQ(image->grabFramebuffer(), composed->grabFramebuffer().convertToFormat(QImage::Format_RGB32));
  for (const auto& view : {composed.get(), image.get()}) {
    const QImage before = view->grabFramebuffer();
    QTest::keyClick(view, Qt::Key_Left, Qt::ShiftModifier);
    settle();
    EXPECT_NE(view->grabFramebuffer(), before) << "keys reach it";
    EXPECT_EQ(view->glMessages(), 0U);
  }
  EXPECT_EQ(image->grabFramebuffer(), composed->grabFramebuffer().convertToFormat(QImage::Format_RGB32));
}

TEST_F(GlViewWays, SoftwareOpenGlMakesImages) {
  const auto view = show(ViewWay::Auto);
  EXPECT_FALSE(hasCanvas(*view)) << "these tests set LIBGL_ALWAYS_SOFTWARE";
}

TEST_F(GlViewWays, AnImageKeepsItsContextFromWindowToWindow) {
  const auto view = show(ViewWay::Image);
  const QOpenGLContext* const context = view->context();
  ASSERT_NE(context, nullptr);
  const auto frames = view->framesDrawn();
  {
    QWidget window;
    auto* const layout = new QHBoxLayout(&window);
    layout->setContentsMargins({});
    layout->addWidget(view.get());
    window.resize(400, 300);
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
    settle();
    EXPECT_EQ(view->context(), context);
    EXPECT_GT(test::drawnPixels(window.grab().toImage()), 500);
    view->setParent(nullptr);
  }
  view->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(view.get()));
  settle();
  EXPECT_EQ(view->context(), context);
  EXPECT_LE(view->framesDrawn(), frames + 4);
  EXPECT_EQ(view->glMessages(), 0U);
}

TEST_F(GlViewWays, WhatIsOverAViewIsSeenHoweverLowItIsPut) {
  for (const ViewWay way : {ViewWay::Composed, ViewWay::Image}) {
    const auto view = show(way);
    QLabel over(view.get());
    over.setStyleSheet(QStringLiteral("background: rgb(255, 0, 255);"));
    over.setGeometry(10, 20, 30, 40);
    over.show();
    const auto frames = view->framesDrawn();
    settle();
    for (int i = 0; i < 2; ++i) {
      const QImage seen = view->grab().toImage();
      EXPECT_EQ(seen.pixelColor(25, 40), QColor(255, 0, 255));
      EXPECT_NE(seen.pixelColor(45, 40), QColor(255, 0, 255));
      over.lower();
    }
    EXPECT_EQ(view->framesDrawn(), frames) << "painting draws no frame";
  }
}

TEST_F(GlViewWays, AViewWithoutRoomOrContextIsSurvived) {
  const auto view = show(ViewWay::Image);
  view->resize(0, 0);
  settle();
  view->resize(400, 300);
  settle();
  EXPECT_GT(test::drawnPixels(view->grabFramebuffer()), 500);

  SceneWidget none;
  QSurfaceFormat impossible = glFormat();
  impossible.setRenderableType(QSurfaceFormat::OpenVG);
  none.setFormat(impossible);
  none.resize(300, 200);
  none.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&none));
  settle();
  EXPECT_FALSE(none.problem().isEmpty());
}

}  // namespace
}  // namespace stillframe::viewer
