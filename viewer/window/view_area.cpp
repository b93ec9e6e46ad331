#include "viewer/window/view_area.h"

#include <QCoreApplication>
#include <QDragEnterEvent>
#include <QMimeData>
#include <QRubberBand>
#include <QSplitter>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>
#include <array>
#include <utility>

#include "viewer/view/view_panel.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {
namespace {

constexpr const char* kSource = "layout_source";  // of a splitter: what is unknown in its element

Qt::Orientation orientationOf(Side side) {
  return side == Side::Left || side == Side::Right ? Qt::Horizontal : Qt::Vertical;
}

QSplitter* makeSplitter(Qt::Orientation orientation) {
  auto* splitter = new QSplitter(orientation);
  splitter->setChildrenCollapsible(false);
  return splitter;
}

void collect(const QSplitter& splitter, std::vector<ViewPanel*>& panels) {
  for (int i = 0; i < splitter.count(); ++i) {
    if (auto* panel = qobject_cast<ViewPanel*>(splitter.widget(i))) {
      panels.push_back(panel);
    } else if (const auto* inner = qobject_cast<QSplitter*>(splitter.widget(i))) {
      collect(*inner, panels);
    }
  }
}

scenegraph::Place placeOf(QWidget& widget) {
  scenegraph::Place place;
  if (const auto* panel = qobject_cast<ViewPanel*>(&widget)) {
    place.view = panel->layout();
    return place;
  }
  const auto& splitter = *qobject_cast<QSplitter*>(&widget);
  if (splitter.count() == 1) {
    return placeOf(*splitter.widget(0));
  }
  place.is_vertical = splitter.orientation() == Qt::Vertical;
  const QList<int> sizes = splitter.sizes();
  place.sizes.assign(sizes.begin(), sizes.end());
  for (int i = 0; i < splitter.count(); ++i) {
    place.children.push_back(placeOf(*splitter.widget(i)));
  }
  place.source = splitter.property(kSource).value<scenegraph::XmlElement>();
  return place;
}

/// The side whose edge is nearest, by the share of the panel.
Side nearestSide(QPoint position, QRect rect) {
  const double x = static_cast<double>(position.x() - rect.x()) / std::max(rect.width(), 1);
  const double y = static_cast<double>(position.y() - rect.y()) / std::max(rect.height(), 1);
  const std::array<std::pair<double, Side>, 4> sides{
      {{x, Side::Left}, {1.0 - x, Side::Right}, {y, Side::Above}, {1.0 - y, Side::Below}}};
  return std::ranges::min_element(sides, {}, &std::pair<double, Side>::first)->second;
}

bool isView(const QDropEvent& event) {
  const QByteArray token = event.mimeData()->data(QString::fromLatin1(ViewArea::kMimeType));
  return token.startsWith(QByteArray::number(QCoreApplication::applicationPid()) + ':');
}

}  // namespace

ViewArea::ViewArea(QWidget* parent)
    : QWidget(parent), root_(makeSplitter(Qt::Horizontal)), band_(new QRubberBand(QRubberBand::Rectangle, this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(root_);
  setAcceptDrops(true);
}

void ViewArea::insert(ViewPanel& panel, ViewPanel* beside, Side side) {
  QSplitter* splitter = beside == nullptr ? root_ : qobject_cast<QSplitter*>(beside->parentWidget());
  const Qt::Orientation orientation = beside == nullptr ? root_->orientation() : orientationOf(side);
  if (splitter->orientation() != orientation && splitter->count() <= 1) {
    splitter->setOrientation(orientation);
  } else if (splitter->orientation() != orientation) {
    // `beside` shares its place with the new view.
    QSplitter* const inner = makeSplitter(orientation);
    const QList<int> sizes = splitter->sizes();
    splitter->replaceWidget(splitter->indexOf(beside), inner);
    inner->addWidget(beside);
    splitter->setSizes(sizes);
    splitter = inner;
  }
  QList<int> sizes = splitter->sizes();
  const bool is_before = side == Side::Left || side == Side::Above;
  const int index = beside == nullptr ? splitter->count() : splitter->indexOf(beside) + (is_before ? 0 : 1);
  if (beside == nullptr) {
    sizes.fill(1000, splitter->count() + 1);
  } else {
    const bool is_across = orientation == Qt::Horizontal;
    const int place = splitter->indexOf(beside);
    const int room = sizes.size() > 1 ? sizes[place] : is_across ? beside->width() : beside->height();
    const int for_pictures = room - splitter->handleWidth() - (is_across ? beside->panelsWidth() : 0);
    const QSize least = panel.minimumSizeHint();
    const int picture = std::max(for_pictures / 2, is_across ? least.width() : least.height());  // as large for each
    sizes[place] = std::max(room - splitter->handleWidth() - picture, 1);
    sizes.insert(is_before ? place : place + 1, picture);
  }
  splitter->insertWidget(index, &panel);
  splitter->setSizes(sizes);
  panel.show();
  if (beside != nullptr) {
    beside->show();
    if (orientation == Qt::Horizontal) {
      beside->narrowPanels(panel.view().width());
    }
  }
}

void ViewArea::take(ViewPanel& panel) {
  auto* splitter = qobject_cast<QSplitter*>(panel.parentWidget());
  panel.hide();
  panel.setParent(nullptr);
  while (splitter != nullptr && splitter != root_ && splitter->count() <= 1) {
    auto* outer = qobject_cast<QSplitter*>(splitter->parentWidget());
    const QList<int> sizes = outer->sizes();
    if (splitter->count() == 1) {
      outer->replaceWidget(outer->indexOf(splitter), splitter->widget(0));
      outer->setSizes(sizes);
    }
    splitter->setParent(nullptr);
    splitter->deleteLater();
    splitter = outer;
  }
}

std::vector<ViewPanel*> ViewArea::panels() const {
  std::vector<ViewPanel*> panels;
  collect(*root_, panels);
  return panels;
}

scenegraph::Place ViewArea::place() const { return root_->count() == 0 ? scenegraph::Place{} : placeOf(*root_); }

void ViewArea::arrange(const scenegraph::Place& place,
                       const std::function<ViewPanel&(const scenegraph::ViewLayout&)>& make) {
  const std::function<void(const scenegraph::Place&, QSplitter&)> fill = [&](const scenegraph::Place& of,
                                                                             QSplitter& splitter) {
    splitter.setOrientation(of.is_vertical ? Qt::Vertical : Qt::Horizontal);
    splitter.setProperty(kSource, QVariant::fromValue(of.source));
    for (const scenegraph::Place& child : of.children) {
      if (child.view) {
        ViewPanel& panel = make(*child.view);
        splitter.addWidget(&panel);
        panel.show();
      } else {
        QSplitter* const inner = makeSplitter(Qt::Horizontal);
        splitter.addWidget(inner);
        fill(child, *inner);
      }
    }
    splitter.setSizes(QList<int>(of.sizes.begin(), of.sizes.end()));
  };
  delete root_;  // with the splitters of views that are gone
  root_ = makeSplitter(Qt::Horizontal);
  layout()->addWidget(root_);
  if (place.view) {
    insert(make(*place.view));
  } else {
    fill(place, *root_);
  }
}

QByteArray ViewArea::token(const ViewPanel& panel) {
  return QByteArray::number(QCoreApplication::applicationPid()) + ':' +
         QByteArray::number(static_cast<qulonglong>(reinterpret_cast<quintptr>(&panel)));
}

ViewArea::Target ViewArea::targetAt(QPoint position) const {
  for (ViewPanel* const panel : panels()) {
    const QRect rect(panel->mapTo(this, QPoint(0, 0)), panel->size());
    if (rect.contains(position)) {
      return {panel, nearestSide(position, rect)};
    }
  }
  return {};
}

void ViewArea::showTarget(const Target& target) {
  QRect rect(target.panel->mapTo(this, QPoint(0, 0)), target.panel->size());
  switch (target.side) {
    case Side::Left:
      rect.setWidth(rect.width() / 2);
      break;
    case Side::Right:
      rect.setLeft(rect.left() + rect.width() / 2);
      break;
    case Side::Above:
      rect.setHeight(rect.height() / 2);
      break;
    case Side::Below:
      rect.setTop(rect.top() + rect.height() / 2);
      break;
  }
  band_->setGeometry(rect);
  band_->raise();
  band_->show();
}

void ViewArea::dragEnterEvent(QDragEnterEvent* event) {
  if (isView(*event)) {
    event->acceptProposedAction();
  } else {
    event->ignore();  // files are the window's
  }
}

void ViewArea::dragMoveEvent(QDragMoveEvent* event) {
  const Target target = targetAt(event->position().toPoint());
  if (target.panel == nullptr || !isView(*event)) {
    band_->hide();
    event->ignore();
    return;
  }
  showTarget(target);
  event->acceptProposedAction();
}

void ViewArea::dragLeaveEvent(QDragLeaveEvent* /*event*/) { band_->hide(); }

void ViewArea::dropEvent(QDropEvent* event) {
  band_->hide();
  const Target target = targetAt(event->position().toPoint());
  if (target.panel == nullptr || !isView(*event)) {
    event->ignore();
    return;
  }
  event->acceptProposedAction();
  Q_EMIT dropped(event->mimeData()->data(QString::fromLatin1(kMimeType)), target.panel, target.side);
}

}  // namespace stillframe::viewer
