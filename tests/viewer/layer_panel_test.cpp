#include "viewer/layers/layer_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QClipboard>
#include <QComboBox>
#include <QDropEvent>
#include <QGuiApplication>
#include <QLineEdit>
#include <QListWidget>
#include <QMimeData>
#include <QScrollBar>
#include <QTest>
#include <QToolButton>

#include "nodes/registry.h"
#include "tests/viewer/viewer_support.h"
#include "viewer/layers/add_layer_menu.h"
#include "viewer/layers/layer_tree.h"
#include "viewer/layers/range_editor.h"
#include "viewer/layers/setting_editor.h"
#include "viewer/layers/setting_rows.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;
using testing::ElementsAre;
using tf::TimePoint;

class LayerPanelTest : public testing::Test {
 protected:
  LayerPanelTest() {
    QObject::connect(&panel_, &LayerPanel::changed, &panel_, [this](const QString& what) { changes_ << what; });
  }
  void showDefaults(std::int64_t time_ns) {
    scene_.addDefaultLayers();
    panel_.setScene(&scene_);
    scene_.update(TimePoint{time_ns});
    panel_.refresh();
    panel_.resize(320, 600);
    panel_.show();
  }
  [[nodiscard]] std::vector<std::string> ids() const {
    std::vector<std::string> ids;
    for (const auto& slot : scene_.layers()) {
      ids.push_back(slot->id);
    }
    return ids;
  }
  [[nodiscard]] std::vector<std::string> names() {
    std::vector<std::string> names;
    for (int i = 0; i < tree_.topLevelItemCount(); ++i) {
      names.push_back(tree_.topLevelItem(i)->text(0).toStdString());
    }
    return names;
  }
  void click(const char* button) {
    QTest::mouseClick(panel_.findChild<QToolButton*>(QLatin1String(button)), Qt::LeftButton);
  }

  std::unique_ptr<scenegraph::Executor> executor_ = scenegraph::makeSynchronousExecutor();
  scenegraph::Scene scene_{test::makeRobotDataset(), nodes::layerTypes(), *executor_};
  LayerPanel panel_;
  LayerTree& tree_ = panel_.tree();
  QStringList changes_;
};

TEST_F(LayerPanelTest, ListsEveryLayerWithItsSettingsAndStatus) {
  showDefaults(1_s);
  EXPECT_THAT(names(), ElementsAre("Grid", "TF", "/points"));
  for (const auto& slot : scene_.layers()) {
    const auto* settings = tree_.settingRows(slot->id);
    for (const auto& spec : slot->layer->settingSpecs()) {
      EXPECT_EQ(settings->editor(spec.key) != nullptr, !RangeEditor::covers(spec.key)) << slot->id << ' ' << spec.key;
    }
    EXPECT_EQ(tree_.item(slot->id)->text(1), statusLine(*slot->layer));
  }
  EXPECT_NE(tree_.settingRows("/points")->range(), nullptr);
  EXPECT_EQ(tree_.settingRows("/points")->editor("range_min"), nullptr) << "the range is one row";
}

TEST(LayerCounts, AreInTheSingularForOne) {
  EXPECT_EQ(counted(1, "poses"), "1 pose");
  EXPECT_EQ(counted(1, "entities"), "1 entity");
  EXPECT_EQ(counted(0, "points"), "0 points");
  EXPECT_EQ(counted(2, "entities"), "2 entities");
}

TEST_F(LayerPanelTest, ARowBeginsWithTheReasonAndTheRowBeneathHasTheWholeSentence) {
  test::DatasetBuilder builder;
  builder.topic("/points", scenegraph::ObjectType::PointCloud).failsAt(1_s, "NoSense");
  scenegraph::Scene scene{builder.build(), nodes::layerTypes(), *executor_};
  ASSERT_TRUE(scene.addLayer("/points"));
  scene.update(tf::TimePoint{2_s});
  scene.update(tf::TimePoint{2_s});
  tree_.setScene(&scene);
  const std::string& sentence = scene.findLayer("/points")->layer->status().message;
  EXPECT_TRUE(sentence.starts_with("'/points' at 1.000000000 s: ")) << sentence;
  EXPECT_TRUE(sentence.ends_with(tree_.item("/points")->text(1).toStdString()));
  EXPECT_TRUE(tree_.item("/points")->text(1).startsWith(QStringLiteral("made to fail")));
  EXPECT_EQ(tree_.item("/points")->child(0)->text(0).toStdString(), sentence);
  tree_.setScene(nullptr);
}

TEST_F(LayerPanelTest, ShowsWhyALayerIsNotDrawnInWordsThatCanBeCopied) {
  ASSERT_TRUE(scene_.addLayer("/points").has_value());
  panel_.setScene(&scene_);
  scene_.update(TimePoint{0});
  panel_.refresh();
  const auto& status = scene_.layers().front()->layer->status();
  EXPECT_EQ(status.level, scenegraph::StatusLevel::Warn);
  QTreeWidgetItem* const row = tree_.item("/points");
  EXPECT_EQ(row->text(1), QString::fromStdString(status.message));
  EXPECT_TRUE(row->toolTip(1).contains(QString::fromStdString(status.code)));
  EXPECT_EQ(row->child(0)->text(0), QString::fromStdString(status.message));
  EXPECT_FALSE(row->child(0)->isHidden());
  scene_.update(TimePoint{1_s});
  panel_.refresh();
  EXPECT_TRUE(row->child(0)->isHidden()) << "nothing to say";
}

TEST_F(LayerPanelTest, CheckBoxSwitchesTheLayer) {
  showDefaults(1_s);
  tree_.item("/points")->setCheckState(0, Qt::Unchecked);
  EXPECT_FALSE(scene_.findLayer("/points")->layer->isVisible());
  EXPECT_EQ(changes_, QStringList{"hide /points"});
}

TEST_F(LayerPanelTest, ButtonsDuplicateRemoveAndMoveTheSelectedLayer) {
  showDefaults(1_s);
  EXPECT_FALSE(panel_.findChild<QToolButton*>(QStringLiteral("removeLayer"))->isEnabled());
  tree_.selectLayer("/points");
  click("duplicateLayer");
  EXPECT_THAT(ids(), ElementsAre("grid", "tf", "/points", "/points#2"));
  EXPECT_EQ(tree_.currentLayer(), "/points#2");
  click("moveLayerUp");
  EXPECT_THAT(ids(), ElementsAre("grid", "tf", "/points#2", "/points"));
  EXPECT_THAT(names(), ElementsAre("Grid", "TF", "/points#2", "/points"));
  click("moveLayerDown");
  click("moveLayerDown");
  EXPECT_THAT(ids(), ElementsAre("grid", "tf", "/points", "/points#2")) << "the last stays the last";
  click("removeLayer");
  EXPECT_THAT(ids(), ElementsAre("grid", "tf", "/points"));
  EXPECT_EQ(changes_.size(), 4);
  tree_.selectLayer("grid");
  click("duplicateLayer");
  EXPECT_THAT(names(), ElementsAre("Grid", "Grid#2", "TF", "/points"));
}

TEST_F(LayerPanelTest, KeysDoWhatTheButtonsDo) {
  showDefaults(1_s);
  panel_.activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&panel_));
  tree_.setFocus();
  tree_.selectLayer("/points");
  QTest::keyClick(&tree_, Qt::Key_D, Qt::ControlModifier);
  QTest::keyClick(&tree_, Qt::Key_Up, Qt::ControlModifier);
  EXPECT_THAT(ids(), ElementsAre("grid", "tf", "/points#2", "/points"));
  QTreeWidgetItem* const layer = tree_.currentItem();
  layer->setExpanded(true);
  tree_.setCurrentItem(layer->child(0));
  QTest::keyClick(&tree_, Qt::Key_Delete);
  EXPECT_THAT(ids(), ElementsAre("grid", "tf", "/points#2", "/points")) << "from among its settings";
  tree_.setCurrentItem(layer);
  QTest::keyClick(&tree_, Qt::Key_Delete);
  EXPECT_THAT(ids(), ElementsAre("grid", "tf", "/points"));
}

TEST_F(LayerPanelTest, ALayerIsRenamedInItsRow) {
  showDefaults(1_s);
  tree_.selectLayer("/points");
  QTest::keyClick(&tree_, Qt::Key_F2);
  auto* edit = tree_.viewport()->findChild<QLineEdit*>(QString(), Qt::FindDirectChildrenOnly);
  ASSERT_NE(edit, nullptr);
  edit->selectAll();
  QTest::keyClicks(edit, QStringLiteral("Lidar"));
  QTest::keyClick(edit, Qt::Key_Return);
  test::settle();
  EXPECT_EQ(scene_.findLayer("/points")->title, "Lidar");
  EXPECT_EQ(tree_.item("/points")->text(0), QStringLiteral("Lidar"));
  EXPECT_EQ(changes_, QStringList{"rename Lidar"});
  tree_.item("/points")->setText(0, QString());
  EXPECT_EQ(tree_.item("/points")->text(0), QStringLiteral("/points")) << "without a name, its own";
}

/// Takes a drop without a drag, which would need a window manager.
class DropTree : public LayerTree {
 public:
  using LayerTree::dropEvent;
};

TEST_F(LayerPanelTest, RowsAreDraggedToAnotherPlace) {
  showDefaults(1_s);
  DropTree tree;
  tree.setScene(&scene_);
  tree.resize(300, 400);
  tree.show();
  tree.selectLayer("/points");
  const QRect first = tree.visualItemRect(tree.topLevelItem(0));
  const QMimeData data;
  QDropEvent drop(first.topLeft() + QPoint(20, 1), Qt::MoveAction, &data, Qt::LeftButton, Qt::NoModifier);
  tree.dropEvent(&drop);
  EXPECT_EQ(drop.dropAction(), Qt::IgnoreAction) << "else the view would take the row away";
  test::settle();
  EXPECT_THAT(ids(), ElementsAre("/points", "grid", "tf"));
  EXPECT_EQ(tree.topLevelItem(0)->text(0), QStringLiteral("/points"));
  EXPECT_NE(tree.settingRows("/points")->editor("opacity"), nullptr);
}

TEST_F(LayerPanelTest, AddsWhatWasRemovedAndSecondLayersBySearch) {
  showDefaults(1_s);
  tree_.selectLayer("/points");
  tree_.removeCurrent();
  AddLayerMenu& menu = panel_.addMenu();
  menu.fill(&scene_);
  ASSERT_EQ(menu.list().count(), 3);
  EXPECT_EQ(menu.list().item(0)->text(), QStringLiteral("/points")) << "what has no layer comes first";
  QTest::keyClicks(&menu.search(), QStringLiteral("POI"));
  EXPECT_TRUE(menu.list().item(1)->isHidden());
  QTest::keyClick(&menu.search(), Qt::Key_Return);
  EXPECT_THAT(ids(), ElementsAre("grid", "tf", "/points"));
  menu.fill(&scene_);
  EXPECT_EQ(menu.list().item(2)->text(), QStringLiteral("/points (another)"));
  QTest::keyClick(&menu.search(), Qt::Key_Down);
  QTest::keyClick(&menu.search(), Qt::Key_Down);
  QTest::keyClick(&menu.search(), Qt::Key_Return);
  EXPECT_THAT(ids(), ElementsAre("grid", "tf", "/points", "/points#2"));
}

TEST_F(LayerPanelTest, SettingsReachTheLayerAndWhatIsRefusedGoesBack) {
  showDefaults(1_s);
  QStringList refused;
  QObject::connect(&panel_, &LayerPanel::refused, &panel_, [&](const QString& message) { refused << message; });
  auto* filter = tree_.settingRows("tf")->editor("frame_filter")->findChild<QLineEdit*>();
  QTest::keyClicks(filter, QStringLiteral("["));
  QTest::keyClick(filter, Qt::Key_Return);
  ASSERT_EQ(refused.size(), 1);
  EXPECT_TRUE(refused[0].contains(QStringLiteral("frame_filter"))) << refused[0].toStdString();
  EXPECT_EQ(scene_.findLayer("tf")->layer->settings().at("frame_filter"), "");
  const std::string usual = scene_.findLayer("/points")->layer->settings().at("colormap");
  tree_.settingRows("/points")->editor("colormap")->findChild<QComboBox*>()->textActivated(QStringLiteral("magma"));
  EXPECT_EQ(scene_.findLayer("/points")->layer->settings().at("colormap"), "magma");
  tree_.selectLayer("/points");
  tree_.resetCurrent();
  EXPECT_EQ(scene_.findLayer("/points")->layer->settings().at("colormap"), usual);
}

TEST_F(LayerPanelTest, ShowsOneLayerOnlyAndAllAgain) {
  showDefaults(1_s);
  tree_.selectLayer("tf");
  tree_.showOnlyCurrent();
  EXPECT_TRUE(scene_.findLayer("tf")->layer->isVisible());
  EXPECT_FALSE(scene_.findLayer("/points")->layer->isVisible());
  EXPECT_EQ(tree_.item("/points")->checkState(0), Qt::Unchecked);
  tree_.showAllLayers();
  EXPECT_TRUE(scene_.findLayer("/points")->layer->isVisible());
}

TEST_F(LayerPanelTest, TheListStaysWhereItIsScrolledToAndAMovedLayerComesIntoSight) {
  showDefaults(1_s);
  panel_.resize(320, 260);
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel_));
  for (const char* const id : {"grid", "tf", "/points"}) {
    tree_.item(id)->setExpanded(true);
  }
  const auto is_in_sight = [&](const char* id) {
    return tree_.viewport()->rect().contains(tree_.visualItemRect(tree_.item(id)).topLeft());
  };
  tree_.selectLayer("/points");
  ASSERT_TRUE(is_in_sight("/points"));
  click("moveLayerUp");
  EXPECT_TRUE(is_in_sight("/points"));
  click("duplicateLayer");
  EXPECT_TRUE(is_in_sight("/points#2"));
  QScrollBar& scroll = *tree_.verticalScrollBar();
  scroll.setValue(scroll.maximum() / 2);
  const int scrolled = scroll.value();
  ASSERT_GT(scrolled, 100);
  scene_.removeLayer("/points#2");  // as undo does
  tree_.refresh();
  EXPECT_EQ(scroll.value(), scrolled);
}

TEST_F(LayerPanelTest, OpenRowsStayOpenWhenTheListIsBuiltAnew) {
  showDefaults(1_s);
  tree_.item("/points")->setExpanded(true);
  tree_.moveLayer("/points", 0);
  EXPECT_TRUE(tree_.item("/points")->isExpanded());
  EXPECT_FALSE(tree_.item("tf")->isExpanded());
  panel_.setScene(nullptr);
  EXPECT_EQ(tree_.topLevelItemCount(), 0);
  tree_.duplicateCurrent();
  tree_.addLayer("/points");
  EXPECT_EQ(scene_.layers().size(), 3U);
}

}  // namespace
}  // namespace stillframe::viewer
