#include "viewer/pick/view_picks.h"

#include <QPainter>
#include <utility>

namespace stillframe::viewer {
namespace {

constexpr double kRingRadius = 7.0;
constexpr QColor kColor(255, 214, 64);
constexpr QColor kShadow(0, 0, 0, 170);

QPointF pointOf(const glm::dvec2& at_px) { return {at_px.x, at_px.y}; }

}  // namespace

ViewPicks::ViewPicks(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("picks"));
  setAttribute(Qt::WA_TransparentForMouseEvents);
  hide();
}

void ViewPicks::select(std::optional<scenegraph::PickResult> picked) {
  marks_.selected = std::move(picked);
  Q_EMIT changed();
  if (marks_.selected) {
    Q_EMIT this->picked();
  }
}

void ViewPicks::measureTo(scenegraph::PickResult end) {
  if (marks_.selected) {
    marks_.measured.emplace_back(*marks_.selected, end);
  }
  select(std::move(end));
}

void ViewPicks::removeMeasurement(std::size_t index) {
  if (index < marks_.measured.size()) {
    marks_.measured.erase(marks_.measured.begin() + static_cast<std::ptrdiff_t>(index));
    Q_EMIT changed();
  }
}

void ViewPicks::clear() { restore({}); }

void ViewPicks::restore(scenegraph::PickMarks marks) {
  if (marks != marks_) {
    marks_ = std::move(marks);
    Q_EMIT changed();
  }
}

void ViewPicks::place(const scenegraph::Scene& scene, const scenegraph::CameraView& view) {
  const scenegraph::PictureSize size{static_cast<double>(parentWidget()->width()),
                                     static_cast<double>(parentWidget()->height())};
  if (auto placed = scenegraph::placePicks(scene, view, size, marks_); placed != placed_) {
    placed_ = std::move(placed);
    update();
  }
  setGeometry(parentWidget()->rect());
  setVisible(!placed_.isEmpty());
}

void ViewPicks::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  for (const auto& [color, width] : {std::pair(kShadow, 4.0), std::pair(kColor, 1.6)}) {
    painter.setPen(QPen(color, width));
    if (placed_.ring_px) {
      painter.drawEllipse(pointOf(*placed_.ring_px), kRingRadius, kRingRadius);
    }
    for (const auto& line : placed_.lines) {
      painter.drawLine(pointOf(line.from_px), pointOf(line.to_px));
    }
  }
  for (const auto& line : placed_.lines) {
    const QString text = QString::fromStdString(line.text);
    QRectF box = painter.fontMetrics().boundingRect(text).adjusted(-5, -3, 5, 3);
    const auto corner = scenegraph::textCorner(line, {box.width(), box.height()},
                                               {static_cast<double>(width()), static_cast<double>(height())});
    if (!corner) {
      continue;
    }
    box.moveTopLeft(pointOf(*corner));
    painter.fillRect(box, QColor(20, 22, 26, 200));
    painter.setPen(kColor);
    painter.drawText(box, Qt::AlignCenter, text);
  }
}

}  // namespace stillframe::viewer
