// Hovering, clicking and measuring in a view, and the panel that says what was picked.
#include <gtest/gtest.h>

#include <QApplication>
#include <QClipboard>
#include <QTest>
#include <QThread>
#include <QToolButton>
#include <QTreeWidget>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <osgUtil/CullVisitor>

#include "tests/viewer/shown_widget.h"
#include "tests/viewer/viewer_support.h"
#include "viewer/pick/hover_label.h"
#include "viewer/pick/inspect_panel.h"
#include "viewer/pick/view_picks.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using scenegraph::PickError;
using test::settle;
using test::waitFor;
using tf::TimePoint;

class WidgetPickTest : public test::ShownWidgetTest {
 protected:
  WidgetPickTest() {
    widget_.scene()->findLayer("tf")->layer->setVisible(false);
    widget_.requestTick();
    settle();
  }

  /// Where a point of the cloud in "lidar" is in the view; the points lie 5 cm apart, from -1 to 1.
  QPointF at(double x, double y) { return pixelOf("lidar", {x, y, 0.0}); }
  const std::optional<scenegraph::PickResult>& selected() { return widget_.picks().selected(); }
};

TEST_F(WidgetPickTest, ClickSelectsThePointAndFFramesIt) {
  click(at(0.5, -0.25));
  ASSERT_TRUE(selected());
  EXPECT_EQ(selected()->topic, "/points");
  EXPECT_EQ(selected()->frame, "lidar");
  EXPECT_LT(glm::distance(selected()->picked.point_in_frame, glm::dvec3(0.5, -0.25, 0.0)), 0.2);
  ASSERT_TRUE(widget_.selection());
  EXPECT_EQ(widget_.selection()->frame, "lidar");
  EXPECT_EQ(widget_.selection()->point_in_frame, selected()->picked.point_in_frame);
  QTest::keyClick(&widget_, Qt::Key_F);
  const auto pose = widget_.scene()->frames().fixedFromFrame("lidar");
  const glm::dvec3 point_in_fixed = tf::transformPoint(*pose, selected()->picked.point_in_frame);
  EXPECT_LT(glm::distance(widget_.camera().sight().focal_point, point_in_fixed), 1e-6);
  settle();
  ASSERT_TRUE(widget_.picks().placed().ring_px);
  EXPECT_LT(std::abs(widget_.picks().placed().ring_px->x - 200.0), 1.0);
  click({3, 3});
  EXPECT_FALSE(selected()) << "a click on nothing deselects";
  EXPECT_FALSE(widget_.selection());
}

/// Notes what each frame is drawn from, and takes its time.
struct SlowFrames : osg::NodeCallback {
  void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
    drawn_from[widget.framesDrawn() + 1] = *visitor->asCullVisitor()->getModelViewMatrix();
    QThread::msleep(20);
    traverse(node, visitor);
  }
  explicit SlowFrames(const SceneWidget& slow) : widget(slow) {}
  const SceneWidget& widget;
  std::map<std::uint64_t, osg::Matrixd> drawn_from;  // by numbers of frames
};

TEST_F(WidgetPickTest, TheRingIsWhereTheThingIsInThePictureDuringASmoothMove) {
  click(at(0.5, -0.25));
  ASSERT_TRUE(selected());
  const osg::ref_ptr<SlowFrames> slow = new SlowFrames(widget_);
  widget_.scene()->root().setCullCallback(slow);
  widget_.setSmoothMoves(true);
  const auto begun = widget_.framesDrawn();
  QTest::keyClick(&widget_, Qt::Key_F);
  auto frames = begun;
  int placed_aside = 0;
  EXPECT_TRUE(waitFor([&] {
    QCoreApplication::processEvents();
    if (widget_.framesDrawn() == frames) {
      return false;
    }
    frames = widget_.framesDrawn();
    const auto pose = widget_.scene()->frames().fixedFromFrame("lidar");
    const glm::dvec3 in_fixed = tf::transformPoint(*pose, selected()->picked.point_in_frame);
    const osg::Vec3d in_eye = osg::Vec3d(in_fixed.x, in_fixed.y, in_fixed.z) * slow->drawn_from.at(frames);
    const auto view = widget_.shownView();
    const double half_height = std::tan(view.vertical_fov_rad / 2.0);
    const double x = 200.0 + 150.0 * in_eye.x() / (-in_eye.z() * half_height);
    const auto& ring = widget_.picks().placed().ring_px;
    if (widget_.isUpToDate() || frames > begun + 4) {
      return true;
    }
    EXPECT_TRUE(ring);
    EXPECT_NEAR(ring ? ring->x : 0.0, x, 1e-6) << frames - begun;
    placed_aside += std::abs(x - 200.0) > 1.0 ? 1 : 0;
    return false;
  }));
  EXPECT_GT(placed_aside, 0) << "the camera was on its way";
  widget_.scene()->root().setCullCallback(nullptr);
}

TEST_F(WidgetPickTest, HoverSaysWhatIsThereAndDrawsNoFrame) {
  auto* const label = widget_.findChild<HoverLabel*>();
  ASSERT_NE(label, nullptr);
  hover(at(0.0, 0.0));
  EXPECT_TRUE(waitFor([&] { return label->thing().startsWith(QStringLiteral("/points  point")); }))
      << label->thing().toStdString();
  const auto frames = widget_.framesDrawn();
  for (int i = 0; i < 20; ++i) {
    hover(at(0.02 * i - 0.2, 0.1));
  }
  EXPECT_EQ(widget_.framesDrawn(), frames);
  hover({3, 3});
  EXPECT_TRUE(waitFor([&] { return label->thing().isEmpty(); }));  // at once, or when the cursor rests
  EXPECT_TRUE(label->isHidden());
}

TEST_F(WidgetPickTest, ClicksWaitForShadersAndAreAnsweredInTheirOrder) {
  QTest::mouseClick(&widget_, Qt::LeftButton, {}, at(-0.5, 0.0).toPoint());
  EXPECT_FALSE(selected()) << "an event makes the shaders of one thing";
  QTest::mouseClick(&widget_, Qt::LeftButton, Qt::ShiftModifier, at(0.5, 0.5).toPoint());
  ASSERT_TRUE(waitFor([&] { return !widget_.picks().measured().empty(); }));
  EXPECT_EQ(widget_.picks().measured().size(), 1U);
  ASSERT_TRUE(selected());
  EXPECT_LT(glm::distance(selected()->picked.point_in_frame, glm::dvec3(0.5, 0.5, 0.0)), 0.2) << "the second one";
  const auto length = scenegraph::measureNow(*widget_.scene(), widget_.picks().measured().front());
  ASSERT_TRUE(length);
  EXPECT_NEAR(length->length_m, std::hypot(1.0, 0.5), 0.4) << "from the first";
  EXPECT_FALSE(widget_.warmPick()) << "there is nothing left to make";
  QTest::mouseClick(&widget_, Qt::LeftButton, {}, at(-0.5, 0.0).toPoint());
  EXPECT_LT(glm::distance(selected()->picked.point_in_frame, glm::dvec3(-0.5, 0.0, 0.0)), 0.2) << "at once";
}

/// A click in a view whose shaders for picking are still to be made, one thing an event.
class WaitingClickTest : public WidgetPickTest {
 protected:
  WaitingClickTest() {
    widget_.scene()->findLayer("tf")->layer->setVisible(true);  // more things than one
    widget_.requestTick();
    settle();
    waitFor([this] { return widget_.isUpToDate(); });
    place_ = at(0.5, -0.25);
    QTest::mouseClick(&widget_, Qt::LeftButton, {}, place_.toPoint());
    EXPECT_TRUE(isWaiting());
  }

  bool isWaiting() { return !selected(); }
  /// It is answered, and with what was there.
  void expectThePointOfTheClick() {
    ASSERT_TRUE(waitFor([this] { return !isWaiting(); }));
    EXPECT_EQ(selected()->topic, "/points");
    EXPECT_LT(glm::distance(selected()->picked.point_in_frame, glm::dvec3(0.5, -0.25, 0.0)), 0.2);
  }

  QPointF place_;
};

TEST_F(WaitingClickTest, IsAnsweredAtTheTimeOfTheClick) {
  const auto frames = widget_.framesDrawn();
  widget_.setTime(TimePoint{5_s});  // the cloud goes on by three metres
  EXPECT_FALSE(widget_.applyTick()) << "put off";
  expectThePointOfTheClick();
  EXPECT_TRUE(waitFor([&] { return widget_.framesDrawn() > frames && widget_.isUpToDate(); })) << "and made up for";
  EXPECT_GT(std::abs(place_.x() - at(0.5, -0.25).x()), 20.0);
}

TEST_F(WaitingClickTest, IsAnsweredFromTheCameraOfTheClick) {
  const auto frames = widget_.framesDrawn();
  QTest::keyClick(&widget_, Qt::Key_PageUp);
  QTest::keyClick(&widget_, Qt::Key_X);
  ASSERT_GT(std::abs(place_.x() - at(0.5, -0.25).x()), 20.0);
  expectThePointOfTheClick();
  EXPECT_TRUE(waitFor([&] { return widget_.framesDrawn() > frames && widget_.isUpToDate(); })) << "and made up for";
}

TEST_F(WaitingClickTest, HoldsNothingOnceItIsDropped) {
  widget_.setTime(TimePoint{5_s});
  EXPECT_FALSE(widget_.applyTick());
  widget_.resize(300, 300);
  EXPECT_TRUE(waitFor([this] { return widget_.isUpToDate() && std::abs(place_.x() - at(0.5, -0.25).x()) > 20.0; }));
  EXPECT_TRUE(isWaiting()) << "it was of another picture";
}

TEST_F(WidgetPickTest, ADragPicksNothing) {
  QTest::mousePress(&widget_, Qt::LeftButton, {}, at(0, 0).toPoint());
  QTest::mouseMove(&widget_, at(0, 0).toPoint() + QPoint(30, 10));
  QTest::mouseRelease(&widget_, Qt::LeftButton, {}, at(0, 0).toPoint() + QPoint(30, 10));
  settle();
  EXPECT_FALSE(selected());
}

TEST_F(WidgetPickTest, ShiftClickMeasuresAndTheLineGoesWithItsFrames) {
  click(at(-0.5, 0.0));
  ASSERT_TRUE(selected());
  const glm::dvec3 from = selected()->picked.point_in_frame;
  click(at(0.5, 0.5), Qt::ShiftModifier);
  ASSERT_TRUE(selected());
  const glm::dvec3 to = selected()->picked.point_in_frame;
  ASSERT_EQ(widget_.picks().measured().size(), 1U);
  const auto length = scenegraph::measureNow(*widget_.scene(), widget_.picks().measured().front());
  ASSERT_TRUE(length);
  EXPECT_NEAR(length->length_m, glm::distance(from, to), 1e-9);
  EXPECT_NEAR(length->delta_in_fixed.x, to.x - from.x, 1e-9);
  ASSERT_EQ(widget_.picks().placed().lines.size(), 1U);
  const auto before = widget_.picks().placed().lines.front();
  widget_.setTime(TimePoint{3_s});  // base_link goes on by a metre
  settle();
  ASSERT_EQ(widget_.picks().placed().lines.size(), 1U);
  EXPECT_NE(widget_.picks().placed().lines.front(), before);
  click({3, 3}, Qt::ShiftModifier);
  EXPECT_EQ(widget_.picks().measured().size(), 1U) << "nothing to measure to";
  QTest::keyClick(&widget_, Qt::Key_Delete);
  EXPECT_TRUE(widget_.picks().measured().empty());
  EXPECT_FALSE(selected());
  settle();
  EXPECT_TRUE(widget_.picks().placed().lines.empty());
}

TEST_F(WidgetPickTest, OutsideCollapsedAndGoneAreNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const QPointF place : {QPointF(-5, 10), QPointF(10, 1e9), QPointF(-1e300, 1e300), QPointF(nan, 1.0)}) {
    EXPECT_EQ(widget_.pick(place).error(), PickError::NothingThere);
  }
  const QPointF place = at(0, 0);
  ASSERT_TRUE(widget_.pick(place));
  widget_.scene()->removeLayer("/points");  // between hover and click
  EXPECT_FALSE(widget_.pick(place));
  click(place);
  EXPECT_FALSE(selected());
  ASSERT_TRUE(widget_.scene()->addLayer("/points"));
  widget_.requestTick();
  settle();
  EXPECT_TRUE(widget_.pick(place));
  widget_.resize(0, 0);
  settle();
  EXPECT_FALSE(widget_.pick({0, 0}));
  widget_.resize(400, 300);
  settle();
  widget_.setDataset(nullptr, *executor_);
  EXPECT_FALSE(widget_.pick(place));
  settle();
}

TEST_F(WidgetPickTest, PanelTellsThePlaceInANewDisplayFrameAtOnce) {
  InspectPanel panel;
  panel.setView(&widget_);
  click(at(-0.5, 0.0));
  click(at(0.5, 0.5), Qt::ShiftModifier);
  ASSERT_FALSE(panel.copyText().contains(QStringLiteral("in base_link\t")));
  widget_.setDisplayFrame("base_link");
  settle();
  EXPECT_TRUE(panel.copyText().contains(QStringLiteral("in base_link\t"))) << "while the time stands still";
  EXPECT_EQ(panel.measurements().headerItem()->text(0), QStringLiteral("Distance in map"));
  widget_.setFixedFrame("base_link");
  settle();
  EXPECT_EQ(panel.measurements().headerItem()->text(0), QStringLiteral("Distance in base_link"));
}

TEST_F(WidgetPickTest, PanelShowsCopiesAndRemoves) {
  InspectPanel panel;
  panel.setView(&widget_);
  EXPECT_EQ(panel.rows().topLevelItemCount(), 0);
  click(at(-0.5, 0.0));
  ASSERT_GT(panel.rows().topLevelItemCount(), 4);
  const QString all = panel.copyText();
  EXPECT_TRUE(all.contains(QStringLiteral("topic\t/points"))) << all.toStdString();
  EXPECT_TRUE(all.contains(QStringLiteral("in lidar\t")));
  EXPECT_TRUE(all.contains(QStringLiteral("in map\t")));
  panel.rows().topLevelItem(0)->setSelected(true);
  panel.findChild<QToolButton*>(QStringLiteral("copyPick"))->click();
  EXPECT_EQ(QApplication::clipboard()->text(), QStringLiteral("topic\t/points"));
  const QString before = panel.copyText();
  widget_.setTime(TimePoint{5_s});
  settle();
  EXPECT_EQ(panel.copyText(), before) << "what is chosen stays chosen";
  panel.rows().clearSelection();
  EXPECT_NE(panel.copyText(), all) << "the position in the map is that of now";

  widget_.setTime(TimePoint{2_s});
  settle();
  click(at(0.5, 0.5), Qt::ShiftModifier);
  ASSERT_EQ(panel.measurements().topLevelItemCount(), 1);
  panel.measurements().topLevelItem(0)->setSelected(true);
  QTest::keyClick(&panel.measurements(), Qt::Key_C, Qt::ControlModifier);
  const QStringList parts = QApplication::clipboard()->text().split(QLatin1Char('\t'));
  ASSERT_EQ(parts.size(), 10) << "the measurement alone, with its components and ends";
  EXPECT_EQ(parts[0], QStringLiteral("distance"));
  EXPECT_EQ(parts[7].toDouble(),
            scenegraph::measureNow(*widget_.scene(), widget_.picks().measured()[0])->delta_in_fixed.z)
      << "with all its digits";
  panel.rows().topLevelItem(1)->setSelected(true);  // and the distance no more
  QTest::keyClick(&panel.rows(), Qt::Key_C, Qt::ControlModifier);
  EXPECT_EQ(QApplication::clipboard()->text(),
            panel.rows().topLevelItem(1)->text(0) + QLatin1Char('\t') + panel.rows().topLevelItem(1)->text(1));
  panel.rows().clearSelection();
  panel.findChild<QToolButton*>(QStringLiteral("removeMeasurement"))->click();
  EXPECT_EQ(panel.measurements().topLevelItemCount(), 0);
  EXPECT_TRUE(widget_.picks().measured().empty());
  panel.setView(nullptr);
  EXPECT_EQ(panel.rows().topLevelItemCount(), 0);
}

}  // namespace
}  // namespace stillframe::viewer
