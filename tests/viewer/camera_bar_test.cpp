#include "viewer/view/camera_bar.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QComboBox>
#include <QLineEdit>
#include <QMenu>
#include <QTest>
#include <QToolButton>
#include <algorithm>

#include "tests/viewer/viewer_support.h"
#include "viewer/frames/frame_picker.h"
#include "viewer/view/view_panel.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using scenegraph::CameraKind;
using scenegraph::FollowMode;
using test::settle;
using tf::TimePoint;

class CameraBarTest : public testing::Test {
 protected:
  CameraBarTest() {
    panel_.resize(900, 500);
    panel_.view().setSmoothMoves(false);
    panel_.setDataset(dataset_, *executor_, {});
    panel_.view().setTime(TimePoint{5_s});
    panel_.show();
    if (!QTest::qWaitForWindowExposed(&panel_)) {
      ADD_FAILURE() << "no window";
    }
    settle();
  }
  CameraBar& bar() { return panel_.cameraBar(); }

  std::shared_ptr<scenegraph::Dataset> dataset_ = test::makeRobotDataset();
  std::unique_ptr<scenegraph::Executor> executor_ = scenegraph::makeSynchronousExecutor();
  ViewPanel panel_;
};

TEST_F(CameraBarTest, ChoosingMovesTheViewAndTheViewsKeysMoveTheChoice) {
  QTest::keyClick(&bar().kinds(), Qt::Key_Down);
  EXPECT_EQ(panel_.view().camera().rig().kind(), CameraKind::XyOrbit);
  QTest::keyClick(&panel_.view(), Qt::Key_4);
  EXPECT_EQ(bar().kinds().currentIndex(), 3);
  QTest::keyClick(&bar().follows(), Qt::Key_End);
  EXPECT_EQ(panel_.view().camera().follow().mode(), FollowMode::Pose);
  QTest::keyClick(&panel_.view(), Qt::Key_T);
  EXPECT_EQ(bar().follows().currentIndex(), 0);
}

TEST_F(CameraBarTest, ANarrowBarSaysThatThereIsMoreInTheThemesColour) {
  auto* const more = bar().findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"));
  ASSERT_NE(more, nullptr) << "Qt's name for it";
  EXPECT_FALSE(more->isVisible());
  panel_.resize(420, 500);
  settle();
  EXPECT_TRUE(more->isVisible());
  EXPECT_FALSE(more->toolTip().isEmpty());
  const QImage sign = more->icon().pixmap(32, 32).toImage();
  int drawn = 0;
  for (int y = 0; y < sign.height(); ++y) {
    for (int x = 0; x < sign.width(); ++x) {
      if (sign.pixelColor(x, y).alphaF() > 0.9F) {
        EXPECT_NEAR(sign.pixelColor(x, y).lightnessF(), QApplication::palette().windowText().color().lightnessF(),
                    0.02);
        ++drawn;
      }
    }
  }
  EXPECT_GT(drawn, 50);
}

TEST_F(CameraBarTest, WhatANarrowBarCutsOffIsInTheMenuOfItsExtension) {
  panel_.resize(420, 500);
  settle();
  auto* const more = bar().findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"));
  ASSERT_NE(more->menu(), nullptr);
  EXPECT_TRUE(more->isEnabled());
  ASSERT_FALSE(bar().follows().isVisible());
  const auto open = [&] { Q_EMIT more->menu()->aboutToShow(); };
  const auto find = [](const QMenu& menu, const QString& text) -> QAction* {
    for (QAction* const action : menu.actions()) {
      if (action->text().remove('&') == text) {
        return action;
      }
    }
    ADD_FAILURE() << text.toStdString();
    return menu.actions().constFirst();
  };
  open();
  ASSERT_NE(find(*more->menu(), QStringLiteral("Follow"))->menu(), nullptr);
  find(*find(*more->menu(), QStringLiteral("Follow"))->menu(), QStringLiteral("Heading"))->trigger();
  EXPECT_EQ(panel_.view().camera().follow().mode(), FollowMode::Heading);
  open();
  EXPECT_TRUE(find(*find(*more->menu(), QStringLiteral("Follow"))->menu(), QStringLiteral("Heading"))->isChecked());
  find(*find(*more->menu(), QStringLiteral("Display frame"))->menu(), QStringLiteral("base_link"))->trigger();
  EXPECT_EQ(panel_.view().camera().displayFrame(), "base_link");
  EXPECT_EQ(find(*more->menu(), QStringLiteral("Views"))->menu(), &bar().views());
}

TEST_F(CameraBarTest, ButtonsThatAreSparedInANarrowViewAreInThatMenuAsWell) {
  panel_.hidePanels();
  settle();
  ASSERT_LE(panel_.minimumSizeHint().width(), 200);
  const auto button = [&](const char* name) { return panel_.findChild<QToolButton*>(QString::fromLatin1(name)); };
  panel_.resize(200, 500);
  settle();
  EXPECT_EQ(panel_.width(), 200);
  EXPECT_FALSE(button("detach")->isVisible());
  EXPECT_TRUE(button("close")->isVisible());
  EXPECT_LE(button("close")->mapTo(&panel_, QPoint(button("close")->width(), 0)).x(), 200);
  int detached = 0;
  QObject::connect(&panel_, &ViewPanel::detachRequested, [&] { ++detached; });
  auto* const more = bar().findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"));
  Q_EMIT more->menu()->aboutToShow();
  const auto entries = more->menu()->actions();
  const auto entry = std::ranges::find(entries, button("detach")->toolTip(), &QAction::text);
  ASSERT_NE(entry, entries.end());
  (*entry)->trigger();
  EXPECT_EQ(detached, 1);
  for (const int width : {400, 210, 400}) {  // and back in turn
    panel_.resize(width, 500);
    settle();
    EXPECT_EQ(button("detach")->isVisible(), width == 400);
    EXPECT_EQ(button("effects")->isVisible(), width == 400);
  }
}

TEST_F(CameraBarTest, TheExtensionOpensWhereTheSavedViewsAloneAreCutOff) {
  auto* const more = bar().findChild<QToolButton*>(QStringLiteral("qt_toolbar_ext_button"));
  auto* const views = bar().findChild<QToolButton*>(QStringLiteral("views"));
  ASSERT_TRUE(views->isVisible());
  for (int width = panel_.width(); views->isVisible() && width > 400; width -= 4) {
    panel_.resize(width, 500);
    settle();
  }
  ASSERT_TRUE(bar().displayFrame().isVisible());
  EXPECT_TRUE(more->isVisible());
  EXPECT_TRUE(more->isEnabled());
}

TEST_F(CameraBarTest, DisplayFrameIsChosenApartFromTheFixedFrame) {
  EXPECT_EQ(bar().displayFrame().currentText(), QStringLiteral("auto (map)"));
  bar().displayFrame().lineEdit()->selectAll();
  QTest::keyClicks(bar().displayFrame().lineEdit(), QStringLiteral("base_link"));
  QTest::keyClick(bar().displayFrame().lineEdit(), Qt::Key_Return);
  EXPECT_EQ(panel_.view().camera().displayFrame(), "base_link");
  EXPECT_EQ(panel_.view().scene()->fixedFrame(), "map");
}

TEST_F(CameraBarTest, ADisplayFrameWithoutAPlaceNowSaysSo) {
  panel_.view().setDisplayFrame("base_link");
  panel_.view().setFollow(FollowMode::Heading);
  settle();
  const FramePicker& picker = bar().displayFrame();
  const QColor usual = picker.lineEdit()->palette().color(QPalette::Text);
  EXPECT_FALSE(picker.toolTip().contains(QStringLiteral("no place")));
  panel_.view().setTime(TimePoint{-1_s});
  settle();
  EXPECT_TRUE(picker.toolTip().contains(QStringLiteral("\"base_link\" has no place")))
      << picker.toolTip().toStdString();
  EXPECT_NE(picker.lineEdit()->palette().color(QPalette::Text), usual);
  panel_.view().setTime(TimePoint{5_s});
  settle();
  EXPECT_FALSE(picker.toolTip().contains(QStringLiteral("no place")));
  EXPECT_EQ(picker.lineEdit()->palette().color(QPalette::Text), usual);
}

TEST_F(CameraBarTest, SavedViewsAreInTheMenu) {
  panel_.view().saveView("over there");
  Q_EMIT bar().views().aboutToShow();
  bool is_listed = false;
  for (const QAction* action : bar().views().actions()) {
    is_listed = is_listed || action->text().startsWith(QStringLiteral("over there"));
  }
  EXPECT_TRUE(is_listed);
}

TEST_F(CameraBarTest, StateOfAViewRoundTripsExactly) {
  panel_.view().setDisplayFrame("base_link");
  panel_.view().setFollow(FollowMode::Heading);
  QTest::keyClick(&panel_.view(), Qt::Key_3);
  QTest::keyClick(&panel_.view(), Qt::Key_Up, Qt::ControlModifier);
  panel_.view().saveView("one");
  panel_.view().setFixedFrame("odom");
  settle();
  const scenegraph::ViewLayout state = panel_.layout();
  ViewPanel other;
  other.resize(500, 400);
  other.setDataset(dataset_, *executor_, {});
  other.view().setTime(TimePoint{5_s});
  other.restore(state);
  other.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&other));
  settle();
  const scenegraph::ViewLayout restored = other.layout();
  EXPECT_EQ(restored.viewpoint, state.viewpoint);
  EXPECT_EQ(restored.saved_views, state.saved_views);
  EXPECT_EQ(restored.fixed_frame, state.fixed_frame);
  EXPECT_EQ(restored.is_camera_touched, state.is_camera_touched);
  EXPECT_FALSE(restored.has_smooth_moves);
  EXPECT_EQ(other.view().shownView().eye_from_fixed, panel_.view().shownView().eye_from_fixed);
}

TEST_F(CameraBarTest, AnUntouchedViewIsRestoredUntouched) {
  panel_.view().setCameraKind(CameraKind::TopDownOrtho);
  settle();
  ViewPanel other;
  other.resize(500, 400);
  other.setDataset(dataset_, *executor_, {});
  other.restore(panel_.layout());
  EXPECT_FALSE(other.view().isCameraTouched());
  EXPECT_EQ(other.view().camera().rig().kind(), CameraKind::TopDownOrtho);
}

}  // namespace
}  // namespace stillframe::viewer
