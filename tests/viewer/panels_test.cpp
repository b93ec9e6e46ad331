#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QTest>
#include <QTreeWidget>
#include <optional>

#include "nodes/registry.h"
#include "tests/viewer/viewer_support.h"
#include "viewer/frames/frame_picker.h"
#include "viewer/frames/frame_tree.h"
#include "viewer/layers/layer_panel.h"
#include "viewer/layers/setting_editor.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using scenegraph::SettingKind;
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

TEST(SettingEditor, BuildsAWidgetForEachKindAndReportsEdits) {
  QString heard;
  const auto watch = [&](SettingEditor& editor) {
    QObject::connect(&editor, &SettingEditor::edited, &editor,
                     [&](const QString& key, const QString& text) { heard = key + QLatin1Char('=') + text; });
  };
  SettingEditor on({.key = "on", .label = "On", .help = "", .kind = SettingKind::Bool}, "true");
  watch(on);
  auto* box = on.findChild<QCheckBox*>();
  ASSERT_NE(box, nullptr);
  EXPECT_TRUE(box->isChecked());
  box->click();
  EXPECT_EQ(heard, QStringLiteral("on=false"));

  SettingEditor size(
      {.key = "size", .label = "Size", .help = "", .kind = SettingKind::Double, .minimum = 0.0, .maximum = 2.0}, "0.3");
  watch(size);
  EXPECT_NE(size.findChild<QSlider*>(), nullptr);
  size.findChild<QDoubleSpinBox*>()->setValue(0.5);
  EXPECT_EQ(heard, QStringLiteral("size=0.5"));
  EXPECT_EQ(size.findChild<QSlider*>()->value(), 250);

  SettingEditor map({.key = "map",
                     .label = "Map",
                     .help = "",
                     .kind = SettingKind::Text,
                     .choices = {"turbo", "viridis"},
                     .choices_only = true},
                    "turbo");
  watch(map);
  auto* combo = map.findChild<QComboBox*>();
  ASSERT_NE(combo, nullptr);
  EXPECT_FALSE(combo->isEditable());
  QTest::keyClick(combo, Qt::Key_Down);
  EXPECT_EQ(heard, QStringLiteral("map=viridis"));

  SettingEditor color({.key = "color", .label = "Colour", .help = "", .kind = SettingKind::Color}, "#ff0000");
  EXPECT_EQ(color.findChild<QPushButton*>()->text(), QStringLiteral("#ff0000"));
}

TEST(SettingEditor, ShowingAValueReportsNothing) {
  SettingEditor size(
      {.key = "size", .label = "Size", .help = "", .kind = SettingKind::Double, .minimum = 0.0, .maximum = 2.0}, "0.3");
  int edits = 0;
  QObject::connect(&size, &SettingEditor::edited, &size, [&] { ++edits; });
  size.setText("0.123456789");
  EXPECT_EQ(edits, 0) << "else the rounding of a spin box would reach the layer";
}

class LayerPanelTest : public testing::Test {
 protected:
  std::unique_ptr<scenegraph::Executor> executor_ = scenegraph::makeSynchronousExecutor();
  scenegraph::Scene scene_{test::makeRobotDataset(), nodes::layerTypes(), *executor_};
  LayerPanel panel_;
};

TEST_F(LayerPanelTest, ListsEveryLayerWithItsSettingsAndStatus) {
  scene_.addDefaultLayers();
  panel_.setScene(&scene_);
  scene_.update(TimePoint{1_s});
  panel_.refresh();
  ASSERT_EQ(static_cast<std::size_t>(panel_.topLevelItemCount()), scene_.layers().size());
  for (std::size_t i = 0; i < scene_.layers().size(); ++i) {
    const auto& layer = *scene_.layers()[i]->layer;
    EXPECT_EQ(static_cast<std::size_t>(panel_.topLevelItem(static_cast<int>(i))->childCount()),
              layer.settingSpecs().size());
    EXPECT_EQ(panel_.topLevelItem(static_cast<int>(i))->text(1), statusLine(layer));
  }
}

TEST_F(LayerPanelTest, ShowsWhyALayerIsNotDrawn) {
  ASSERT_TRUE(scene_.addLayer("/points").has_value());
  panel_.setScene(&scene_);
  scene_.update(TimePoint{0});
  panel_.refresh();
  const auto& status = scene_.layers().front()->layer->status();
  EXPECT_EQ(status.level, scenegraph::StatusLevel::Warn);
  EXPECT_EQ(panel_.topLevelItem(0)->text(1), QString::fromStdString(status.message));
  EXPECT_TRUE(panel_.topLevelItem(0)->toolTip(1).contains(QString::fromStdString(status.code)));
}

TEST_F(LayerPanelTest, CheckBoxSwitchesTheLayer) {
  ASSERT_TRUE(scene_.addLayer("/points").has_value());
  panel_.setScene(&scene_);
  int changes = 0;
  QObject::connect(&panel_, &LayerPanel::changed, &panel_, [&] { ++changes; });
  panel_.topLevelItem(0)->setCheckState(0, Qt::Unchecked);
  EXPECT_FALSE(scene_.layers().front()->layer->isVisible());
  EXPECT_EQ(changes, 1);
}

}  // namespace
}  // namespace stillframe::viewer
