#include <gtest/gtest.h>

#include <QDockWidget>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileInfo>
#include <QMimeData>
#include <QStatusBar>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <QUrl>
#include <cmath>
#include <set>

#include "tests/viewer/open_window.h"
#include "tests/viewer/viewer_support.h"
#include "viewer/frames/frame_picker.h"
#include "viewer/frames/frame_tree.h"
#include "viewer/time/time_bar.h"
#include "viewer/window/message_bar.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using test::settle;
using test::waitFor;
using tf::TimePoint;

class InspectorWindowTest : public test::OpenWindowTest {};

TEST_F(InspectorWindowTest, EveryPictureIsSeenInASmallWindow) {
  open();
  for (QDockWidget* const dock : window_->findChildren<QDockWidget*>()) {
    dock->show();
  }
  window_->views()[0]->findChild<QToolButton*>(QStringLiteral("effects"))->click();
  const QSize room(800, 500);
  window_->resize(room);
  settle();
  EXPECT_EQ(window_->size(), room) << "with all panels";
  window_->views()[0]->findChild<QToolButton*>(QStringLiteral("splitRight"))->click();
  settle();
  EXPECT_EQ(window_->size(), room);
  for (ViewPanel* const panel : window_->views()) {
    EXPECT_GE(panel->view().width(), 150);
    EXPECT_GE(panel->view().height(), 90);
  }
}

TEST_F(InspectorWindowTest, OpensARecordingWhereThereIsSomethingToSee) {
  open({.files = {"robot.mcap"}});
  EXPECT_EQ(window_->timeBar().range(), (TimeRange{TimePoint{0}, TimePoint{10_s}}));
  EXPECT_EQ(window_->timeBar().time(), TimePoint{1_s}) << "its first cloud";
  EXPECT_TRUE(window_->statusBar()->currentMessage().contains(QStringLiteral("+1.000")));
  EXPECT_EQ(window_->windowTitle(), QStringLiteral("test - Stillframe"));
  EXPECT_EQ(window_->views().at(0)->framePicker().currentText(), QStringLiteral("auto (map)"));
  EXPECT_NE(window_->frameTree().item("lidar"), nullptr);
  EXPECT_GT(test::drawnPixels(view(0).grabFramebuffer()), 500);
}

TEST_F(InspectorWindowTest, StartsAtTheTimeAndFrameAskedFor) {
  open({.files = {"robot.mcap"}, .time = "+2.5", .fixed_frame = "base_link", .views = 2});
  EXPECT_EQ(window_->timeBar().time(), TimePoint{2_s + 500_ms});
  ASSERT_EQ(window_->views().size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(view(i).scene()->fixedFrame(), "base_link");
    EXPECT_EQ(view(i).scene()->time(), TimePoint{2_s + 500_ms});
  }
}

TEST_F(InspectorWindowTest, FourViewsAreTwoByTwoInAWindowOfTheUsualSize) {
  open({.files = {"robot.mcap"}, .views = 4});
  ASSERT_EQ(window_->views().size(), 4U);
  EXPECT_EQ(window_->size(), QSize(1280, 800));
  std::set<int> lefts;
  std::set<int> tops;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(view(i).width(), view(0).width(), 2);
    EXPECT_NEAR(view(i).height(), view(0).height(), 2);
    const QPoint corner = view(i).mapTo(window_.get(), QPoint(0, 0));
    lefts.insert(corner.x());
    tops.insert(corner.y());
  }
  EXPECT_EQ(lefts.size(), 2U);
  EXPECT_EQ(tops.size(), 2U);
}

TEST_F(InspectorWindowTest, OnlyTheNamedLayersAreThere) {
  open({.files = {"robot.mcap"}, .layers = {.layers = {{"/points", {}}}, .only = true}});
  ASSERT_EQ(view(0).scene()->layers().size(), 1U);
  EXPECT_EQ(view(0).scene()->layers().front()->topic, "/points");
}

TEST_F(InspectorWindowTest, SliderMovesEveryView) {
  open({.files = {"robot.mcap"}, .views = 2});
  window_->timeBar().slider().setValue(TimeBar::kSteps / 2);
  settle();
  EXPECT_EQ(view(0).scene()->time(), TimePoint{5_s});
  EXPECT_EQ(view(1).scene()->time(), TimePoint{5_s});
}

TEST_F(InspectorWindowTest, IdleDrawsNothing) {
  open({.files = {"robot.mcap"}, .views = 2});
  const auto frames = view(0).framesDrawn() + view(1).framesDrawn();
  settle();
  EXPECT_EQ(view(0).framesDrawn() + view(1).framesDrawn(), frames);
}

TEST_F(InspectorWindowTest, BadFileSaysSoAndThePreviousRecordingStays) {
  open({.files = {"robot.mcap"}});
  const auto dataset = window_->dataset();
  window_->openFiles({"bad.mcap"});
  ASSERT_TRUE(waitFor([&] { return !window_->messageBar().text().isEmpty(); }));
  EXPECT_EQ(window_->messageBar().text(), QStringLiteral("bad.mcap is no MCAP recording"));
  EXPECT_EQ(window_->dataset(), dataset);
  EXPECT_TRUE(window_->isComplete());
}

TEST_F(InspectorWindowTest, BadFileAtStartLeavesAnEmptyWindowThatStillWorks) {
  show({.files = {"bad.mcap"}});
  ASSERT_TRUE(waitFor([&] { return !window_->messageBar().text().isEmpty(); }));
  window_->openFiles({"robot.mcap"});
  ASSERT_TRUE(waitFor([&] { return window_->isComplete(); }));
  EXPECT_EQ(window_->messageBar().text(), QString());
}

TEST_F(InspectorWindowTest, DroppedFileIsOpened) {
  show({});
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(QStringLiteral("/recordings/robot.mcap"))});
  QDragEnterEvent enter({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(window_.get(), &enter);
  EXPECT_TRUE(enter.isAccepted());
  QDropEvent drop({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(window_.get(), &drop);
  ASSERT_TRUE(waitFor([&] { return window_->isComplete(); }));
}

TEST_F(InspectorWindowTest, OpeningTheNextRecordingReplacesTheFirst) {
  open({.files = {"robot.mcap"}});
  const auto first = window_->dataset();
  window_->timeBar().setTime(TimePoint{5_s});
  window_->openFiles({"robot.mcap"});
  ASSERT_TRUE(waitFor([&] { return window_->dataset() != first && window_->isComplete(); }));
  settle();
  EXPECT_EQ(window_->timeBar().time(), TimePoint{1_s});
  EXPECT_GT(test::drawnPixels(view(0).grabFramebuffer()), 500);
}

TEST_F(InspectorWindowTest, SplitViewTakesOverTheStateAndGoesItsOwnWay) {
  open({.files = {"robot.mcap"}});
  ASSERT_NE(view(0).scene()->findLayer("/points"), nullptr);
  view(0).setFixedFrame("odom");
  auto state = view(0).camera().state();
  state.camera.orbit.radius_m = 3.25;
  view(0).setViewpoint(state);
  view(0).scene()->findLayer("/points")->layer->setVisible(false);
  ViewPanel& copy = window_->addView(window_->views().front(), Qt::Vertical);
  settle();
  EXPECT_EQ(copy.view().scene()->fixedFrame(), "odom");
  EXPECT_DOUBLE_EQ(copy.view().camera().sight().radius_m, 3.25);
  EXPECT_FALSE(copy.view().scene()->findLayer("/points")->layer->isVisible());
  copy.view().setFixedFrame("base_link");
  EXPECT_EQ(view(0).scene()->fixedFrame(), "odom");
  EXPECT_TRUE(waitFor([&] { return copy.view().framesDrawn() > 0; }));
  EXPECT_GT(test::drawnPixels(view(0).grabFramebuffer()), 500) << "it has been moved into another splitter";
  window_->closeView(copy);
  settle();
  EXPECT_EQ(window_->views().size(), 1U);
  window_->closeView(*window_->views().front());
  EXPECT_EQ(window_->views().size(), 1U) << "the last view stays";
}

TEST_F(InspectorWindowTest, AScreenshotHasEveryPoint) {
  constexpr int kPoints = 2'500'000;  // more than one frame of software OpenGL draws
  test::CloudBuilder cloud("map");
  cloud.xyz();
  for (int i = 0; i < kPoints; ++i) {
    cloud.point({std::sin(i * 0.37) * 20.0, std::sin(i * 0.73) * 20.0, std::sin(i * 1.17) * 5.0});
  }
  test::DatasetBuilder builder;
  builder.topic("/cloud", scenegraph::ObjectType::PointCloud).at(1_s, cloud.build());
  const auto dataset = builder.build();
  const RecordingOpener opener = [&](const auto&) -> std::expected<OpenedRecording, scenegraph::Status> {
    return OpenedRecording{dataset, [](const auto& progress) { progress(1.0); }};
  };
  const QTemporaryDir folder;
  std::vector<QImage> pictures;
  for (const char* const name : {"a.png", "b.png"}) {
    const QString file = folder.filePath(QLatin1String(name));
    InspectorWindow window(opener, {.files = {"cloud.mcap"}, .views = 2, .screenshot = file.toStdString()});
    window.show();
    // Five million points by software, which a busy machine takes its time for.
    ASSERT_TRUE(QTest::qWaitFor([&] { return QFileInfo::exists(file); }, 60'000));
    for (ViewPanel* const panel : window.views()) {
      EXPECT_EQ(panel->view().pointShare(), 1.0);
    }
    pictures.emplace_back(file);
  }
  EXPECT_EQ(pictures[0], pictures[1]) << "none of them was half drawn";
}

TEST_F(InspectorWindowTest, WhatWasAskedForAndIsNotThereIsTold) {
  open({.files = {"robot.mcap"},
        .time = "+1000",
        .fixed_frame = "nowhere",
        .display_frame = "nothing",
        .layers = {.layers = {{.id = "/radar", .settings = {}}}}});
  const QStringList lines = window_->messageBar().text().split(QLatin1Char('\n'));
  ASSERT_EQ(lines.size(), 4) << window_->messageBar().text().toStdString();
  EXPECT_EQ(lines[0], QStringLiteral("Time +1000 is outside the recording, which spans +0 to +10.000"));
  EXPECT_TRUE(lines[1].startsWith(QStringLiteral("there is no topic '/radar'"))) << lines[1].toStdString();
  EXPECT_TRUE(lines[2].startsWith(QStringLiteral("fixed frame 'nowhere' is not in"))) << lines[2].toStdString();
  EXPECT_TRUE(lines[3].startsWith(QStringLiteral("display frame 'nothing' is not in"))) << lines[3].toStdString();
}

TEST_F(InspectorWindowTest, ARecordingWithNothingToSeeSaysSo) {
  for (const bool has_messages : {false, true}) {
    test::DatasetBuilder builder;
    if (has_messages) {
      builder.topic("/points", scenegraph::ObjectType::PointCloud).at(1_s, test::CloudBuilder("map").xyz().build());
    }
    const auto dataset = builder.build();
    InspectorWindow window(
        [&](const auto&) -> std::expected<OpenedRecording, scenegraph::Status> {
          return OpenedRecording{dataset, [](const auto& progress) { progress(1.0); }};
        },
        {.files = {"empty.mcap"}});
    window.show();
    ASSERT_TRUE(test::waitFor([&] { return window.isComplete(); }));
    EXPECT_EQ(window.messageBar().text().contains(QStringLiteral("holds no messages")), !has_messages)
        << window.messageBar().text().toStdString();
  }
}

TEST_F(InspectorWindowTest, ClickingAFrameLooksAtIt) {
  open({.files = {"robot.mcap"}, .time = "+4"});
  Q_EMIT window_->frameTree().framePicked(QStringLiteral("base_link"));
  EXPECT_DOUBLE_EQ(view(0).camera().sight().focal_point.x, 4.0);
}

TEST_F(InspectorWindowTest, SpaceAndArrowsDriveTheTimeBar) {
  open({.files = {"robot.mcap"}, .time = "start"});
  EXPECT_EQ(window_->timeBar().time(), TimePoint{0}) << "the start where it is asked for";
  activate();
  view(0).setFocus();
  QTest::keyClick(&view(0), Qt::Key_Right);
  EXPECT_EQ(window_->timeBar().time(), TimePoint{1_s});
  QTest::keyClick(&view(0), Qt::Key_Left);
  EXPECT_EQ(window_->timeBar().time(), TimePoint{0});
  QTest::keyClick(&view(0), Qt::Key_Space);
  EXPECT_TRUE(window_->timeBar().isPlaying());
  QTest::keyClick(&view(0), Qt::Key_Space);
  EXPECT_FALSE(window_->timeBar().isPlaying());
}

TEST_F(InspectorWindowTest, MovedCameraIsNotTakenAwayWhenLoadingEnds) {
  show({.files = {"robot.mcap"}});
  ASSERT_TRUE(waitFor([&] { return window_->dataset() != nullptr; }));
  auto state = view(0).camera().state();
  state.camera.orbit.radius_m = 77.0;
  view(0).setViewpoint(state);
  ASSERT_TRUE(waitFor([&] { return window_->isComplete(); }));
  settle();
  EXPECT_DOUBLE_EQ(view(0).camera().sight().radius_m, 77.0);
}

}  // namespace
}  // namespace stillframe::viewer
