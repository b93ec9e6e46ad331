#include <gtest/gtest.h>

#include <QAbstractItemView>
#include <QCompleter>
#include <QLineEdit>
#include <QTest>
#include <QTreeWidget>
#include <optional>

#include "tests/viewer/viewer_support.h"
#include "viewer/frames/frame_picker.h"
#include "viewer/frames/frame_tree.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using tf::TimePoint;

struct Picked {
  int count = 0;
  std::optional<std::string> frame;
};

Picked& listen(FramePicker& picker, Picked& picked) {
  QObject::connect(&picker, &FramePicker::picked, &picker, [&](const std::optional<std::string>& frame) {
    ++picked.count;
    picked.frame = frame;
  });
  return picked;
}

TEST(FramePicker, ListsAutomaticChoiceFirstAndFillsIn) {
  FramePicker picker("Fixed frame", "the frame that stands still");
  picker.setFrames({"odom", "base_link"});
  picker.setCurrent(std::nullopt, "odom");
  EXPECT_EQ(picker.currentText(), QStringLiteral("auto (odom)"));
  picker.setFrames({"odom", "base_link", "map"});
  picker.setCurrent(std::nullopt, "map");
  EXPECT_EQ(picker.currentText(), QStringLiteral("auto (map)"));
  EXPECT_EQ(picker.frameCount(), 3);
  EXPECT_EQ(picker.itemText(3), QStringLiteral("map"));
}

TEST(FramePicker, TypedNameIsPicked) {
  FramePicker picker("Fixed frame", "the frame that stands still");
  Picked picked;
  listen(picker, picked);
  picker.setFrames({"odom", "base_link"});
  picker.lineEdit()->selectAll();
  QTest::keyClicks(picker.lineEdit(), QStringLiteral("base_link"));
  QTest::keyClick(picker.lineEdit(), Qt::Key_Return);
  EXPECT_EQ(picked.frame, "base_link");
  picker.lineEdit()->clear();
  QTest::keyClick(picker.lineEdit(), Qt::Key_Return);
  EXPECT_EQ(picked.frame, std::nullopt);
}

TEST(FramePicker, APartOfOneNameIsThatFrameAPartOfSeveralIsNone) {
  FramePicker picker("Fixed frame", "the frame that stands still");
  Picked picked;
  listen(picker, picked);
  picker.setFrames({"odom", "base_link", "base_scan"});
  picker.setCurrent(std::nullopt, "odom");
  const auto type = [&](const char* text) {
    picker.lineEdit()->selectAll();
    QTest::keyClicks(picker.lineEdit(), QLatin1String(text));
    picker.completer()->popup()->hide();
    QTest::keyClick(picker.lineEdit(), Qt::Key_Return);
    return picked.frame;
  };
  EXPECT_EQ(type("link"), "base_link");
  EXPECT_EQ(type("base"), "base") << "one that may come yet";
  EXPECT_EQ(type("od"), "odom");
  EXPECT_EQ(type("map"), "map");
}

TEST(FramePicker, MissingFrameIsShownAsMissingUntilItAppears) {
  FramePicker picker("Fixed frame", "the frame that stands still");
  picker.setFrames({"odom"});
  picker.setCurrent("map", "odom");
  EXPECT_TRUE(picker.isMissing());
  EXPECT_EQ(picker.currentText(), QStringLiteral("map"));
  picker.setFrames({"odom", "map"});
  EXPECT_FALSE(picker.isMissing());
  EXPECT_EQ(picker.currentText(), QStringLiteral("map"));
}

TEST(FramePicker, GrowthDoesNotDisturbTyping) {
  FramePicker picker("Fixed frame", "the frame that stands still");
  picker.setFrames({"odom"});
  picker.lineEdit()->selectAll();
  QTest::keyClicks(picker.lineEdit(), QStringLiteral("ba"));
  picker.setFrames({"odom", "base_link"});
  EXPECT_EQ(picker.lineEdit()->text(), QStringLiteral("ba"));
}

TEST(FrameTree, ShowsTheTreeWithAgesAtTheTrackerTime) {
  FrameTree tree;
  tree.setDataset(test::makeRobotDataset());
  tree.setTime(TimePoint{4_s + 500_ms});
  tree.refreshNow();
  ASSERT_EQ(tree.tree().topLevelItemCount(), 1);
  QTreeWidgetItem* lidar = tree.item("lidar");
  ASSERT_NE(lidar, nullptr);
  EXPECT_EQ(lidar->parent(), tree.item("base_link"));
  EXPECT_EQ(lidar->text(1), QStringLiteral("500 ms"));
  EXPECT_EQ(lidar->text(2), QStringLiteral("11"));
  EXPECT_EQ(lidar->text(3), QStringLiteral("1.0"));
  tree.setTime(TimePoint{-1_s});
  tree.refreshNow();
  EXPECT_EQ(tree.item("lidar")->text(1), QStringLiteral("none yet"));
}

TEST(FrameTree, FillsInWhileTheBufferGrows) {
  test::DatasetBuilder builder;
  builder.topic("/tf", scenegraph::ObjectType::FrameTransforms).transform(1_s, "map", "odom");
  const auto dataset = builder.build();
  FrameTree tree;
  tree.setDataset(dataset);
  EXPECT_EQ(tree.item("base_link"), nullptr);
  builder.transform(2_s, "odom", "base_link");
  dataset->takeTransforms();
  tree.refreshNow();
  ASSERT_NE(tree.item("base_link"), nullptr);
  EXPECT_EQ(tree.item("base_link")->parent(), tree.item("odom"));
}

}  // namespace
}  // namespace stillframe::viewer
