// The window by keys alone.
#include <gtest/gtest.h>

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QShortcut>
#include <QTest>
#include <QToolButton>
#include <map>

#include "tests/viewer/open_window.h"
#include "tests/viewer/viewer_support.h"
#include "viewer/frames/frame_picker.h"
#include "viewer/frames/frame_tree.h"
#include "viewer/layers/editor_keys.h"
#include "viewer/layers/layer_panel.h"
#include "viewer/layers/layer_tree.h"
#include "viewer/layers/setting_editor.h"
#include "viewer/layers/setting_rows.h"
#include "viewer/pick/hover_label.h"
#include "viewer/pick/view_picks.h"
#include "viewer/time/time_bar.h"
#include "viewer/view/effect_panel.h"
#include "viewer/view/view_history.h"
#include "viewer/view/view_panel.h"
#include "viewer/window/message_bar.h"
#include "viewer/window/view_window.h"

namespace stillframe::viewer {
namespace {

using test::settle;

class KeyboardTest : public test::OpenWindowTest {
 protected:
  void openActive() {
    open();
    activate();
    settle();
  }
  /// To whatever has the focus.
  static void key(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    ASSERT_NE(QApplication::focusWidget(), nullptr);
    QTest::keyClick(QApplication::focusWidget(), key, modifiers);
    settle();
  }
  static QString focused() {
    const QWidget* const widget = QApplication::focusWidget();
    return widget == nullptr ? QString() : widget->objectName();
  }
  LayerTree& layers() { return window_->views().front()->layerPanel().tree(); }
  scenegraph::SettingTexts settings(const char* id) { return view().scene()->findLayer(id)->layer->settings(); }
  /// The row of that setting becomes the current one.
  void goToSetting(const char* id, const char* setting) {
    layers().item(id)->setExpanded(true);
    SettingEditor* const editor = layers().settingRows(id)->editor(setting);
    ASSERT_NE(editor, nullptr) << setting;
    for (QTreeWidgetItemIterator row(&layers()); *row != nullptr; ++row) {
      if (layers().itemWidget(*row, 1) == editor) {
        layers().setCurrentItem(*row);
      }
    }
    layers().setFocus();
    ASSERT_EQ(layers().itemWidget(layers().currentItem(), 1), editor);
  }
};

TEST_F(KeyboardTest, TheViewHasTheKeysFromTheFirstMoment) {
  openActive();
  EXPECT_EQ(QApplication::focusWidget(), &view());
}

TEST_F(KeyboardTest, EscapeClosesTheHelpOfTheViewThatHasTheFocus) {
  openActive();
  QWidget* const help = view().findChild<QWidget*>(QStringLiteral("help"));
  key(Qt::Key_F1);
  EXPECT_TRUE(help->isVisible());
  key(Qt::Key_Escape);
  EXPECT_FALSE(help->isVisible());
}

TEST_F(KeyboardTest, TabGoesThroughTheControlsAsTheyAreLaidOut) {
  openActive();
  layers().item("/points")->setExpanded(true);
  settle();
  std::vector<QWidget*> visited;
  do {
    visited.push_back(QApplication::focusWidget());
    key(Qt::Key_Tab);
  } while (QApplication::focusWidget() != &view() && visited.size() < 200);
  ASSERT_EQ(QApplication::focusWidget(), &view()) << "round and back";
  const auto place = [&](const QWidget* widget) { return std::ranges::find(visited, widget) - visited.begin(); };
  const auto placeOf = [&](const char* name) {
    return std::ranges::find(visited, QLatin1String(name), &QObject::objectName) - visited.begin();
  };
  const auto count = static_cast<std::ptrdiff_t>(visited.size());
  const std::vector<std::ptrdiff_t> places = {
      placeOf("stepBack"),   placeOf("timeSlider"), placeOf("nanoseconds"), placeOf("frameFilter"), placeOf("frames"),
      placeOf("copyPose"),   placeOf("layers"),     placeOf("fixedFrame"),  placeOf("cameraKind"),  placeOf("views"),
      placeOf("splitRight"), placeOf("addLayer"),   place(&layers())};
  EXPECT_TRUE(std::ranges::is_sorted(places));
  EXPECT_LT(places.back(), count);
  // Every editor of the open layer, in the order of its rows, right behind the tree.
  std::ptrdiff_t last = place(&layers());
  int editors = 0;
  for (QTreeWidgetItemIterator row(&layers()); *row != nullptr; ++row) {
    QWidget* const editor = layers().itemWidget(*row, 1);
    QWidget* const control = editor == nullptr || !editor->isVisible() ? nullptr : firstControl(*editor);
    if (control != nullptr) {
      EXPECT_GT(place(control), last);
      EXPECT_LT(place(control), count);
      last = place(control);
      ++editors;
    }
  }
  EXPECT_GT(editors, 6);
}

TEST_F(KeyboardTest, EnterGoesIntoTheEditorOfARowAndEscapeBackAndThenToTheView) {
  openActive();
  goToSetting("/points", "point_size");
  key(Qt::Key_Return);
  auto* const box = qobject_cast<QAbstractSpinBox*>(QApplication::focusWidget());
  ASSERT_NE(box, nullptr);
  QTest::keyClicks(box, QStringLiteral("7"));
  EXPECT_EQ(box->text(), QStringLiteral("7")) << "written over what was there";
  key(Qt::Key_Escape);
  EXPECT_EQ(QApplication::focusWidget(), &layers());
  EXPECT_NE(settings("/points")["point_size"], "7") << "half typed";
  EXPECT_NE(box->text(), QStringLiteral("7"));
  key(Qt::Key_F2);
  QTest::keyClicks(QApplication::focusWidget(), QStringLiteral("7"));
  key(Qt::Key_Return);
  EXPECT_EQ(settings("/points")["point_size"], "7");
  key(Qt::Key_Escape);
  key(Qt::Key_Escape);
  EXPECT_EQ(QApplication::focusWidget(), &view());
}

TEST_F(KeyboardTest, TheRowWhoseEditorHasTheFocusIsTheCurrentOne) {
  openActive();
  layers().selectLayer("grid");
  layers().item("/points")->setExpanded(true);
  EXPECT_EQ(layers().currentLayer(), "/points") << "what is opened is meant";
  layers().selectLayer("grid");
  QWidget* const box = firstControl(*layers().settingRows("/points")->editor("point_size"));
  QTest::mouseClick(box, Qt::LeftButton);
  EXPECT_EQ(layers().currentLayer(), "/points") << "else Remove would remove the grid";
  key(Qt::Key_Return);
  EXPECT_EQ(QApplication::focusWidget(), box) << "and Enter would go into another row";
}

TEST_F(KeyboardTest, AFrameThatIsHalfTypedIsForgottenAWholeOneIsTaken) {
  openActive();
  FramePicker& picker = window_->views().front()->framePicker();
  picker.setFocus();
  picker.lineEdit()->selectAll();
  QTest::keyClicks(picker.lineEdit(), QStringLiteral("xyz"));
  key(Qt::Key_Tab);
  EXPECT_NE(QApplication::focusWidget(), &picker);
  EXPECT_EQ(picker.currentText(), QStringLiteral("auto (map)")) << "the frame in use";
  EXPECT_EQ(view().scene()->fixedFrame(), "map");
  picker.setFocus();
  picker.lineEdit()->selectAll();
  QTest::keyClicks(picker.lineEdit(), QStringLiteral("base_link"));
  key(Qt::Key_Return);
  EXPECT_EQ(picker.currentText(), QStringLiteral("base_link"));
  EXPECT_EQ(view().scene()->fixedFrame(), "base_link");
}

TEST_F(KeyboardTest, SpaceTicksTheBoxOfARow) {
  openActive();
  goToSetting("/points", "legend");
  EXPECT_TRUE(layers().currentItem()->isSelected()) << "one sees where one is";
  const std::string before = settings("/points")["legend"];
  key(Qt::Key_Space);
  EXPECT_NE(settings("/points")["legend"], before);
  EXPECT_EQ(QApplication::focusWidget(), &layers());
  EXPECT_FALSE(window_->timeBar().isPlaying());
}

TEST_F(KeyboardTest, EffectsAreReachedAsLayersAre) {
  openActive();
  ViewPanel& panel = *window_->views().front();
  panel.findChild<QToolButton*>(QStringLiteral("effects"))->click();
  settle();
  key(Qt::Key_F6);
  EXPECT_EQ(QApplication::focusWidget(), &layers());
  key(Qt::Key_F6);
  ASSERT_EQ(QApplication::focusWidget(), &panel.effectPanel());
  panel.effectPanel().setCurrentItem(panel.effectPanel().item("edl"));
  key(Qt::Key_Space);
  EXPECT_TRUE(view().effects().isOn("edl"));
  key(Qt::Key_Down);
  EXPECT_TRUE(panel.effectPanel().currentItem()->isSelected());
  key(Qt::Key_Return);
  EXPECT_TRUE(panel.effectPanel().isAncestorOf(QApplication::focusWidget()));
  EXPECT_NE(QApplication::focusWidget(), &panel.effectPanel());
}

TEST_F(KeyboardTest, F6GoesRoundThePanels) {
  openActive();
  key(Qt::Key_F6);
  EXPECT_EQ(QApplication::focusWidget(), &layers());
  EXPECT_NE(layers().currentItem(), nullptr);
  EXPECT_EQ(layers().selectedItems().size(), 1) << "one sees where the keys go";
  key(Qt::Key_F6);
  EXPECT_EQ(focused(), QStringLiteral("frames"));
  EXPECT_EQ(qobject_cast<QTreeWidget*>(QApplication::focusWidget())->selectedItems().size(), 1);
  key(Qt::Key_F6);
  EXPECT_EQ(focused(), QStringLiteral("timeSlider"));
  key(Qt::Key_F6);
  EXPECT_EQ(QApplication::focusWidget(), &view());
  key(Qt::Key_F6, Qt::ShiftModifier);
  EXPECT_EQ(focused(), QStringLiteral("timeSlider"));
}

TEST_F(KeyboardTest, ViewsAreSplitChangedDetachedAndClosedByKeys) {
  openActive();
  key(Qt::Key_W, Qt::ControlModifier);
  EXPECT_EQ(window_->views().size(), 1U);
  EXPECT_TRUE(window_->messageBar().text().contains(QStringLiteral("last view")));
  window_->messageBar().hide();
  key(Qt::Key_Right, Qt::ControlModifier | Qt::ShiftModifier);
  key(Qt::Key_Down, Qt::ControlModifier | Qt::ShiftModifier);
  ASSERT_EQ(window_->views().size(), 3U);
  EXPECT_EQ(QApplication::focusWidget(), &view(2)) << "the new one";
  key(Qt::Key_Tab, Qt::ControlModifier);
  EXPECT_EQ(QApplication::focusWidget(), &view(0));
  for (const ViewPanel* const panel : window_->views()) {
    EXPECT_EQ(panel->findChild<QWidget*>(QStringLiteral("mark"))->backgroundRole() == QPalette::Highlight,
              panel == window_->views().front())
        << "one sees which one it is";
  }
  key(Qt::Key_Backtab, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(QApplication::focusWidget(), &view(2));
  key(Qt::Key_W, Qt::ControlModifier);
  ASSERT_EQ(window_->views().size(), 2U);
  window_->views()[1]->view().setFocus();
  key(Qt::Key_D, Qt::ControlModifier | Qt::ShiftModifier);
  ASSERT_EQ(window_->viewSet().windows().size(), 1U);
  QWidget* const detached = window_->viewSet().windows().front();
  EXPECT_EQ(detached->windowTitle(), QStringLiteral("View 2 of test - Stillframe"));
  ASSERT_TRUE(QTest::qWaitForWindowActive(detached));
  activate();  // the frames panel is about the view in the other window
  window_->frameTree().filter().setFocus();
  key(Qt::Key_Escape);
  ASSERT_TRUE(QTest::qWaitForWindowActive(detached));
  EXPECT_EQ(QApplication::focusWidget(), &view(1));
  key(Qt::Key_Right, Qt::ControlModifier | Qt::ShiftModifier);  // its own window has no menu
  ASSERT_EQ(window_->views().size(), 3U);
  EXPECT_EQ(detached->windowTitle(), QStringLiteral("Views 2, 3 of test - Stillframe"));
  key(Qt::Key_W, Qt::ControlModifier);
  EXPECT_EQ(window_->views().size(), 2U);
  EXPECT_EQ(detached->windowTitle(), QStringLiteral("View 2 of test - Stillframe"));
}

TEST_F(KeyboardTest, ThePointInTheMiddleIsPickedAndMeasured) {
  openActive();
  for (const auto& slot : view().scene()->layers()) {
    slot->layer->setVisible(false);
  }
  view().requestTick();
  settle();
  key(Qt::Key_P);
  EXPECT_FALSE(view().picks().selected());
  const HoverLabel& label = *view().findChild<HoverLabel*>(QStringLiteral("hover"));
  EXPECT_TRUE(label.text().contains(QStringLiteral("nothing")));
  EXPECT_TRUE(label.isVisible());
  key(Qt::Key_Question);
  EXPECT_FALSE(label.isVisible()) << "it would lie over the help";
  key(Qt::Key_Escape);
  view().scene()->findLayer("/points")->layer->setVisible(true);
  view().scene()->findLayer("grid")->layer->setVisible(true);
  view().requestTick();
  view().setSmoothMoves(false);
  view().home();
  settle();
  key(Qt::Key_P);
  const auto first = view().picks().selected();
  ASSERT_TRUE(first);
  EXPECT_TRUE(view().picks().measured().empty());
  key(Qt::Key_Left, Qt::ShiftModifier);
  key(Qt::Key_P, Qt::ShiftModifier);
  ASSERT_EQ(view().picks().measured().size(), 1U);
  EXPECT_EQ(view().picks().measured().front().first.picked.id, first->picked.id);
  key(Qt::Key_Delete);
  EXPECT_FALSE(view().picks().selected());
}

TEST_F(KeyboardTest, WhatTheFramesPanelChangesIsUndoneWhereItWasChanged) {
  openActive();
  auto* const frames = window_->frameTree().findChild<QTreeWidget*>(QStringLiteral("frames"));
  frames->setCurrentItem(window_->frameTree().item("lidar"));
  frames->setFocus();
  key(Qt::Key_Space);
  ViewPanel& panel = *window_->views().front();
  EXPECT_EQ(panel.hiddenFrames(), ViewPanel::FrameNames{"lidar"});
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(panel.hiddenFrames().empty());
  key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(panel.hiddenFrames(), ViewPanel::FrameNames{"lidar"});
}

TEST_F(KeyboardTest, NoTwoKeysOfTheWindowAreTheSame) {
  openActive();
  std::map<QString, int> uses;
  const auto count = [&](const QList<QKeySequence>& keys) {
    for (const QKeySequence& sequence : keys) {
      ++uses[sequence.toString()];
    }
  };
  for (const QAction* const action : window_->findChildren<QAction*>()) {
    count(action->shortcuts());
  }
  for (const QShortcut* const shortcut : window_->findChildren<QShortcut*>()) {
    if (shortcut->context() != Qt::WidgetShortcut && shortcut->context() != Qt::WidgetWithChildrenShortcut) {
      count(shortcut->keys());
    }
  }
  EXPECT_GT(uses.size(), 15U);
  for (const auto& [keys, times] : uses) {
    EXPECT_EQ(times, 1) << keys.toStdString();
  }
}

}  // namespace
}  // namespace stillframe::viewer
