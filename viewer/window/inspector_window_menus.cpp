// Menus and keys of the inspector: what they do from any of its windows.
#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenuBar>
#include <QShortcut>
#include <algorithm>
#include <iterator>

#include "viewer/frames/frame_tree.h"
#include "viewer/layers/layer_panel.h"
#include "viewer/layers/layer_tree.h"
#include "viewer/pick/inspect_dock.h"
#include "viewer/time/time_bar.h"
#include "viewer/view/effect_panel.h"
#include "viewer/view/view_history.h"
#include "viewer/widget/help_overlay.h"
#include "viewer/widget/scene_widget.h"
#include "viewer/window/inspector_window.h"
#include "viewer/window/message_bar.h"
#include "viewer/window/picture_dialog.h"
#include "viewer/window/picture_saver.h"
#include "viewer/window/theme.h"

namespace stillframe::viewer {
namespace {

/// Windows of detached views have no menus: what the menu of the main window can do, its keys do there too.
void reachFromEveryWindow(QMenu& menu) {
  for (QAction* const action : menu.actions()) {
    action->setShortcutContext(Qt::ApplicationShortcut);
  }
}

}  // namespace

void InspectorWindow::buildMenus() {
  QMenu* file = menuBar()->addMenu(tr("&File"));
  QAction* open = file->addAction(tr("&Open..."));
  open->setShortcut(QKeySequence::Open);
  connect(open, &QAction::triggered, this, [this] {
    std::vector<std::filesystem::path> files;
    for (const QString& name : QFileDialog::getOpenFileNames(this, tr("Open recordings"), {},
                                                             tr("MCAP recordings (*.mcap);;All files (*)"))) {
      files.emplace_back(name.toStdString());
    }
    if (!files.empty()) {
      openFiles(std::move(files));
    }
  });
  auto* saver = new PictureSaver(*executor_, this);
  addPictureActions(*file, *this, *saver, [this]() -> ViewPanel& { return activeView(); });
  connect(saver, &PictureSaver::failed, messages_, &MessageBar::warn);
  buildLayoutMenu(*file);
  QAction* quit = file->addAction(tr("&Quit"));
  quit->setShortcut(QKeySequence::Quit);
  connect(quit, &QAction::triggered, this, &QWidget::close);
  reachFromEveryWindow(*file);

  QMenu* edit = menuBar()->addMenu(tr("&Edit"));  // the keys are those of each view
  QAction* undo = edit->addAction(QString(), this, [this] { activeView().history().stack().undo(); });
  QAction* redo = edit->addAction(QString(), this, [this] { activeView().history().stack().redo(); });
  connect(edit, &QMenu::aboutToShow, this, [this, undo, redo] {
    const QUndoStack& stack = activeView().history().stack();
    undo->setText(tr("&Undo %1\tCtrl+Z").arg(stack.undoText()));
    undo->setEnabled(stack.canUndo());
    redo->setText(tr("&Redo %1\tCtrl+Shift+Z").arg(stack.redoText()));
    redo->setEnabled(stack.canRedo());
  });
  buildViewMenu();
}

void InspectorWindow::buildViewMenu() {
  QMenu* view = menuBar()->addMenu(tr("&View"));
  const auto add = [&](const QString& text, const char* name, const QKeySequence& keys, auto action) {
    QAction* const entry = view->addAction(text, this, action);
    entry->setObjectName(QLatin1String(name));
    entry->setShortcut(keys);
    return entry;
  };
  constexpr auto kBoth = Qt::CTRL | Qt::SHIFT;
  add(tr("Add view to the &right"), "addRight", kBoth | Qt::Key_Right,
      [this] { addView(&activeView(), Qt::Horizontal).view().setFocus(); });
  add(tr("Add view &below"), "addBelow", kBoth | Qt::Key_Down,
      [this] { addView(&activeView(), Qt::Vertical).view().setFocus(); });
  add(tr("&Detach view into a window"), "detachView", kBoth | Qt::Key_D, [this] {
    if (views_->detach(activeView())) {
      activeView().activateWindow();
      activeView().view().setFocus();
    }
  });
  QAction* const close = add(tr("&Close view"), "closeView", Qt::CTRL | Qt::Key_W, [this] {
    if (views_->close(activeView())) {
      activeView().activateWindow();
      activeView().view().setFocus();
    }
  });
  connect(view, &QMenu::aboutToShow, this, [this, close] { close->setEnabled(views().size() > 1); });
  connect(view, &QMenu::aboutToHide, close, [close] { close->setEnabled(true); });  // for its keys
  view->addSeparator();
  add(tr("&Next view"), "nextView", Qt::CTRL | Qt::Key_Tab, [this] { focusNextView(1); });
  add(tr("&Previous view"), "previousView", kBoth | Qt::Key_Backtab, [this] { focusNextView(-1); });
  add(tr("Ne&xt panel"), "nextPanel", Qt::Key_F6, [this] { focusNextPanel(1); });
  add(tr("Previ&ous panel"), "previousPanel", Qt::SHIFT | Qt::Key_F6, [this] { focusNextPanel(-1); });
  view->addSeparator();
  view->addAction(findChild<QDockWidget*>(QStringLiteral("framesDock"))->toggleViewAction());
  view->addAction(inspect_->toggleViewAction());
  addThemeMenu(*view);
  reachFromEveryWindow(*view);
}

void InspectorWindow::buildShortcuts(QWidget& window) {
  const auto bind = [&](const QKeySequence& keys, auto action) {
    connect(new QShortcut(keys, &window), &QShortcut::activated, this, action);
  };
  bind(Qt::Key_Space, [this] { time_bar_->togglePlaying(); });
  bind(Qt::Key_Left, [this] { time_bar_->step(-1); });
  bind(Qt::Key_Right, [this] { time_bar_->step(1); });
  bind(Qt::Key_Escape, [this] {
    SceneWidget& view = activeView().view();
    if (view.hasFocus()) {
      view.findChild<HelpOverlay*>()->setShown(false);
    }
    activeView().activateWindow();
    view.setFocus();
  });
  if (&window == this) {  // the views have theirs: what the frames panel changes is a setting of the active one
    for (QWidget* const panel : std::initializer_list<QWidget*>{frame_tree_, inspect_, time_bar_}) {
      const auto bind_undo = [&](const QKeySequence& keys, auto action) {
        auto* const shortcut = new QShortcut(keys, panel);
        shortcut->setContext(Qt::WidgetWithChildrenShortcut);
        connect(shortcut, &QShortcut::activated, this, action);
      };
      bind_undo(Qt::CTRL | Qt::Key_Z, [this] { activeView().history().stack().undo(); });
      bind_undo(Qt::CTRL | Qt::SHIFT | Qt::Key_Z, [this] { activeView().history().stack().redo(); });
    }
  }
}

void InspectorWindow::focusNextView(int step) {
  const auto& all = views();
  const auto at = std::ranges::find(all, &activeView()) - all.begin();
  const auto count = static_cast<std::ptrdiff_t>(all.size());
  ViewPanel& next = *all[static_cast<std::size_t>((at + step + count) % count)];
  next.activateWindow();
  next.view().setFocus(Qt::ShortcutFocusReason);
}

/// Round the window: picture, layers, effects, frames, what is picked, time.
void InspectorWindow::focusNextPanel(int step) {
  struct Panel {
    QWidget* whole;
    QWidget* first;
  };
  ViewPanel& active = activeView();
  const auto table = [](QWidget& within, const char* name) { return within.findChild<QWidget*>(QLatin1String(name)); };
  std::vector<Panel> panels = {{&active.view(), &active.view()},
                               {&active.layerPanel(), &active.layerPanel().tree()},
                               {&active.effectPanel(), &active.effectPanel()},
                               {frame_tree_, table(*frame_tree_, "frames")},
                               {inspect_, table(*inspect_, "pickRows")},
                               {time_bar_, &time_bar_->slider()}};
  std::erase_if(panels, [](const Panel& panel) { return !panel.whole->isVisible(); });
  const QWidget* const focus = QApplication::focusWidget();
  const auto at = std::ranges::find_if(
      panels, [focus](const Panel& panel) { return panel.whole == focus || panel.whole->isAncestorOf(focus); });
  const auto count = static_cast<std::ptrdiff_t>(panels.size());
  const auto here = at == panels.end() ? 0 : at - panels.begin();
  const Panel& next = panels[static_cast<std::size_t>((here + step + count) % count)];
  next.whole->activateWindow();
  next.first->setFocus(Qt::ShortcutFocusReason);
  if (auto* const rows = qobject_cast<QTreeWidget*>(next.first); rows != nullptr && rows->selectedItems().isEmpty()) {
    // Qt makes the first one current with the focus, but hardly shows it.
    rows->setCurrentItem(rows->currentItem() != nullptr ? rows->currentItem() : rows->topLevelItem(0), 0,
                         QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
  }
}

}  // namespace stillframe::viewer
