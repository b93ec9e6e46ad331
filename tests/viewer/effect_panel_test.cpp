#include "viewer/view/effect_panel.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QTest>
#include <QToolButton>

#include "tests/viewer/viewer_support.h"
#include "viewer/layers/setting_editor.h"
#include "viewer/view/view_panel.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {
namespace {

TEST(EffectPanel, ListsEveryEffectWithItsSettings) {
  const EffectPanel panel;
  ASSERT_EQ(static_cast<std::size_t>(panel.topLevelItemCount()), scenegraph::effectTypes().size());
  for (const auto& type : scenegraph::effectTypes()) {
    const std::string name(type.name);
    ASSERT_NE(panel.item(name), nullptr);
    EXPECT_EQ(panel.item(name)->checkState(0), Qt::Unchecked);
    EXPECT_TRUE(panel.item(name)->isFirstColumnSpanned()) << "no label is cut off for a column without anything";
    EXPECT_EQ(static_cast<std::size_t>(panel.item(name)->childCount()), type.specs.size());
  }
}

TEST(EffectPanel, ChecksAndEditsReachTheValue) {
  EffectPanel panel;
  int changes = 0;
  QObject::connect(&panel, &EffectPanel::changed, &panel, [&] { ++changes; });
  panel.item("ssao")->setCheckState(0, Qt::Checked);
  EXPECT_TRUE(panel.effects().isOn("ssao"));
  EXPECT_EQ(changes, 1);
  panel.editor("ssao", "intensity")->findChild<QDoubleSpinBox*>()->setValue(2.0);
  EXPECT_EQ(panel.effects().settings("ssao").at("intensity"), "2");
  EXPECT_EQ(changes, 2);
  QTest::keyClick(panel.editor("tonemap", "curve")->findChild<QComboBox*>(), Qt::Key_Up);
  EXPECT_EQ(panel.effects().settings("tonemap").at("curve"), "aces");
}

TEST(EffectPanel, ShowingAValueReportsNothing) {
  EffectPanel panel;
  int changes = 0;
  QObject::connect(&panel, &EffectPanel::changed, &panel, [&] { ++changes; });
  scenegraph::ViewEffects effects;
  effects.setOn("edl", true);
  ASSERT_TRUE(effects.apply("edl", {{"strength", "1.23456789012"}}));
  panel.setEffects(effects);
  EXPECT_EQ(changes, 0);
  EXPECT_EQ(panel.effects(), effects);
  EXPECT_EQ(panel.item("edl")->checkState(0), Qt::Checked);
}

TEST(ViewPanelEffects, AreDrawnSavedAndRestored) {
  const auto executor = scenegraph::makeSynchronousExecutor();
  ViewPanel panel;
  panel.resize(600, 400);
  panel.setDataset(test::makeRobotDataset(), *executor, {});
  panel.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
  panel.findChild<QToolButton*>(QStringLiteral("effects"))->click();
  EXPECT_TRUE(panel.effectPanel().isVisible());
  for (const auto& type : scenegraph::effectTypes()) {
    panel.effectPanel().item(std::string(type.name))->setCheckState(0, Qt::Checked);
  }
  const auto frames = panel.view().framesDrawn();
  EXPECT_TRUE(QTest::qWaitFor([&] { return panel.view().framesDrawn() > frames; }));
  EXPECT_EQ(panel.view().problem(), QString());
  EXPECT_EQ(panel.view().glMessages(), 0U);

  const scenegraph::ViewLayout layout = panel.layout();
  EXPECT_EQ(layout.effects.at("ssao"), "true");
  EXPECT_TRUE(layout.shows_effects);
  ViewPanel other;
  other.setDataset(test::makeRobotDataset(), *executor, {});
  other.restore(layout);
  EXPECT_EQ(other.view().effects(), panel.view().effects());
  EXPECT_EQ(other.effectPanel().effects(), panel.view().effects());
  EXPECT_EQ(other.layout().effects, layout.effects);
}

}  // namespace
}  // namespace stillframe::viewer
