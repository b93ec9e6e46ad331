// The frames panel beyond its tree: boxes, filter, problems, poses; and the memory of fixed frames.
#include <gtest/gtest.h>

#include <QApplication>
#include <QClipboard>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLabel>
#include <QLineEdit>
#include <QTest>
#include <QToolButton>
#include <QTreeWidget>
#include <cmath>

#include "tests/viewer/open_window.h"
#include "tests/viewer/viewer_support.h"
#include "viewer/frames/frame_memory.h"
#include "viewer/frames/frame_picker.h"
#include "viewer/frames/frame_pose.h"
#include "viewer/frames/frame_tree.h"
#include "viewer/frames/pose_text.h"
#include "viewer/frames/problem_list.h"
#include "viewer/layers/layer_panel.h"
#include "viewer/time/time_bar.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using test::settle;
using test::waitFor;
using tf::TimePoint;

/// Presses the box of a row, where a person would.
void clickBox(QTreeWidget& tree, QTreeWidgetItem& row) {
  const QRect place = tree.visualItemRect(&row);
  QTest::mouseClick(tree.viewport(), Qt::LeftButton, {}, {place.left() + 8, place.center().y()});
}

class FramesPanelTest : public testing::Test {
 protected:
  FramesPanelTest() {
    panel_.resize(420, 600);
    panel_.setDataset(dataset_);
    panel_.setTime(TimePoint{5_s});
    panel_.show();
    if (!QTest::qWaitForWindowExposed(&panel_)) {
      ADD_FAILURE() << "no window";
    }
    panel_.refreshNow();
    QObject::connect(&panel_, &FrameTree::hiddenFramesEdited, &panel_,
                     [this](const FrameTree::Names& hidden) { edited_ = hidden; });
    QObject::connect(&panel_, &FrameTree::framePicked, &panel_, [this](const QString& frame) { picked_ = frame; });
  }
  std::shared_ptr<scenegraph::Dataset> dataset_ = test::makeRobotDataset();
  FrameTree panel_;
  FrameTree::Names edited_;
  QString picked_;
};

TEST_F(FramesPanelTest, ABoxHidesItsFrameAndDoesNotMoveTheCamera) {
  clickBox(panel_.tree(), *panel_.item("lidar"));
  EXPECT_EQ(edited_, FrameTree::Names{"lidar"});
  EXPECT_EQ(picked_, QString());
  clickBox(panel_.tree(), *panel_.item("lidar"));
  EXPECT_TRUE(edited_.empty());
}

TEST_F(FramesPanelTest, RowsStayAsTheyWereLeftWhenFramesCome) {
  panel_.tree().setCurrentItem(panel_.item("odom"));
  panel_.item("base_link")->setExpanded(false);
  ASSERT_TRUE(dataset_->transforms()->insert(
      {.parent = "odom", .child = "camera", .stamp = TimePoint{5_s}, .parent_from_child = {}}));
  panel_.refreshNow();
  ASSERT_NE(panel_.item("camera"), nullptr);
  EXPECT_EQ(panel_.tree().currentItem(), panel_.item("odom"));
  EXPECT_FALSE(panel_.item("base_link")->isExpanded());
  EXPECT_TRUE(panel_.item("odom")->isExpanded());
}

TEST_F(FramesPanelTest, EnterOnAFrameShowsItsPoseToo) {
  panel_.tree().setCurrentItem(panel_.item("lidar"));
  QTest::keyClick(&panel_.tree(), Qt::Key_Return);
  EXPECT_TRUE(panel_.pose().text().contains(QStringLiteral("x 5.0000  y 0.0000  z 1.0000")))
      << panel_.pose().text().toStdString();
}

TEST_F(FramesPanelTest, AClickOnTheNamePicksTheFrameAndShowsItsPose) {
  const QRect place = panel_.tree().visualItemRect(panel_.item("lidar"));
  QTest::mouseClick(panel_.tree().viewport(), Qt::LeftButton, {}, {place.left() + 60, place.center().y()});
  EXPECT_EQ(picked_, QStringLiteral("lidar"));
  EXPECT_TRUE(panel_.pose().text().contains(QStringLiteral("x 5.0000  y 0.0000  z 1.0000")))
      << panel_.pose().text().toStdString();
}

TEST_F(FramesPanelTest, FilterListsWhatMatchesAndWhereItHangs) {
  panel_.filter().setText(QStringLiteral("^base"));
  EXPECT_FALSE(panel_.item("base_link")->isHidden());
  EXPECT_FALSE(panel_.item("odom")->isHidden()) << "it hangs there";
  EXPECT_TRUE(panel_.item("lidar")->isHidden());
  panel_.findChild<QToolButton*>(QStringLiteral("hideListed"))->click();
  EXPECT_EQ(edited_, FrameTree::Names{"base_link"}) << "of those that match";
  panel_.filter().setText(QStringLiteral("(["));
  EXPECT_FALSE(panel_.item("lidar")->isHidden()) << "no regular expression hides nothing";
  EXPECT_FALSE(panel_.filter().toolTip().isEmpty());
  const auto* const refusal = panel_.findChild<QLabel*>(QStringLiteral("filterRefusal"));
  EXPECT_FALSE(refusal->isHidden());
  EXPECT_TRUE(refusal->text().contains(QStringLiteral("at character 2"))) << refusal->text().toStdString();
  panel_.filter().clear();
  EXPECT_TRUE(refusal->isHidden());
  panel_.findChild<QToolButton*>(QStringLiteral("hideListed"))->click();
  EXPECT_EQ(edited_.size(), 4U);
  EXPECT_EQ(panel_.item("map")->checkState(0), Qt::Unchecked);
  panel_.findChild<QToolButton*>(QStringLiteral("showListed"))->click();
  EXPECT_TRUE(edited_.empty());
}

TEST_F(FramesPanelTest, ShowsTheSpanOfEachFrame) {
  EXPECT_EQ(panel_.item("lidar")->text(4), QStringLiteral("10.00 s"));
  EXPECT_EQ(panel_.item("map")->text(4), QString());
}

TEST_F(FramesPanelTest, CopyPutsSeventeenDigitsIntoTheClipboard) {
  panel_.pose().choose("map", "lidar");
  panel_.findChild<QToolButton*>(QStringLiteral("copyPose"))->click();
  const auto json = QJsonDocument::fromJson(QGuiApplication::clipboard()->text().toUtf8()).object();
  EXPECT_EQ(json[QStringLiteral("target")].toString(), QStringLiteral("map"));
  EXPECT_EQ(json[QStringLiteral("source")].toString(), QStringLiteral("lidar"));
  EXPECT_EQ(json[QStringLiteral("translation")][0].toDouble(), 5.0);
}

TEST_F(FramesPanelTest, APoseThatDoesNotExistIsExplained) {
  panel_.setTime(TimePoint{-1_s});
  panel_.refreshNow();
  panel_.pose().choose("map", "lidar");
  EXPECT_TRUE(panel_.pose().text().contains(QStringLiteral("lidar"))) << panel_.pose().text().toStdString();
  EXPECT_TRUE(panel_.pose().json().isEmpty());
  EXPECT_FALSE(panel_.findChild<QToolButton*>(QStringLiteral("copyPose"))->isEnabled());
}

TEST(PoseText, EveryDigitReadsBack) {
  test::Random random(3);
  for (int i = 0; i < 50; ++i) {
    const tf::RigidTransform pose = random.transform(1e6);
    const auto json = QJsonDocument::fromJson(poseJson("a \"b\"", "c\\d", pose).toUtf8()).object();
    EXPECT_EQ(json[QStringLiteral("target")].toString(), QStringLiteral("a \"b\""));
    EXPECT_EQ(json[QStringLiteral("translation")][1].toDouble(), pose.translation.y);
    EXPECT_EQ(json[QStringLiteral("rotation_xyzw")][3].toDouble(), pose.rotation.w);
  }
}

TEST(ProblemList, ListsTheProblemsOfTheRecordingWithCounts) {
  const auto dataset = test::makeRobotDataset();
  ProblemList problems;
  problems.setDataset(dataset);
  ASSERT_TRUE(waitFor([&] { return problems.isChecked(); }));
  EXPECT_EQ(problems.topLevelItemCount(), 0);
  dataset->addProblem({"BadChunk", "chunk at byte 12 is cut off", 3});
  problems.refresh();
  ASSERT_EQ(problems.topLevelItemCount(), 1);
  const QString text = problems.topLevelItem(0)->text(0);
  EXPECT_TRUE(text.contains(QStringLiteral("BadChunk")) && text.contains(QStringLiteral("3 times")));
}

TEST(ProblemList, LooksThroughTransformsWhenAllAreThere) {
  test::DatasetBuilder builder;
  builder.topic("/tf", scenegraph::ObjectType::FrameTransforms);
  for (std::int64_t tenth = 0; tenth < 20; ++tenth) {
    builder.transform(tenth * 100_ms, "map", "odom");
  }
  builder.transform(60_s, "map", "other");  // the recording is known to be as long
  ProblemList problems;
  int checks = 0;
  QObject::connect(&problems, &ProblemList::checked, &problems, [&] { ++checks; });
  problems.setLoading(true);
  problems.setDataset(builder.build());
  problems.refresh();
  EXPECT_FALSE(QTest::qWaitFor([&] { return problems.isChecked(); }, 200)) << "there may be more of them";
  EXPECT_EQ(problems.topLevelItemCount(), 0);
  problems.setLoading(false);
  ASSERT_TRUE(waitFor([&] { return problems.isChecked(); }));
  EXPECT_EQ(checks, 1);
  ASSERT_EQ(problems.topLevelItemCount(), 1);
  EXPECT_TRUE(problems.topLevelItem(0)->text(0).startsWith(QStringLiteral("StaleTransform")));
}

TEST(ProblemList, GapsJumpsAndConflictsCanBeGoneTo) {
  test::DatasetBuilder builder;
  builder.topic("/tf", scenegraph::ObjectType::FrameTransforms);
  for (std::int64_t tenth = 0; tenth < 100; ++tenth) {
    if (tenth < 40 || tenth > 80) {
      builder.transform(tenth * 100_ms, "map", "odom");
    }
    builder.transform(tenth * 100_ms, "odom", "base", test::translate(tenth == 60 ? 30.0 : 0.0, 0, 0));
  }
  builder.transform(9_s, "elsewhere", "base");
  builder.transform(9_s, "base", "map");
  const auto dataset = builder.build();
  ProblemList problems;
  problems.setDataset(dataset);
  std::optional<TimePoint> asked;
  QObject::connect(&problems, &ProblemList::timeRequested, &problems, [&](TimePoint time) { asked = time; });
  ASSERT_TRUE(waitFor([&] { return problems.isChecked(); }));
  QStringList codes;
  for (int i = 0; i < problems.topLevelItemCount(); ++i) {
    QTreeWidgetItem* row = problems.topLevelItem(i);
    const QString code = row->text(0).section(QLatin1Char(':'), 0, 0);
    codes << code;
    asked.reset();
    Q_EMIT problems.itemClicked(row, 0);
    ASSERT_TRUE(asked.has_value()) << code.toStdString();
    if (code == QStringLiteral("TransformGap")) {
      EXPECT_EQ(asked, TimePoint{3'900_ms});
      EXPECT_EQ(row->text(1), QStringLiteral("+3.900 s"));
    } else if (code == QStringLiteral("ReparentConflict") || code == QStringLiteral("Cycle")) {
      EXPECT_EQ(asked, TimePoint{9_s});
    }
  }
  for (const char* code : {"TransformGap", "TransformJump", "ReparentConflict", "Cycle"}) {
    EXPECT_TRUE(codes.contains(QLatin1String(code))) << code;
  }
}

TEST(FrameMemory, OutlivesTheProgramForNamedSourcesOnly) {
  FrameMemory memory;
  memory.remember("/data/run 1.mcap", "base_link");
  memory.remember("", "odom");
  EXPECT_EQ(memory.recall(""), "odom");
  const FrameMemory after_restart;
  EXPECT_EQ(after_restart.recall("/data/run 1.mcap"), "base_link");
  EXPECT_EQ(after_restart.recall("/data/run 2.mcap"), std::nullopt);
  EXPECT_EQ(after_restart.recall(""), std::nullopt);
  memory.remember("/data/run 1.mcap", std::nullopt);
  EXPECT_EQ(after_restart.recall("/data/run 1.mcap"), std::nullopt);
}

class FrameWindowTest : public test::OpenWindowTest {
 protected:
  void open() {
    OpenWindowTest::open();
    activate();
  }
  void TearDown() override {
    FrameMemory().remember("test", std::nullopt);
    OpenWindowTest::TearDown();
  }
  void pick(ViewPanel& panel, const QString& frame) {
    panel.framePicker().lineEdit()->selectAll();
    QTest::keyClicks(panel.framePicker().lineEdit(), frame);
    QTest::keyClick(panel.framePicker().lineEdit(), Qt::Key_Return);
    settle();
  }
};

TEST_F(FrameWindowTest, ANewViewTakesTheFrameLastPickedByHandAndStaysAutomatic) {
  open();
  ViewPanel& first = *window_->views()[0];
  pick(first, QStringLiteral("odom"));
  EXPECT_TRUE(first.view().scene()->isFixedFrameExplicit());
  ViewPanel& second = window_->addView();
  settle();
  EXPECT_EQ(second.view().scene()->fixedFrame(), "odom");
  EXPECT_FALSE(second.view().scene()->isFixedFrameExplicit());
  EXPECT_EQ(second.framePicker().currentText(), QStringLiteral("auto (odom)"));
  window_.reset();
  open();
  EXPECT_EQ(window_->views()[0]->view().scene()->fixedFrame(), "odom") << "after a restart, too";
  window_->dataset()->transforms()->clear();
  window_->views()[0]->view().requestTick();
  settle();
  EXPECT_NE(window_->views()[0]->view().scene()->fixedFrame(), "odom") << "it heals itself where the frame is gone";
}

TEST_F(FrameWindowTest, BoxesBelongToTheActiveView) {
  open();
  ViewPanel& first = *window_->views()[0];
  ViewPanel& second = window_->addView();
  settle();
  second.view().setFocus();
  settle();
  ASSERT_EQ(&window_->activeView(), &second);
  Q_EMIT window_->frameTree().hiddenFramesEdited({"lidar"});
  settle();
  EXPECT_EQ(second.hiddenFrames(), ViewPanel::FrameNames{"lidar"});
  EXPECT_TRUE(first.hiddenFrames().empty());
  first.view().setFocus();
  settle();
  EXPECT_EQ(window_->frameTree().item("lidar")->checkState(0), Qt::Checked);
  second.view().setFocus();
  settle();
  EXPECT_EQ(window_->frameTree().item("lidar")->checkState(0), Qt::Unchecked);
}

TEST_F(FrameWindowTest, AProblemsTimeIsGoneTo) {
  open();
  Q_EMIT window_->frameTree().timeRequested(TimePoint{7_s});
  EXPECT_EQ(window_->timeBar().time(), TimePoint{7_s});
  EXPECT_EQ(window_->views()[0]->view().time(), TimePoint{7_s});
}

TEST_F(FrameWindowTest, ReturnOnAFrameFramesIt) {
  open();
  Q_EMIT window_->frameTree().frameActivated(QStringLiteral("lidar"));
  const auto& view = window_->views()[0]->view();
  ASSERT_TRUE(view.selection().has_value());
  EXPECT_EQ(view.selection()->frame, "lidar");
  EXPECT_LT(view.camera().sight().radius_m, 5.0);
}

}  // namespace
}  // namespace stillframe::viewer
