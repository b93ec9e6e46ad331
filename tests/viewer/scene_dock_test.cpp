#include "viewer/dock/scene_dock.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QDomDocument>
#include <QSignalSpy>
#include <QTest>

#include "tests/viewer/viewer_support.h"
#include "viewer/view/view_panel.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using scenegraph::FollowMode;
using test::settle;
using test::waitFor;
using tf::TimePoint;

class SceneDockTest : public testing::Test {
 protected:
  std::unique_ptr<SceneDock> makeDock(const std::shared_ptr<scenegraph::Dataset>& dataset) {
    auto dock = std::make_unique<SceneDock>(context_);
    dock->resize(640, 400);
    if (dataset != nullptr) {
      dock->setDatasets({dataset});
      dock->setTime(TimePoint{3_s});
    }
    dock->show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(dock.get()));
    settle();
    return dock;
  }
  /// Everything as it is not at first.
  static void change(SceneDock& dock) {
    SceneWidget& view = dock.panel().view();
    view.setFixedFrame("odom");
    scenegraph::ViewEffects effects;
    effects.setOn("edl", true);
    dock.panel().setEffects(effects);
    view.applyTick();
    view.setDisplayFrame("base_link");
    view.setFollow(FollowMode::Position);
    auto viewpoint = view.camera().state();
    viewpoint.camera.orbit.radius_m = 7.125;
    view.setViewpoint(viewpoint);
    view.saveView(QStringLiteral("near"));
    view.setCameraKind(scenegraph::CameraKind::TopDownOrtho);
    view.scene()->findLayer("grid")->layer->setVisible(false);
    ASSERT_TRUE(view.scene()->findLayer("/points")->layer->applySettings({{"point_size", "5"}}));
    view.requestTick();
    settle();
  }
  static QString saved(const SceneDock& dock) {
    QDomDocument document;
    document.appendChild(dock.saveState(document));
    return document.toString();
  }
  static QDomElement read(QDomDocument& document, const QString& text) {
    EXPECT_TRUE(document.setContent(text));
    return document.documentElement();
  }
  static bool restore(SceneDock& dock, const QString& text) {
    QDomDocument document;
    return dock.restoreState(read(document, text));
  }
  static QImage pictureOf(SceneDock& dock) {
    EXPECT_TRUE(waitFor([&] { return !dock.panel().view().scene()->isPending(); }));
    settle();
    return dock.panel().view().grabFramebuffer();
  }

  DockContext context_{1};
  std::shared_ptr<scenegraph::Dataset> robot_ = test::makeRobotDataset();
};

TEST_F(SceneDockTest, RestoredDockIsTheSavedOneToThePixelAndToTheByte) {
  const auto first = makeDock(robot_);
  change(*first);
  const QString text = saved(*first);
  const auto second = makeDock(robot_);
  EXPECT_NE(pictureOf(*second), pictureOf(*first));
  ASSERT_TRUE(restore(*second, text));
  settle();
  EXPECT_EQ(saved(*second), text);
  EXPECT_EQ(pictureOf(*second), pictureOf(*first));
  EXPECT_EQ(second->message(), QString());
  EXPECT_EQ(second->panel().view().savedViews().size(), 1U);
  EXPECT_GT(test::drawnPixels(pictureOf(*second)), 100);
}

TEST_F(SceneDockTest, CommentsOfTheHostsLayoutSurvive) {
  const auto first = makeDock(robot_);
  QString text = saved(*first);
  text.replace(QStringLiteral("<Camera"), QStringLiteral("<!-- from above --><Camera"));
  const auto second = makeDock(robot_);
  ASSERT_TRUE(restore(*second, text));
  const QString once = saved(*second);
  EXPECT_TRUE(once.contains(QStringLiteral("<!-- from above -->")));
  EXPECT_LT(once.indexOf(QStringLiteral("<!-- from above -->")), once.indexOf(QStringLiteral("<Camera")));
  ASSERT_TRUE(restore(*first, once));
  EXPECT_EQ(saved(*first), once);
}

TEST_F(SceneDockTest, LayoutRestoredBeforeTheDataIsKeptAndTakenUp) {
  const auto first = makeDock(robot_);
  change(*first);
  const QString text = saved(*first);
  const auto second = makeDock(nullptr);
  ASSERT_TRUE(restore(*second, text));
  EXPECT_EQ(saved(*second), text) << "a host may save before it has loaded anything";
  second->setDatasets({robot_});
  second->setTime(TimePoint{3_s});
  settle();
  EXPECT_EQ(saved(*second), text);
  EXPECT_EQ(pictureOf(*second), pictureOf(*first));
}

TEST_F(SceneDockTest, DatasetThatGoesAndComesLeavesTheView) {
  const auto dock = makeDock(robot_);
  change(*dock);
  const QString text = saved(*dock);
  dock->setDatasets({});
  EXPECT_EQ(saved(*dock), text);
  dock->setDatasets({test::makeRobotDataset()});
  settle();
  EXPECT_EQ(saved(*dock), text);
}

TEST_F(SceneDockTest, FollowTargetThatIsAbsentStaysInertUntilItAppears) {
  test::DatasetBuilder builder;
  builder.topic("/tf", scenegraph::ObjectType::FrameTransforms).transform(0, "map", "odom");
  const auto dataset = builder.build();
  const auto dock = makeDock(dataset);
  auto viewpoint = dock->panel().view().camera().state();
  viewpoint.display_frame = "drone";
  viewpoint.follow.mode = FollowMode::Position;
  scenegraph::ViewLayout layout = dock->panel().layout();
  layout.viewpoint = viewpoint;
  layout.is_camera_touched = true;
  dock->panel().restore(layout);
  settle();
  SceneWidget& view = dock->panel().view();
  EXPECT_EQ(view.camera().follow().mode(), FollowMode::Position);
  EXPECT_EQ(view.camera().follow().fixedFromCamera().translation, glm::dvec3(0.0));
  const auto before = view.shownView().eye_from_fixed;

  builder.transform(1_s, "map", "drone", test::translate(5, 0, 0))
      .transform(2_s, "map", "drone", test::translate(9, 0, 0));
  dataset->takeTransforms();
  dock->takeGrowth();
  dock->setTime(TimePoint{1_s});
  settle();
  EXPECT_NE(view.shownView().eye_from_fixed, before);
  const double x = view.camera().follow().fixedFromCamera().translation.x;
  dock->setTime(TimePoint{2_s});
  settle();
  EXPECT_DOUBLE_EQ(view.camera().follow().fixedFromCamera().translation.x - x, 4.0);
}

TEST_F(SceneDockTest, LayoutOfAnotherRecordingAppliesWhatItCanAndSaysWhatNot) {
  const auto dock = makeDock(robot_);
  const QString text = QStringLiteral(
      "<Scene3DDock version='1' fixed_frame='world' mood='blue'><Follow display_frame='drone' mode='pose'/>"
      "<Effects edl='true' glow='true'/><Layer id='/points' visible='false'><Setting key='sparkle' value='1'/></Layer>"
      "<Layer id='/radar'><Setting key='gain' value='2'/></Layer><Plot curve='speed'/></Scene3DDock>");
  ASSERT_TRUE(restore(*dock, text));
  SceneWidget& view = dock->panel().view();
  EXPECT_TRUE(view.effects().isOn("edl"));
  EXPECT_FALSE(view.scene()->findLayer("/points")->layer->isVisible());
  const QStringList lines = dock->message().split(QLatin1Char('\n'));
  EXPECT_EQ(lines.size(), 5) << dock->message().toStdString();
  for (const char* const what : {"glow", "sparkle", "/radar", "world", "drone"}) {
    EXPECT_EQ(lines.filter(QString::fromLatin1(what)).size(), 1) << what;
  }
  const QString again = saved(*dock);
  for (const char* const kept : {"mood=\"blue\"", "glow=\"true\"", "key=\"sparkle\"", "id=\"/radar\"", "key=\"gain\"",
                                 "<Plot curve=\"speed\"/>", "fixed_frame=\"world\"", "display_frame=\"drone\""}) {
    EXPECT_TRUE(again.contains(QString::fromLatin1(kept))) << kept << " in " << again.toStdString();
  }
}

TEST_F(SceneDockTest, LayerWhoseTopicComesLaterIsTakenUpThen) {
  test::DatasetBuilder builder;
  builder.topic("/tf", scenegraph::ObjectType::FrameTransforms).transform(0, "map", "lidar");
  const auto dataset = builder.build();
  const auto dock = makeDock(dataset);
  ASSERT_TRUE(
      restore(*dock, QStringLiteral("<Scene3DDock version='1'><Layer id='/points' visible='false'/></Scene3DDock>")));
  EXPECT_FALSE(dock->message().isEmpty());
  builder.topic("/points", scenegraph::ObjectType::PointCloud)
      .at(1_s, test::CloudBuilder("lidar").xyz().point({1, 2, 3}).build());
  dock->takeGrowth();
  ASSERT_NE(dock->panel().view().scene()->findLayer("/points"), nullptr);
  EXPECT_FALSE(dock->panel().view().scene()->findLayer("/points")->layer->isVisible());
  EXPECT_EQ(dock->message(), QString());
}

TEST_F(SceneDockTest, HostileLayoutIsRefusedAndNothingIsLost) {
  const auto dock = makeDock(robot_);
  change(*dock);
  const QString text = saved(*dock);
  QString deep = QStringLiteral("<Scene3DDock version='1'>");
  for (int i = 0; i < 200; ++i) {
    deep += QStringLiteral("<a>");
  }
  for (int i = 0; i < 200; ++i) {
    deep += QStringLiteral("</a>");
  }
  for (const QString& hostile :
       {QStringLiteral("<Scene3DDock version='2'/>"), QStringLiteral("<OtherDock version='1'/>"),
        QStringLiteral("<Scene3DDock version='1'><Camera fly.eye_x='1e400'/></Scene3DDock>"),
        QStringLiteral("<Scene3DDock version='1' fixed_frame='x'><Follow base_from_camera.x='nan'/></Scene3DDock>"),
        deep + QStringLiteral("</Scene3DDock>")}) {
    EXPECT_FALSE(restore(*dock, hostile)) << hostile.left(80).toStdString();
    EXPECT_EQ(saved(*dock), text);
    EXPECT_FALSE(dock->message().isEmpty() || dock->message().contains(QLatin1Char('\n')));
  }
}

TEST_F(SceneDockTest, KeysInTheViewAskForTimeAndPlay) {
  const auto dock = makeDock(robot_);
  const QSignalSpy seeks(dock.get(), &SceneDock::seekRequested);
  const QSignalSpy plays(dock.get(), &SceneDock::playRequested);
  dock->activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(dock.get()));
  dock->panel().view().setFocus();
  QTest::keyClick(&dock->panel().view(), Qt::Key_Right);
  QTest::keyClick(&dock->panel().view(), Qt::Key_Left);
  QTest::keyClick(&dock->panel().view(), Qt::Key_Space);
  ASSERT_EQ(seeks.size(), 2);
  EXPECT_EQ(seeks[0][0].value<TimePoint>(), TimePoint{4_s});
  EXPECT_EQ(seeks[1][0].value<TimePoint>(), TimePoint{2_s}) << "the host has not gone there";
  EXPECT_EQ(plays.size(), 1);
  EXPECT_EQ(dock->panel().view().time(), TimePoint{3_s}) << "time is the host's";
}

TEST_F(SceneDockTest, ClickTellsTheHostWhatIsThere) {
  const auto dock = makeDock(robot_);
  SceneWidget& view = dock->panel().view();
  ASSERT_TRUE(view.scene()->findLayer("/points")->layer->applySettings({{"point_size", "40"}}));
  view.frameAll();
  ASSERT_TRUE(waitFor([&] { return !view.scene()->isPending() && !view.applyTick(); }));
  settle();
  const QSignalSpy picks(dock.get(), &SceneDock::picked);
  for (int y = 4; y < view.height() && picks.isEmpty(); y += 16) {
    for (int x = 4; x < view.width() && picks.isEmpty(); x += 16) {
      QTest::mouseClick(&view, Qt::LeftButton, {}, {x, y});
    }
  }
  EXPECT_EQ(picks.size(), 1);
}

TEST_F(SceneDockTest, DocksOfOneContextAreIndependent) {
  const auto first = makeDock(robot_);
  const auto second = makeDock(robot_);
  const QString text = saved(*second);
  change(*first);
  second->setTime(TimePoint{1_s});
  settle();
  EXPECT_EQ(saved(*second), text);
  EXPECT_EQ(first->panel().view().scene()->time(), TimePoint{3_s});
}

TEST_F(SceneDockTest, UserChoosesAmongDatasetsAndALayoutNamesOne) {
  const auto other = std::make_shared<scenegraph::Dataset>("other");
  const auto dock = makeDock(nullptr);
  dock->setDatasets({other, robot_});
  EXPECT_EQ(dock->dataset(), other);
  const QSignalSpy chosen(dock.get(), &SceneDock::datasetChosen);
  auto* choice = dock->findChild<QComboBox*>(QStringLiteral("dataset"));
  ASSERT_TRUE(choice->isVisible());
  choice->setFocus();
  QTest::keyClick(choice, Qt::Key_Down);
  EXPECT_EQ(dock->dataset(), robot_);
  EXPECT_EQ(chosen.size(), 1);
  settle();
  const QString text = saved(*dock);
  const auto restored = makeDock(nullptr);
  restored->setDatasets({other, robot_});
  ASSERT_TRUE(restore(*restored, text));
  EXPECT_EQ(restored->dataset(), robot_);
  dock->setDatasets({robot_});
  EXPECT_FALSE(choice->isVisible());
}

}  // namespace
}  // namespace stillframe::viewer
