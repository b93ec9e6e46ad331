#include "viewer/window/view_set.h"

#include <QApplication>
#include <QCursor>
#include <QDrag>
#include <QMimeData>
#include <QPointer>
#include <algorithm>
#include <iterator>
#include <utility>

#include "viewer/view/view_panel.h"
#include "viewer/widget/scene_widget.h"
#include "viewer/window/view_window.h"
#include "viewer/window/window_place.h"

namespace stillframe::viewer {
namespace {

constexpr int kWindowWidth = 800;
constexpr int kWindowHeight = 600;
constexpr int kDragPictureWidth = 240;

}  // namespace

ViewSet::ViewSet(ViewArea& main, FrameMemory& memory, QObject* parent) : QObject(parent), main_(main), memory_(memory) {
  connect(&main_, &ViewArea::dropped, this,
          [this](const QByteArray& token, ViewPanel* beside, Side side) { onDropped(token, *beside, side); });
  connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) {
    for (ViewPanel* const panel : views_) {
      if (now != nullptr && panel->isAncestorOf(now)) {
        activate(*panel);
      }
    }
  });
}

ViewSet::~ViewSet() { clear(); }

void ViewSet::clear() {
  active_ = nullptr;
  for (ViewPanel* const panel : std::exchange(views_, {})) {
    panel->disconnect(this);
    delete panel;
  }
  for (ViewWindow* const window : std::exchange(windows_, {})) {
    window->disconnect(this);
    delete window;
  }
}

void ViewSet::activate(ViewPanel& panel) {
  if (active_ != &panel) {
    active_ = &panel;
    markActive();
    Q_EMIT activeChanged();
  }
}

ViewPanel& ViewSet::make() {
  auto* panel = new ViewPanel;
  panel->setFrameMemory(memory_);
  views_.push_back(panel);
  if (active_ == nullptr) {
    active_ = panel;
  }
  connect(panel, &ViewPanel::closeRequested, this, [this, panel] { close(*panel); });
  connect(panel, &ViewPanel::detachRequested, this, [this, panel] { detach(*panel); });
  connect(panel, &ViewPanel::dragRequested, this, [this, panel] { drag(*panel); });
  Q_EMIT added(panel);
  return *panel;
}

ViewPanel& ViewSet::add(ViewPanel* beside, Side side) {
  ViewPanel& panel = make();
  if (beside != nullptr) {
    panel.hidePanels();  // side by side, the picture needs the room
  }
  (beside == nullptr ? main_ : areaOf(*beside)).insert(panel, beside, side);
  finishArranging();
  return panel;
}

ViewArea& ViewSet::areaOf(const ViewPanel& panel) const {
  for (ViewWindow* const window : windows_) {
    if (window->area().isAncestorOf(&panel)) {
      return window->area();
    }
  }
  return main_;
}

bool ViewSet::takeOut(ViewPanel& panel) {
  ViewArea& area = areaOf(panel);
  if (&area == &main_ && main_.panels().size() == 1) {
    Q_EMIT refused(tr("This is the last view of the main window: it stays there."));
    return false;
  }
  area.take(panel);
  return true;
}

bool ViewSet::close(ViewPanel& panel) {
  if (!takeOut(panel)) {
    return false;
  }
  std::erase(views_, &panel);
  if (active_ == &panel) {
    activate(*views_.front());
  }
  panel.deleteLater();
  finishArranging();
  return true;
}

bool ViewSet::detach(ViewPanel& panel) {
  if (!takeOut(panel)) {
    return false;
  }
  openWindow({.width = kWindowWidth, .height = kWindowHeight}, true).area().insert(panel);
  finishArranging();
  return true;
}

bool ViewSet::move(ViewPanel& panel, ViewPanel& beside, Side side) {
  if (&panel == &beside || !takeOut(panel)) {
    return false;
  }
  areaOf(beside).insert(panel, &beside, side);
  finishArranging();
  return true;
}

ViewWindow& ViewSet::openWindow(const scenegraph::WindowLayout& place, bool is_activated) {
  auto* window = new ViewWindow;
  window->setAttribute(Qt::WA_ShowWithoutActivating, !is_activated);
  windows_.push_back(window);
  bringToPlace(place, *window);
  connect(&window->area(), &ViewArea::dropped, this,
          [this](const QByteArray& token, ViewPanel* beside, Side side) { onDropped(token, *beside, side); });
  connect(window, &ViewWindow::closed, this, [this, window] {
    for (ViewPanel* const panel : window->area().panels()) {
      close(*panel);
    }
  });
  Q_EMIT windowAdded(window);
  window->show();
  return *window;
}

void ViewSet::finishArranging() {
  closeEmptyWindows();
  nameWindows();
  markActive();
  Q_EMIT arranged();
}

void ViewSet::markActive() {
  for (ViewPanel* const panel : views_) {
    panel->setMarked(panel == active_ && views_.size() > 1);
  }
}

void ViewSet::nameWindows() {
  for (ViewWindow* const window : windows_) {
    QStringList numbers;
    QString recording;
    for (ViewPanel* const panel : window->area().panels()) {
      numbers << QString::number(std::ranges::find(views_, panel) - views_.begin() + 1);
      recording = recording.isEmpty() ? QString::fromStdString(panel->layout().dataset) : recording;
    }
    window->setWindowTitle((numbers.size() == 1 ? tr("View %1") : tr("Views %1")).arg(numbers.join(tr(", "))) +
                           (recording.isEmpty() ? QString() : tr(" of %1").arg(recording)) + tr(" - Stillframe"));
  }
}

void ViewSet::closeEmptyWindows() {
  std::erase_if(windows_, [this](ViewWindow* window) {
    const bool is_empty = window->area().panels().empty();
    if (is_empty) {
      window->disconnect(this);
      window->hide();
      window->deleteLater();
    }
    return is_empty;
  });
}

/// Until the button is let go: over a view, which takes it to its side; outside of every window, for one of its own.
void ViewSet::drag(ViewPanel& panel) {
  auto* drag = new QDrag(&panel);  // Qt deletes it
  auto* data = new QMimeData;
  data->setData(QString::fromLatin1(ViewArea::kMimeType), ViewArea::token(panel));
  drag->setMimeData(data);
  drag->setPixmap(panel.grab().scaledToWidth(kDragPictureWidth, Qt::SmoothTransformation));
  const QPointer<ViewPanel> dragged = &panel;
  if (drag->exec(Qt::MoveAction) == Qt::IgnoreAction && dragged != nullptr &&
      QApplication::topLevelAt(QCursor::pos()) == nullptr && detach(panel)) {
    windows_.back()->move(QCursor::pos());
  }
}

void ViewSet::onDropped(const QByteArray& token, ViewPanel& beside, Side side) {
  const auto dragged = std::ranges::find_if(views_, [&](ViewPanel* of) { return ViewArea::token(*of) == token; });
  if (dragged != views_.end() && move(**dragged, beside, side)) {
    (*dragged)->activateWindow();  // the one it came from may have had the focus, and be gone
    (*dragged)->view().setFocus();
  }
}

scenegraph::Layout ViewSet::layout() const {
  scenegraph::Layout layout;
  layout.windows.emplace_back().place = main_.place();
  for (ViewWindow* const window : windows_) {
    scenegraph::WindowLayout& of = layout.windows.emplace_back();
    takePlace(*window, of);
    of.place = window->area().place();
    of.source = window->source;
  }
  std::vector<ViewPanel*> in_order = main_.panels();
  for (ViewWindow* const window : windows_) {
    std::ranges::copy(window->area().panels(), std::back_inserter(in_order));
  }
  const auto active = std::ranges::find(in_order, active_);
  layout.active_view = active == in_order.end() ? 1 : static_cast<int>(active - in_order.begin()) + 1;
  layout.windows.front().source = main_source_;
  layout.source = source_;
  return layout;
}

void ViewSet::arrange(const scenegraph::Layout& layout) {
  clear();
  const auto make_restored = [this](const scenegraph::ViewLayout& view) -> ViewPanel& {
    ViewPanel& panel = make();
    panel.restore(view);
    return panel;
  };
  source_ = layout.source;
  bool is_main = true;
  for (const scenegraph::WindowLayout& of : layout.windows) {
    if (is_main) {
      main_source_ = of.source;
      main_.arrange(of.place, make_restored);
    } else {
      ViewWindow& window = openWindow(of, false);  // a window manager would make each the active one
      window.source = of.source;
      window.area().arrange(of.place, make_restored);
    }
    is_main = false;
  }
  if (static_cast<std::size_t>(layout.active_view) <= views_.size()) {
    active_ = views_[static_cast<std::size_t>(layout.active_view) - 1];
  }
  main_.window()->setAttribute(Qt::WA_ShowWithoutActivating, active_->window() != main_.window());
  active_->view().setFocus();
  if (active_->window()->isVisible()) {  // else it is in the main window, which is about to be shown
    active_->activateWindow();
  }
  finishArranging();
  Q_EMIT activeChanged();
}

}  // namespace stillframe::viewer
