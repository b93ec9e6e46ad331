#include "viewer/view/view_history.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QTest>
#include <QToolButton>

#include "tests/viewer/viewer_support.h"
#include "viewer/frames/frame_picker.h"
#include "viewer/layers/layer_panel.h"
#include "viewer/layers/layer_tree.h"
#include "viewer/layers/legend_overlay.h"
#include "viewer/layers/setting_editor.h"
#include "viewer/layers/setting_rows.h"
#include "viewer/view/camera_bar.h"
#include "viewer/view/effect_panel.h"
#include "viewer/view/view_panel.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {
namespace {

using namespace tf::literals;

class ViewHistoryTest : public testing::Test {
 protected:
  ViewHistoryTest() {
    panel_.resize(900, 600);
    panel_.setDataset(test::makeRobotDataset(), *executor_, {});
    panel_.show();
    panel_.view().setTime(tf::TimePoint{1_s});
    panel_.view().applyTick();
    test::settle();
  }
  ~ViewHistoryTest() override { EXPECT_EQ(panel_.view().glMessages(), 0U); }
  QUndoStack& stack() { return panel_.history().stack(); }
  LayerTree& tree() { return panel_.layerPanel().tree(); }
  scenegraph::Scene& scene() { return *panel_.view().scene(); }
  std::string setting(const char* id, const char* key) { return scene().findLayer(id)->layer->settings().at(key); }
  void set(const char* id, const char* key, const char* text) {
    ASSERT_TRUE(scene().findLayer(id)->layer->applySettings({{key, text}}));
    panel_.history().note(QString::fromLatin1(key));
    panel_.view().applyTick();
    test::settle();
  }
  void set(const char* id, const char* key, double value) {
    tree().settingRows(id)->editor(key)->findChild<QDoubleSpinBox*>()->setValue(value);
  }

  std::unique_ptr<scenegraph::Executor> executor_ = scenegraph::makeSynchronousExecutor();
  ViewPanel panel_;
};

TEST_F(ViewHistoryTest, OneStepASettingAndBackAgain) {
  EXPECT_FALSE(stack().canUndo());
  set("/points", "opacity", 0.5);
  set("tf", "axis_length", 2.0);
  ASSERT_EQ(stack().count(), 2);
  EXPECT_TRUE(stack().undoText().endsWith(QStringLiteral(" of TF"))) << stack().undoText().toStdString();
  stack().undo();
  EXPECT_EQ(setting("tf", "axis_length"), "0.3");
  EXPECT_EQ(setting("/points", "opacity"), "0.5");
  stack().undo();
  EXPECT_EQ(setting("/points", "opacity"), "1");
  EXPECT_EQ(tree().settingRows("/points")->editor("opacity")->findChild<QDoubleSpinBox*>()->value(), 1.0);
  stack().redo();
  stack().redo();
  EXPECT_EQ(setting("/points", "opacity"), "0.5");
  EXPECT_EQ(setting("tf", "axis_length"), "2");
  EXPECT_FALSE(stack().canRedo());
}

TEST_F(ViewHistoryTest, ASliderDraggedIsOneStep) {
  for (const double opacity : {0.9, 0.8, 0.4}) {
    set("/points", "opacity", opacity);
  }
  EXPECT_EQ(stack().count(), 1);
  stack().undo();
  EXPECT_EQ(setting("/points", "opacity"), "1");
  set("/points", "opacity", 0.7);
  set("/points", "opacity", 1.0);
  EXPECT_EQ(stack().count(), 0) << "there and back is nothing";
}

TEST_F(ViewHistoryTest, LegendsAreSwitchedWholeAndByLayerAndComeBack) {
  set("/points", "color_field", "z");
  ASSERT_EQ(panel_.legend().entries().size(), 1U);
  auto* const button = panel_.findChild<QToolButton*>(QStringLiteral("legendButton"));
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_TRUE(panel_.legend().isHidden());
  EXPECT_FALSE(panel_.layout().shows_legend);
  stack().undo();
  EXPECT_FALSE(panel_.legend().isHidden());
  EXPECT_TRUE(button->isChecked());
  set("/points", "legend", "false");
  EXPECT_TRUE(panel_.legend().isHidden());
  EXPECT_NE(scene().findLayer("/points")->layer->legend(), std::nullopt) << "what the range editor shows stays";
  stack().undo();
  panel_.view().applyTick();
  EXPECT_FALSE(panel_.legend().isHidden());
}

TEST_F(ViewHistoryTest, LayersComeGoMoveAndHaveNames) {
  tree().selectLayer("/points");
  tree().duplicateCurrent();
  set("/points#2", "opacity", 0.25);
  tree().item("/points#2")->setText(0, QStringLiteral("Faint"));
  tree().item("/points")->setCheckState(0, Qt::Unchecked);
  tree().moveLayer("/points#2", 0);
  tree().selectLayer("/points");
  tree().removeCurrent();
  const auto last = panel_.history().known();
  while (stack().canUndo()) {
    stack().undo();
  }
  ASSERT_EQ(scene().layers().size(), 3U);
  EXPECT_EQ(scene().layers()[2]->id, "/points");
  EXPECT_TRUE(scene().findLayer("/points")->layer->isVisible());
  EXPECT_TRUE(scene().removedTopics().empty());
  while (stack().canRedo()) {
    stack().redo();
  }
  EXPECT_EQ(panel_.history().known(), last);
  EXPECT_EQ(scene().layers()[0]->title, "Faint");
  EXPECT_EQ(setting("/points#2", "opacity"), "0.25");
  EXPECT_EQ(scene().findLayer("/points"), nullptr);
}

TEST_F(ViewHistoryTest, FrameEffectsCameraAndHiddenFramesAreSettingsToo) {
  Q_EMIT panel_.framePicker().picked("base_link");
  EXPECT_EQ(scene().fixedFrame(), "base_link");
  panel_.effectPanel().item("edl")->setCheckState(0, Qt::Checked);
  panel_.view().setCameraKind(scenegraph::CameraKind::TopDownOrtho);
  panel_.setHiddenFrames({"lidar"});
  ASSERT_EQ(stack().count(), 4);
  stack().undo();
  EXPECT_TRUE(panel_.hiddenFrames().empty());
  stack().undo();
  EXPECT_EQ(panel_.view().camera().rig().kind(), scenegraph::CameraKind::Orbit);
  stack().undo();
  EXPECT_FALSE(panel_.view().effects().isOn("edl"));
  EXPECT_EQ(panel_.effectPanel().item("edl")->checkState(0), Qt::Unchecked);
  stack().undo();
  EXPECT_EQ(scene().fixedFrame(), "map");
  EXPECT_FALSE(scene().isFixedFrameExplicit());
}

TEST_F(ViewHistoryTest, MovingTheCameraIsNoStepAndStaysWhereItIs) {
  set("/points", "opacity", 0.5);
  panel_.view().lookFrom({0.0, 0.0, 1.0});
  const auto eye = panel_.view().camera().state();
  stack().undo();
  EXPECT_EQ(panel_.view().camera().state(), eye);
  EXPECT_EQ(stack().count(), 1);
}

TEST_F(ViewHistoryTest, WhatCameByItselfMeanwhileStays) {
  set("/points", "opacity", 0.5);
  ASSERT_TRUE(scene().addLayer("/points#2"));  // as a topic that appears would
  panel_.view().applyTick();
  test::settle();
  set("/points", "opacity", 0.1);
  stack().undo();
  stack().undo();
  EXPECT_NE(scene().findLayer("/points#2"), nullptr);
}

TEST_F(ViewHistoryTest, KeysWorkAnywhereInTheView) {
  panel_.activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&panel_));
  tree().item("/points")->setExpanded(true);
  set("/points", "opacity", 0.5);
  panel_.view().setFocus();
  QTest::keyClick(&panel_.view(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(setting("/points", "opacity"), "1");
  QTest::keyClick(&panel_.view(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(setting("/points", "opacity"), "0.5");
  auto* box = tree().settingRows("/points")->editor("opacity")->findChild<QDoubleSpinBox*>();
  box->setFocus();
  QTest::keyClick(box, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(setting("/points", "opacity"), "1") << "also from the box that was just edited";
}

TEST_F(ViewHistoryTest, AnotherDatasetBeginsAnew) {
  set("/points", "opacity", 0.5);
  panel_.setDataset(test::makeRobotDataset(), *executor_, {});
  EXPECT_FALSE(stack().canUndo());
}

TEST_F(ViewHistoryTest, TheLegendIsThereWhileSomethingIsColouredByValue) {
  ASSERT_EQ(panel_.legend().entries().size(), 1U);
  EXPECT_EQ(panel_.legend().entries()[0].legend.title, "z in map");
  EXPECT_EQ(panel_.legend().entries()[0].legend.unit, "m");
  EXPECT_TRUE(panel_.legend().isVisible());
  const QRect corner = panel_.legend().geometry();
  EXPECT_TRUE(panel_.view().rect().contains(corner));
  EXPECT_GT(corner.left(), panel_.view().width() / 2);
  ASSERT_TRUE(scene().findLayer("/points")->layer->applySettings({{"color_field", "flat"}}));
  panel_.view().applyTick();
  test::settle();
  EXPECT_TRUE(panel_.legend().entries().empty());
  EXPECT_FALSE(panel_.legend().isVisible());
}

TEST_F(ViewHistoryTest, MeasuredDrawTimesAreShownUntilSomethingChanges) {
  ASSERT_TRUE(test::waitFor([&] { return panel_.view().framesDrawn() > 0; }));
  tree().item("/points")->setExpanded(true);
  const auto cost = [&] {
    for (int i = 0; i < tree().item("/points")->childCount(); ++i) {
      if (const QString text = tree().item("/points")->child(i)->text(0); text.contains(QStringLiteral("vertices"))) {
        return text;
      }
    }
    return QString();
  };
  EXPECT_TRUE(cost().startsWith(QStringLiteral("1,681 vertices in 1 draw call"))) << cost().toStdString();
  EXPECT_TRUE(cost().contains(QStringLiteral("decoded in")));
  Q_EMIT panel_.layerPanel().drawTimesRequested();
  EXPECT_FALSE(cost().contains(QStringLiteral("drawn in"))) << "a frame an event, from the event loop";
  EXPECT_TRUE(test::waitFor([&] { return cost().contains(QStringLiteral("drawn in")); })) << cost().toStdString();
  test::settle();
  EXPECT_TRUE(cost().contains(QStringLiteral("drawn in")));
  set("/points", "opacity", 0.5);
  panel_.view().applyTick();
  EXPECT_FALSE(cost().contains(QStringLiteral("drawn in")));
}

}  // namespace
}  // namespace stillframe::viewer
