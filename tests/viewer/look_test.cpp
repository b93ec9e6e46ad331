// What every window is judged by: colours, keys, names for screen readers, pictures of it, and how long it keeps still.
#include <gtest/gtest.h>

#include <QAccessible>
#include <QAction>
#include <QComboBox>
#include <QDBusVariant>
#include <QDockWidget>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QSettings>
#include <QTest>
#include <QTimer>
#include <QToolButton>
#include <QTreeWidget>
#include <set>

#include "tests/viewer/open_window.h"
#include "tests/viewer/viewer_support.h"
#include "viewer/frames/frame_tree.h"
#include "viewer/time/time_bar.h"
#include "viewer/window/desktop_colors.h"
#include "viewer/window/icons.h"
#include "viewer/window/message_bar.h"
#include "viewer/window/stall_monitor.h"
#include "viewer/window/theme.h"

namespace stillframe::viewer {
namespace {

using test::settle;
using test::waitFor;

class Look : public test::OpenWindowTest {
 protected:
  void open(InspectorOptions options = {.files = {"robot.mcap"}}) {
    OpenWindowTest::open(std::move(options));
    activate();
  }
  void TearDown() override {
    applyTheme(Theme::System);
    OpenWindowTest::TearDown();
  }
};

TEST_F(Look, ThemesAreSwitchedInTheMenuAndRemembered) {
  open();
  const auto lightness = [&] { return window_->palette().color(QPalette::Window).lightnessF(); };
  QMenu* const themes = window_->findChild<QMenu*>(QStringLiteral("themes"));
  ASSERT_NE(themes, nullptr);
  ASSERT_EQ(themes->actions().size(), 3);
  themes->actions().at(2)->trigger();
  settle();
  EXPECT_LT(lightness(), 0.3F);
  EXPECT_GT(window_->palette().color(QPalette::WindowText).lightnessF(), 0.7F);
  EXPECT_EQ(rememberedTheme(), Theme::Dark);
  themes->actions().at(1)->trigger();
  settle();
  EXPECT_GT(lightness(), 0.8F);
  EXPECT_EQ(rememberedTheme(), Theme::Light);
  themes->actions().at(0)->trigger();
  EXPECT_EQ(rememberedTheme(), Theme::System);
  for (const Theme theme : {Theme::System, Theme::Light, Theme::Dark}) {
    EXPECT_EQ(themeOf(toString(theme)), theme);
  }
  EXPECT_EQ(themeOf("purple"), std::nullopt);
}

TEST_F(Look, TextStandsOutFromItsGroundInBothThemes) {
  // Contrast as WCAG 2 has it: 4.5 for text.
  const auto luminance = [](const QColor& color) {
    const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) + 0.0722 * linear(color.blueF());
  };
  const auto contrast = [&](QPalette::ColorRole text, QPalette::ColorRole ground) {
    const double a = luminance(QApplication::palette().color(text));
    const double b = luminance(QApplication::palette().color(ground));
    return (std::max(a, b) + 0.05) / (std::min(a, b) + 0.05);
  };
  for (const Theme theme : {Theme::Light, Theme::Dark}) {
    applyTheme(theme);
    for (const auto& [text, ground] : {std::pair{QPalette::WindowText, QPalette::Window},
                                       {QPalette::Text, QPalette::Base},
                                       {QPalette::Text, QPalette::AlternateBase},
                                       {QPalette::ButtonText, QPalette::Button},
                                       {QPalette::ToolTipText, QPalette::ToolTipBase}}) {
      EXPECT_GT(contrast(text, ground), 7.0) << toString(theme) << ' ' << text;
    }
    EXPECT_GT(contrast(QPalette::HighlightedText, QPalette::Highlight), 3.0) << toString(theme);
    EXPECT_GT(contrast(QPalette::PlaceholderText, QPalette::Base), 3.0) << toString(theme);
  }
}

TEST_F(Look, TheDesktopsWishIsUnderstood) {
  const auto variant = [](unsigned value) { return QVariant::fromValue(QDBusVariant(value)); };
  EXPECT_EQ(DesktopColors::prefersDark(variant(1)), true);
  EXPECT_EQ(DesktopColors::prefersDark(variant(2)), false);
  EXPECT_EQ(DesktopColors::prefersDark(variant(0)), std::nullopt);
  EXPECT_EQ(DesktopColors::prefersDark(QVariant::fromValue(QDBusVariant(variant(1)))), true) << "as Read() answers";
  EXPECT_EQ(DesktopColors::prefersDark(QStringLiteral("dark")), std::nullopt);
  EXPECT_EQ(DesktopColors::prefersDark({}), std::nullopt);
}

TEST_F(Look, SignsAreSharpAtEveryScaleAndOfTheThemesColour) {
  const auto darkest = [](const QImage& image) {
    qreal value = 1.0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        if (image.pixelColor(x, y).alphaF() > 0.9F) {
          value = std::min<qreal>(value, image.pixelColor(x, y).lightnessF());
        }
      }
    }
    return value;
  };
  const QIcon icon = transportIcon(TransportIcon::Play);
  applyTheme(Theme::Light);
  EXPECT_LT(darkest(icon.pixmap(32, 32).toImage()), 0.3);
  EXPECT_EQ(icon.pixmap(96, 96).width(), 96) << "drawn, not enlarged";
  applyTheme(Theme::Dark);
  EXPECT_GT(darkest(icon.pixmap(32, 32).toImage()), 0.7) << "the same icon";
}

TEST_F(Look, TabReachesEveryControlAndEachHasAName) {
  open();
  std::set<QWidget*> wanted;
  for (QWidget* const widget : window_->findChildren<QWidget*>()) {
    const bool is_control =
        qobject_cast<QToolButton*>(widget) != nullptr || qobject_cast<QComboBox*>(widget) != nullptr ||
        qobject_cast<QSlider*>(widget) != nullptr ||
        (qobject_cast<QLineEdit*>(widget) != nullptr && qobject_cast<QComboBox*>(widget->parentWidget()) == nullptr &&
         qobject_cast<QAbstractSpinBox*>(widget->parentWidget()) == nullptr);
    const bool is_qts_own = widget->objectName().startsWith(QStringLiteral("qt_")) ||
                            qobject_cast<QLineEdit*>(widget->parentWidget()) != nullptr;
    const bool is_within_reach = widget->isVisible() && widget->isEnabled() && !is_qts_own;
    // A dock's own buttons are in its title bar, which the keyboard does not need: the dock is in the View menu.
    if (is_control && is_within_reach && qobject_cast<QDockWidget*>(widget->parentWidget()) == nullptr) {
      wanted.insert(widget);
    }
  }
  ASSERT_GT(wanted.size(), 12U);
  for (QWidget* const widget : wanted) {
    QAccessibleInterface* const said = QAccessible::queryAccessibleInterface(widget);
    ASSERT_NE(said, nullptr);
    EXPECT_FALSE(said->text(QAccessible::Name).isEmpty() && said->text(QAccessible::Value).isEmpty())
        << widget->metaObject()->className() << ' ' << widget->objectName().toStdString();
  }
  view().setFocus();
  for (int i = 0; i < 400 && !wanted.empty(); ++i) {
    QWidget* const focus = QApplication::focusWidget();
    ASSERT_NE(focus, nullptr);
    wanted.erase(focus);
    wanted.erase(focus->parentWidget());
    QTest::keyClick(focus, Qt::Key_Tab);
  }
  for (const QWidget* const widget : wanted) {
    ADD_FAILURE() << "Tab does not come to " << widget->metaObject()->className() << ' '
                  << widget->objectName().toStdString();
  }
}

TEST_F(Look, KeysOfAFocusedControlAreItsOwn) {
  open();
  auto* const loop = window_->findChild<QToolButton*>(QStringLiteral("loop"));
  loop->setFocus();
  QTest::keyClick(loop, Qt::Key_Space);
  EXPECT_TRUE(loop->isChecked());
  EXPECT_FALSE(window_->timeBar().isPlaying());
  auto* const frames = window_->findChild<QTreeWidget*>(QStringLiteral("frames"));
  frames->setFocus();
  frames->setCurrentItem(frames->topLevelItem(0));
  const auto time = window_->timeBar().time();
  QTest::keyClick(frames, Qt::Key_Left);
  EXPECT_FALSE(frames->topLevelItem(0)->isExpanded());
  EXPECT_EQ(window_->timeBar().time(), time);
  view().setFocus();
  QTest::keyClick(&view(), Qt::Key_Space);
  EXPECT_TRUE(window_->timeBar().isPlaying());
}

TEST_F(Look, EveryMenuHasAKeyAndNoTwoActionsShareAShortcut) {
  open();
  std::set<QString> taken;
  for (const QAction* const menu : window_->menuBar()->actions()) {
    EXPECT_TRUE(menu->text().contains(QLatin1Char('&'))) << menu->text().toStdString();
    for (const QAction* const action : menu->menu()->actions()) {
      const QString keys = action->shortcut().toString();
      EXPECT_TRUE(keys.isEmpty() || taken.insert(keys).second) << keys.toStdString();
    }
  }
}

TEST_F(Look, EffectsAskedForAtTheStartAreInEveryView) {
  InspectorOptions options{.files = {"robot.mcap"}, .views = 2};
  options.effects.setOn("edl", true);
  ASSERT_TRUE(options.effects.apply("edl", {{"strength", "2"}}));
  const auto wanted = options.effects;
  open(std::move(options));
  for (ViewPanel* const panel : window_->views()) {
    EXPECT_EQ(panel->view().effects(), wanted);
    EXPECT_EQ(panel->layout().effects, wanted.toTexts());
  }
}

TEST(StallMonitor, CountsWhatIsLongAndNamesIt) {
  StallMonitor monitor;
  QObject slow;
  slow.setObjectName(QStringLiteral("slow"));
  for (int i = 0; i < 99; ++i) {
    monitor.record(slow, QEvent::Timer, 1.0, 0.5);
  }
  monitor.record(slow, QEvent::MetaCall, 80.0, 70.0);
  monitor.record(slow, QEvent::UpdateRequest, 200.0, 20.0);
  EXPECT_EQ(monitor.rest().events(), 100U);
  EXPECT_EQ(monitor.rest().stalls(), 1U);
  EXPECT_EQ(monitor.rest().longest().front().what, "QObject 'slow', MetaCall");
  EXPECT_EQ(monitor.rest().longest().size(), 5U);
  EXPECT_NEAR(monitor.rest().percentile(0.5), 1.0, 0.2);
  EXPECT_EQ(monitor.rest().percentile(1.0), 80.0);
  EXPECT_EQ(monitor.drawing().stalls(), 1U);
  EXPECT_NE(monitor.report().find("80.0 ms, at work     70.0 ms: QObject 'slow', MetaCall"), std::string::npos);
}

TEST(StallMonitor, WatchesTheEventsOfTheApplication) {
  auto* const app = dynamic_cast<MonitoredApplication*>(QCoreApplication::instance());
  ASSERT_NE(app, nullptr);
  StallMonitor monitor;
  app->watch(&monitor);
  QObject sleeper;
  sleeper.setObjectName(QStringLiteral("sleeper"));
  bool is_done = false;
  QTimer::singleShot(0, &sleeper, [&] {
    QThread::msleep(60);
    is_done = true;
  });
  ASSERT_TRUE(waitFor([&] { return is_done; }));
  EXPECT_GE(monitor.rest().stalls(), 1U);
  EXPECT_GE(monitor.rest().longest().front().ms, 60.0);
  EXPECT_LT(monitor.rest().longest().front().cpu_ms, 30.0) << "it slept";
  // A loop within an event keeps nothing waiting: its own events are what counts.
  monitor = {};
  is_done = false;
  QTimer::singleShot(0, &sleeper, [&] {
    QEventLoop loop;
    QTimer::singleShot(120, &loop, &QEventLoop::quit);
    loop.exec();
    is_done = true;
  });
  ASSERT_TRUE(waitFor([&] { return is_done; }));
  app->watch(nullptr);
  EXPECT_EQ(monitor.rest().stalls(), 0U) << monitor.report();
  EXPECT_GT(monitor.rest().events(), 0U);
}

}  // namespace
}  // namespace stillframe::viewer
