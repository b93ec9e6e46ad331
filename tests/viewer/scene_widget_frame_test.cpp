// When SceneWidget draws, and what it shows meanwhile.
#include <gtest/gtest.h>

#include <QTest>
#include <algorithm>
#include <osg/MatrixTransform>
#include <utility>

#include "scenegraph/osg_matrix.h"
#include "tests/scenegraph/pipeline/shader_scene.h"
#include "tests/viewer/shown_widget.h"
#include "tests/viewer/viewer_support.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using test::settle;
using test::waitFor;
using tf::TimePoint;

using SceneWidgetFrames = test::ShownWidgetTest;

/// Pixels of a colour, and the middle of them.
std::pair<int, QPointF> placeOf(const QImage& image, QColor color) {
  int count = 0;
  QPointF sum;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.pixelColor(x, y) == color) {
        ++count;
        sum += QPointF(x, y);
      }
    }
  }
  return {count, sum / std::max(1, count)};
}

TEST_F(SceneWidgetFrames, ShowsTheLastPictureInItsMiddleUntilTheNextIsWhole) {
  const osg::ref_ptr<osg::MatrixTransform> before_eye =
      new osg::MatrixTransform{osg::Matrixd::inverse(scenegraph::toOsg(widget_.shownView().eye_from_fixed))};
  before_eye->addChild(scenegraph::makeQuad(0.3F, 0.3F, -2.0F, {0, 1, 1, 1}));
  widget_.scene()->root().addChild(before_eye);
  const auto [count, middle] = placeOf(widget_.grabFramebuffer(), QColor(0, 255, 255));
  ASSERT_GT(count, 500);
  const auto frames = widget_.framesDrawn();
  // One after the other, all of the picture before the first: what was cut off comes back.
  for (const QSize size : {QSize(500, 360), QSize(240, 180), QSize(360, 400)}) {
    widget_.resize(size);
    const auto [kept, kept_middle] = placeOf(widget_.grabShown(), QColor(0, 255, 255));
    EXPECT_EQ(widget_.framesDrawn(), frames) << "a resize draws nothing, whatever there is to draw";
    EXPECT_EQ(kept, count);
    EXPECT_NEAR(kept_middle.x(), middle.x() + (size.width() - 400) / 2.0, 1.0);
    EXPECT_NEAR(kept_middle.y(), middle.y() + (size.height() - 300) / 2.0, 1.0);
  }
  ASSERT_TRUE(waitFor([&] { return widget_.framesDrawn() > frames; }));
  EXPECT_NE(placeOf(widget_.grabShown(), QColor(0, 255, 255)).first, count) << "drawn anew";
  widget_.scene()->root().removeChild(before_eye);
  settle();
}

/// A view that is moved between screens.
class MovedView : public SceneWidget {
 public:
  void setRatio(int ratio) {
    ratio_ = ratio;
    QEvent event(QEvent::ScreenChangeInternal);
    QCoreApplication::sendEvent(this, &event);
  }

 protected:
  int metric(PaintDeviceMetric metric) const override {
    switch (metric) {
      case PdmDevicePixelRatio:
        return ratio_;
      case PdmDevicePixelRatioScaled:
        return static_cast<int>(ratio_ * devicePixelRatioFScale());
      default:
        return SceneWidget::metric(metric);
    }
  }

 private:
  int ratio_ = 1;
};

TEST_F(SceneWidgetFrames, ShowsTheLastPictureOnASharperScreenUntilTheNextIsWhole) {
  MovedView view;
  view.resize(200, 150);
  view.setDataset(dataset_, *executor_);
  view.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&view));
  settle();
  const osg::ref_ptr<osg::MatrixTransform> before_eye =
      new osg::MatrixTransform{osg::Matrixd::inverse(scenegraph::toOsg(view.shownView().eye_from_fixed))};
  before_eye->addChild(scenegraph::makeQuad(0.3F, 0.3F, -2.0F, {0, 1, 1, 1}));
  view.scene()->root().addChild(before_eye);
  const auto [count, middle] = placeOf(view.grabFramebuffer(), QColor(0, 255, 255));
  ASSERT_GT(count, 200);
  settle();
  const auto frames = view.framesDrawn();
  view.setRatio(2);
  const QImage kept = view.grabShown();
  EXPECT_EQ(kept.size(), QSize(400, 300));
  EXPECT_EQ(view.framesDrawn(), frames) << "nothing is drawn as yet";
  EXPECT_EQ(placeOf(kept, QColor(0, 255, 255)).first, count);
  ASSERT_TRUE(waitFor([&] { return view.framesDrawn() > frames; }));
  EXPECT_NEAR(placeOf(view.grabShown(), QColor(0, 255, 255)).first, 4 * count, count / 2);
  view.scene()->root().removeChild(before_eye);
  settle();
}

TEST_F(SceneWidgetFrames, PaintingTheWindowAloneDrawsNoFrame) {
  const auto frames = widget_.framesDrawn();
  const QImage before = widget_.grabShown();
  for (int i = 0; i < 3; ++i) {
    widget_.QWidget::update();  // as when something over it moves
    settle();
  }
  EXPECT_EQ(widget_.framesDrawn(), frames);
  EXPECT_EQ(widget_.grabShown(), before);
}

TEST_F(SceneWidgetFrames, DrawsALongFrameInSteps) {
  const QImage at_first = widget_.grabFramebuffer();
  const scenegraph::CameraView view = widget_.shownView();
  // Sheets, each nearer than those before, over the whole view.
  const osg::ref_ptr<osg::MatrixTransform> before_eye =
      new osg::MatrixTransform{osg::Matrixd::inverse(scenegraph::toOsg(view.eye_from_fixed))};
  for (int i = 0; i < 150; ++i) {
    before_eye->addChild(scenegraph::makeQuad(40, 40, -10.0F + 0.01F * static_cast<float>(i), {0, 1, 1, 1}));
  }
  widget_.scene()->root().addChild(before_eye);
  auto frames = widget_.framesDrawn();
  widget_.update();
  QCoreApplication::sendPostedEvents();
  EXPECT_EQ(widget_.framesDrawn(), frames) << "the first step was not all of it";
  widget_.setTime(TimePoint{3_s});
  EXPECT_FALSE(widget_.applyTick()) << "the scene stands still meanwhile";
  EXPECT_NE(widget_.scene()->frames().time(), TimePoint{3_s});
  EXPECT_EQ(widget_.grabShown(), at_first) << "no part of a picture is shown";
  ASSERT_TRUE(waitFor([&] { return widget_.framesDrawn() > frames; }));
  EXPECT_EQ(widget_.grabShown().pixelColor(200, 150), QColor(0, 255, 255));
  ASSERT_TRUE(waitFor([&] { return widget_.scene()->frames().time() == TimePoint{3_s}; }));

  // What changes while a frame is drawn is in the next one, and a picture that somebody waits for is whole.
  widget_.scene()->root().removeChild(before_eye);
  EXPECT_NE(widget_.grabFramebuffer().pixelColor(200, 150), QColor(0, 255, 255));
  widget_.scene()->root().addChild(before_eye);
  EXPECT_EQ(widget_.grabFramebuffer().pixelColor(200, 150), QColor(0, 255, 255));
  widget_.update();
  QCoreApplication::sendPostedEvents();
  frames = widget_.framesDrawn();
  widget_.setBackground({1, 0, 0, 1});
  ASSERT_TRUE(waitFor([&] { return widget_.framesDrawn() >= frames + 2; })) << "one more was asked for";
  widget_.scene()->root().removeChild(before_eye);
  settle();
}

}  // namespace
}  // namespace stillframe::viewer
