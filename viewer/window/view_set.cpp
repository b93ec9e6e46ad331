#include "viewer/window/view_set.h"

#include <QApplication>
#include <QCursor>
#include <QDrag>
#include <QMimeData>
#include <QPointer>
#include <algorithm>
#include <utility>

#include "viewer/view/view_panel.h"
#include "viewer/window/view_window.h"

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
  (beside == nullptr ? main_ : areaOf(*beside)).insert(panel, beside, side);
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
  closeEmptyWindows();
  return true;
}

bool ViewSet::detach(ViewPanel& panel) {
  if (!takeOut(panel)) {
    return false;
  }
  openWindow(kWindowWidth, kWindowHeight).area().insert(panel);
  closeEmptyWindows();
  return true;
}

bool ViewSet::move(ViewPanel& panel, ViewPanel& beside, Side side) {
  if (&panel == &beside || !takeOut(panel)) {
    return false;
  }
  areaOf(beside).insert(panel, &beside, side);
  closeEmptyWindows();
  return true;
}

ViewWindow& ViewSet::openWindow(int width, int height) {
  auto* window = new ViewWindow;
  windows_.push_back(window);
  window->resize(width, height);
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
  if (dragged != views_.end()) {
    move(**dragged, beside, side);
  }
}

scenegraph::Layout ViewSet::layout() const {
  scenegraph::Layout layout;
  layout.windows.emplace_back().place = main_.place();
  for (ViewWindow* const window : windows_) {
    scenegraph::WindowLayout& of = layout.windows.emplace_back();
    of.width = window->width();
    of.height = window->height();
    of.place = window->area().place();
    of.source = window->source;
  }
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
      ViewWindow& window = openWindow(of.width, of.height);
      window.source = of.source;
      window.area().arrange(of.place, make_restored);
    }
    is_main = false;
  }
  Q_EMIT activeChanged();
}

}  // namespace stillframe::viewer
