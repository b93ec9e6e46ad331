// Views side by side, in windows of their own, dragged, saved and restored.
#include "viewer/window/view_set.h"

#include <gtest/gtest.h>

#include <QDragEnterEvent>
#include <QDragMoveEvent>
#include <QDropEvent>
#include <QMimeData>
#include <QRubberBand>
#include <QSplitter>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <fstream>
#include <sstream>

#include "tests/viewer/open_window.h"
#include "tests/viewer/viewer_support.h"
#include "viewer/layers/legend_overlay.h"
#include "viewer/pick/inspect_dock.h"
#include "viewer/pick/view_picks.h"
#include "viewer/time/time_bar.h"
#include "viewer/window/message_bar.h"
#include "viewer/window/view_window.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using test::settle;
using test::waitFor;
using tf::TimePoint;

class ViewSetTest : public test::OpenWindowTest {
 protected:
  void SetUp() override { open({.files = {"robot.mcap"}, .time = "+3"}); }
  void open(InspectorOptions options) {
    options.width = 1000;  // small pictures: OpenGL is software here
    options.height = 640;
    OpenWindowTest::open(std::move(options));
  }
  ViewSet& set() { return window_->viewSet(); }
  const std::vector<ViewPanel*>& views() { return window_->views(); }
  static void click(ViewPanel& panel, const char* button) {
    QTest::mouseClick(panel.findChild<QToolButton*>(QString::fromLatin1(button)), Qt::LeftButton);
    settle();
  }
  static ViewArea& areaOf(ViewPanel& panel) {
    QWidget* widget = panel.parentWidget();
    while (qobject_cast<ViewArea*>(widget) == nullptr) {
      widget = widget->parentWidget();
    }
    return *qobject_cast<ViewArea*>(widget);
  }
  /// Lets go of `dragged` at a place of `target`, 0..1 from its left upper corner. Returns whether it was taken.
  static bool drop(const QByteArray& dragged, ViewPanel& target, double x, double y) {
    ViewArea& area = areaOf(target);
    QMimeData data;
    data.setData(QString::fromLatin1(ViewArea::kMimeType), dragged);
    const QPointF at =
        target.mapTo(&area, QPoint(static_cast<int>(x * target.width()), static_cast<int>(y * target.height())));
    QDragEnterEvent enter(at.toPoint(), Qt::MoveAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&area, &enter);  // Qt sends the others to whoever takes this one
    QDragMoveEvent move(at.toPoint(), Qt::MoveAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&area, &move);
    EXPECT_EQ(area.findChild<QRubberBand*>()->isVisible(), enter.isAccepted());
    QDropEvent event(at, Qt::MoveAction, &data, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(&area, &event);
    EXPECT_FALSE(area.findChild<QRubberBand*>()->isVisible());
    settle();
    return enter.isAccepted() && event.isAccepted();
  }
  bool isDrawn(ViewPanel& panel) {
    const auto before = panel.view().framesDrawn();
    panel.view().update();
    return waitFor([&] { return panel.view().framesDrawn() > before; }) &&
           test::drawnPixels(panel.view().grabFramebuffer()) > 300;
  }
};

TEST_F(ViewSetTest, ButtonsSplitAViewBothWays) {
  click(*views()[0], "splitRight");
  click(*views()[1], "splitBelow");
  ASSERT_EQ(views().size(), 3U);
  const auto place = window_->layout().windows.at(0).place;
  ASSERT_EQ(place.children.size(), 2U);
  EXPECT_FALSE(place.is_vertical);
  EXPECT_TRUE(place.children[0].view);
  EXPECT_TRUE(place.children[1].is_vertical);
  EXPECT_EQ(place.children[1].children.size(), 2U);
  for (ViewPanel* const panel : views()) {
    EXPECT_TRUE(isDrawn(*panel));
  }
}

TEST_F(ViewSetTest, AViewAndItsCopyHavePicturesOfOneSize) {
  window_->resize(1280, 640);
  settle();
  ASSERT_GT(views()[0]->panelsWidth(), 100);
  click(*views()[0], "splitRight");
  ASSERT_EQ(views()[1]->panelsWidth(), 0);
  EXPECT_NEAR(views()[0]->view().width(), views()[1]->view().width(), 2) << "its layers take none of its half";
  click(*views()[1], "splitBelow");
  EXPECT_NEAR(views()[1]->view().height(), views()[2]->view().height(), 2);
}

TEST_F(ViewSetTest, ClosingLeavesNoEmptySplitter) {
  click(*views()[0], "splitRight");
  click(*views()[1], "splitBelow");
  click(*views()[2], "close");
  click(*views()[0], "close");
  ASSERT_EQ(views().size(), 1U);
  EXPECT_TRUE(window_->layout().windows.at(0).place.view);
  EXPECT_EQ(areaOf(*views()[0]).findChildren<QSplitter*>(QString(), Qt::FindDirectChildrenOnly).size(), 1);
  EXPECT_TRUE(isDrawn(*views()[0]));
  click(*views()[0], "close");
  EXPECT_EQ(views().size(), 1U) << "the last view stays";
}

TEST_F(ViewSetTest, DetachedViewGoesOnInAWindowOfItsOwn) {
  click(*views()[0], "detach");
  EXPECT_TRUE(set().windows().empty()) << "the only view stays in the window";
  click(*views()[0], "splitRight");
  ViewPanel& panel = *views()[1];
  panel.view().setFixedFrame("odom");
  auto state = panel.view().camera().state();
  state.camera.orbit.radius_m = 4.5;
  panel.view().setViewpoint(state);
  click(panel, "detach");
  ASSERT_EQ(set().windows().size(), 1U);
  EXPECT_EQ(panel.window(), set().windows()[0]);
  ASSERT_TRUE(QTest::qWaitForWindowExposed(panel.window()));
  EXPECT_DOUBLE_EQ(panel.view().camera().sight().radius_m, 4.5);
  EXPECT_EQ(panel.view().scene()->fixedFrame(), "odom");
  EXPECT_TRUE(isDrawn(panel)) << "in another context";
  window_->timeBar().setTime(TimePoint{5_s});
  settle();
  EXPECT_EQ(panel.view().scene()->time(), TimePoint{5_s});
  panel.window()->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(panel.window()));
  panel.view().setFocus();
  QTest::keyClick(&panel.view(), Qt::Key_Right);
  EXPECT_EQ(window_->timeBar().time(), TimePoint{6_s}) << "keys work there too";
}

TEST_F(ViewSetTest, ClosingAWindowClosesItsViews) {
  click(*views()[0], "splitRight");
  click(*views()[1], "detach");
  set().windows()[0]->close();
  settle();
  EXPECT_EQ(views().size(), 1U);
  EXPECT_TRUE(set().windows().empty());
}

TEST_F(ViewSetTest, ViewIsDraggedToEachSideOfAnother) {
  click(*views()[0], "splitRight");
  ViewPanel& fixed = *views()[0];
  ViewPanel& dragged = *views()[1];
  const struct {
    double x;
    double y;
    bool is_vertical;
    std::size_t index;
  } cases[] = {{0.1, 0.5, false, 0}, {0.9, 0.5, false, 1}, {0.5, 0.1, true, 0}, {0.5, 0.95, true, 1}};
  for (const auto& [x, y, is_vertical, index] : cases) {
    EXPECT_TRUE(drop(ViewArea::token(dragged), fixed, x, y));
    EXPECT_EQ(window_->layout().windows.at(0).place.is_vertical, is_vertical);
    EXPECT_EQ(areaOf(fixed).panels().at(index), &dragged);
    EXPECT_TRUE(isDrawn(dragged));
  }
}

TEST_F(ViewSetTest, ViewIsDraggedBetweenWindows) {
  click(*views()[0], "splitRight");
  click(*views()[1], "splitRight");
  ViewPanel& away = *views()[2];
  click(away, "detach");
  ViewPanel& dragged = *views()[1];
  EXPECT_TRUE(drop(ViewArea::token(dragged), away, 0.5, 0.9));
  EXPECT_EQ(dragged.window(), away.window());
  EXPECT_TRUE(isDrawn(dragged));
  drop(ViewArea::token(*views()[0]), away, 0.5, 0.9);
  EXPECT_EQ(views()[0]->window(), window_.get()) << "the main window keeps its last view";
  EXPECT_TRUE(drop(ViewArea::token(dragged), *views()[0], 0.1, 0.5));
  EXPECT_TRUE(drop(ViewArea::token(away), *views()[0], 0.1, 0.5));
  EXPECT_TRUE(set().windows().empty()) << "the window goes with its last view";
  EXPECT_TRUE(isDrawn(away));
  EXPECT_TRUE(QTest::qWaitForWindowActive(window_.get())) << "keys would go nowhere";
  EXPECT_EQ(&set().active(), &away);
  EXPECT_TRUE(away.view().hasFocus());
}

TEST_F(ViewSetTest, DropsOfOthersAreRefused) {
  click(*views()[0], "splitRight");
  EXPECT_FALSE(drop("1:12345", *views()[0], 0.1, 0.5)) << "a view of another process";
  EXPECT_FALSE(drop("", *views()[0], 0.1, 0.5));
  const auto order = areaOf(*views()[0]).panels();
  drop(QByteArray::number(QCoreApplication::applicationPid()) + ":12345", *views()[0], 0.1, 0.5);
  drop(ViewArea::token(*views()[0]), *views()[0], 0.1, 0.5);
  EXPECT_EQ(areaOf(*views()[0]).panels(), order) << "no such view; upon itself";
}

std::string textOf(const QString& file) {
  std::ostringstream text;
  text << std::ifstream(file.toStdString()).rdbuf();
  return text.str();
}

class LayoutFileTest : public ViewSetTest {
 protected:
  void SetUp() override {
    ViewSetTest::SetUp();
    click(*views()[0], "splitRight");
    click(*views()[1], "splitBelow");
    click(*views()[2], "splitRight");
    click(*views()[3], "detach");
    views()[0]->view().setFixedFrame("odom");
    auto state = views()[1]->view().camera().state();
    state.camera.orbit.radius_m = 3.5;
    views()[1]->view().setViewpoint(state);
    scenegraph::ViewEffects effects;
    effects.setOn("edl", true);
    views()[2]->setEffects(effects);
    views()[3]->view().scene()->findLayer("grid")->layer->setVisible(false);
    settle();
    ASSERT_TRUE(window_->saveLayout(file_.toStdString()));
    for (ViewPanel* const panel : views()) {
      panel->view().requestTick();
    }
    settle();
    pictures_ = pictures();
  }
  std::vector<QImage> pictures() {
    std::vector<QImage> all;
    for (ViewPanel* const panel : views()) {
      EXPECT_TRUE(isDrawn(*panel));
      all.push_back(panel->view().grabFramebuffer());
    }
    return all;
  }
  void expectRestored() {
    complete();
    ASSERT_EQ(views().size(), 4U);
    EXPECT_EQ(set().windows().size(), 1U);
    EXPECT_EQ(pictures(), pictures_);
    const QString again = folder_.filePath(QStringLiteral("again.xml"));
    ASSERT_TRUE(window_->saveLayout(again.toStdString()));
    EXPECT_EQ(textOf(again), textOf(file_));
    EXPECT_EQ(window_->messageBar().text(), QString());
  }

  QTemporaryDir folder_;
  QString file_ = folder_.filePath(QStringLiteral("layout.xml"));
  std::vector<QImage> pictures_;
};

TEST_F(LayoutFileTest, NewWindowIsTheSavedOneToThePixelAndToTheByte) {
  const auto layout = scenegraph::readLayout(file_.toStdString());
  ASSERT_TRUE(layout);
  open({.files = {"robot.mcap"}, .time = "+3", .layout = *layout});
  expectRestored();
}

TEST_F(LayoutFileTest, WindowOfTheSavedActiveViewIsTheActiveOne) {
  auto layout = scenegraph::readLayout(file_.toStdString());
  ASSERT_TRUE(layout);
  layout->active_view = 4;  // in the window of its own
  open({.files = {"robot.mcap"}, .time = "+3", .layout = *layout});
  EXPECT_TRUE(QTest::qWaitForWindowActive(set().windows()[0]));
  EXPECT_EQ(&set().active(), views()[3]);
  EXPECT_TRUE(window_->testAttribute(Qt::WA_ShowWithoutActivating)) << "a window manager would activate it";
  layout->active_view = 2;
  window_->restore(*layout);
  EXPECT_TRUE(QTest::qWaitForWindowActive(window_.get()));
  EXPECT_EQ(&set().active(), views()[1]);
  EXPECT_TRUE(views()[1]->view().hasFocus());
  EXPECT_TRUE(set().windows()[0]->testAttribute(Qt::WA_ShowWithoutActivating));
}

TEST_F(LayoutFileTest, OpenedLayoutReplacesTheViewsOfAWindow) {
  open({.files = {"robot.mcap"}, .time = "+3", .views = 2});
  ASSERT_TRUE(window_->openLayout(file_.toStdString()));
  expectRestored();
}

TEST_F(LayoutFileTest, WhatSeveralViewsMissIsOneLine) {
  auto layout = scenegraph::readLayout(file_.toStdString()).value();
  for (const std::size_t i : {0U, 1U, 2U, 3U, 1U, 3U}) {
    auto& layers = scenegraph::viewsOf(layout)[i]->layers.layers;
    layers.push_back({.id = layers.back().id == "/all" ? "/some" : "/all", .title = {}, .settings = {}});
  }
  open({.files = {"robot.mcap"}, .time = "+3", .layout = layout});
  EXPECT_TRUE(window_->messageBar().text().startsWith(QStringLiteral("there is no topic '/all'")));
  EXPECT_TRUE(window_->messageBar().text().contains(QStringLiteral("\nviews 2, 4: there is no topic '/some'")));
}

TEST_F(LayoutFileTest, WindowsComeBackToTheirPlacesWhileAScreenShowsThem) {
  window_->move(120, 90);
  set().windows()[0]->move(333, 222);
  settle();
  const scenegraph::Layout layout = window_->layout();
  ASSERT_EQ(layout.windows[0].corner, std::pair(120, 90));
  ASSERT_EQ(layout.windows[1].corner, std::pair(333, 222));
  open({.files = {"robot.mcap"}, .time = "+3", .layout = layout});
  EXPECT_EQ(window_->pos(), QPoint(120, 90));
  EXPECT_EQ(set().windows()[0]->pos(), QPoint(333, 222));
  scenegraph::Layout elsewhere = layout;
  elsewhere.windows[0].corner = {-5000, 90};
  elsewhere.windows[1].corner = {100, 100'000};
  window_->restore(elsewhere);
  settle();
  EXPECT_EQ(window_->pos(), QPoint(120, 90)) << "where no screen is, nobody finds it";
  EXPECT_LT(set().windows()[0]->pos().y(), 1200);
}

TEST_F(LayoutFileTest, PicksMeasurementsAndLegendsComeBack) {
  ViewPanel& panel = *views()[1];
  scenegraph::PickResult pick{
      .topic = "/points", .layer = "Point cloud", .frame = "lidar", .picked = {}, .fixed_frame = "map", .time = {}};
  pick.picked.kind = "point";
  pick.picked.id = "7";
  panel.view().picks().select(pick);
  pick.frame = "base_link";
  panel.view().picks().measureTo(pick);
  panel.setLegendShown(false);
  activate();
  panel.view().setFocus();
  settle();
  EXPECT_EQ(&set().active(), &panel);
  const scenegraph::PickMarks marks = panel.view().picks().marks();
  ASSERT_TRUE(window_->saveLayout(file_.toStdString()));
  open({.files = {"robot.mcap"}, .time = "+3", .layout = scenegraph::readLayout(file_.toStdString()).value()});
  activate();
  settle();
  SceneWidget& view = views()[1]->view();
  EXPECT_EQ(view.picks().marks(), marks);
  EXPECT_EQ(&set().active(), views()[1]) << "what the panels at the side tell of";
  ASSERT_EQ(view.picks().placed().lines.size(), 1U);
  EXPECT_EQ(view.picks().placed().lines[0].text, "1 m  (dx 0, dy 0, dz -1)");
  ASSERT_TRUE(view.selection());
  EXPECT_EQ(view.selection()->frame, "base_link") << "F frames it";
  EXPECT_FALSE(views()[1]->legend().isEnabledByUser());
  EXPECT_TRUE(views()[0]->legend().isEnabledByUser());
  EXPECT_FALSE(window_->inspect().isHidden()) << "as it was saved";
  EXPECT_EQ(window_->messageBar().text(), QString());
  const QString again = folder_.filePath(QStringLiteral("again.xml"));
  ASSERT_TRUE(window_->saveLayout(again.toStdString()));
  EXPECT_EQ(textOf(again), textOf(file_));
}

TEST_F(LayoutFileTest, PicksInAFrameThatIsNotThereAreTold) {
  auto layout = scenegraph::readLayout(file_.toStdString()).value();
  scenegraph::PickResult pick{
      .topic = "/radar", .layer = {}, .frame = "radar", .picked = {}, .fixed_frame = "map", .time = {}};
  scenegraph::viewsOf(layout)[1]->picks.selected = pick;
  open({.files = {"robot.mcap"}, .time = "+3", .layout = layout});
  EXPECT_TRUE(window_->messageBar().text().contains(QStringLiteral("'radar'")))
      << window_->messageBar().text().toStdString();
  EXPECT_TRUE(views()[1]->view().picks().placed().isEmpty());
  EXPECT_EQ(window_->layout().windows.size(), 2U);
  EXPECT_EQ(scenegraph::viewsOf(std::as_const(layout))[1]->picks.selected, pick) << "and kept";
}

TEST_F(LayoutFileTest, BrokenLayoutChangesNothing) {
  const QString broken = folder_.filePath(QStringLiteral("broken.xml"));
  std::ofstream(broken.toStdString()) << textOf(file_).substr(0, 2000);
  EXPECT_FALSE(window_->openLayout(broken.toStdString()));
  EXPECT_FALSE(window_->messageBar().text().isEmpty());
  window_->messageBar().hide();
  expectRestored();
}

TEST_F(LayoutFileTest, UnwritablePlaceIsToldAndTheWindowStays) {
  EXPECT_FALSE(window_->saveLayout("/nonexistent/layout.xml"));
  EXPECT_TRUE(window_->messageBar().text().contains(QStringLiteral("/nonexistent/layout.xml")));
}

TEST_F(LayoutFileTest, WhatTheRecordingDoesNotHaveIsTold) {
  auto layout = scenegraph::readLayout(file_.toStdString());
  ASSERT_TRUE(layout);
  layout->windows[1].place.view->layers.layers.push_back({.id = "/radar", .title = {}, .settings = {}});
  open({.files = {"robot.mcap"}, .time = "+3", .layout = *layout});
  EXPECT_TRUE(window_->messageBar().text().contains(QStringLiteral("/radar")))
      << window_->messageBar().text().toStdString();
  EXPECT_TRUE(window_->messageBar().text().startsWith(QStringLiteral("view 4: ")));
}

TEST_F(LayoutFileTest, OptionsGoBeforeTheLayout) {
  const auto layout = scenegraph::readLayout(file_.toStdString());
  open({.files = {"robot.mcap"}, .fixed_frame = "base_link", .camera = scenegraph::CameraKind::Fly, .layout = *layout});
  for (ViewPanel* const panel : views()) {
    EXPECT_EQ(panel->view().scene()->fixedFrame(), "base_link");
    EXPECT_EQ(panel->view().camera().rig().kind(), scenegraph::CameraKind::Fly);
  }
}

}  // namespace
}  // namespace stillframe::viewer
