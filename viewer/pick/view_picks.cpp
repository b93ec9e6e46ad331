#include "viewer/pick/view_picks.h"

#include <QPainter>
#include <cmath>

namespace stillframe::viewer {
namespace {

constexpr double kRingRadius = 7.0;
constexpr QColor kColor(255, 214, 64);
constexpr QColor kShadow(0, 0, 0, 170);

QString number(double metres) { return QString::number(metres, 'g', 6); }

}  // namespace

ViewPicks::ViewPicks(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("picks"));
  setAttribute(Qt::WA_TransparentForMouseEvents);
  hide();
}

void ViewPicks::select(std::optional<scenegraph::PickResult> picked) {
  selected_ = std::move(picked);
  onChanged();
}

void ViewPicks::measureTo(scenegraph::PickResult end) {
  if (selected_) {
    measured_.emplace_back(*selected_, end);
  }
  selected_ = std::move(end);
  onChanged();
}

void ViewPicks::removeMeasurement(std::size_t index) {
  if (index < measured_.size()) {
    measured_.erase(measured_.begin() + static_cast<std::ptrdiff_t>(index));
    onChanged();
  }
}

void ViewPicks::clear() {
  if (selected_ || !measured_.empty()) {
    selected_.reset();
    measured_.clear();
    onChanged();
  }
}

void ViewPicks::onChanged() { Q_EMIT changed(); }

std::optional<scenegraph::Measurement> ViewPicks::lengthOf(const scenegraph::Scene& scene, const Pair& pair) {
  const auto from = scenegraph::pointInFixedNow(scene, pair.first);
  const auto to = scenegraph::pointInFixedNow(scene, pair.second);
  return from && to ? std::optional(scenegraph::measure(*from, *to)) : std::nullopt;
}

QString ViewPicks::text(const scenegraph::Measurement& measurement) {
  const glm::dvec3& delta = measurement.delta_in_fixed;
  return tr("%1 m  (dx %2, dy %3, dz %4)")
      .arg(number(measurement.length_m), number(delta.x), number(delta.y), number(delta.z));
}

void ViewPicks::place(const scenegraph::Scene& scene, const scenegraph::CameraView& view) {
  const scenegraph::PictureSize size{static_cast<double>(parentWidget()->width()),
                                     static_cast<double>(parentWidget()->height())};
  std::optional<QPointF> ring;
  const auto selected = selected_ ? scenegraph::pointInFixedNow(scene, *selected_) : std::nullopt;
  if (const auto at = selected ? scenegraph::toScreen(view, size, *selected) : std::nullopt) {
    ring = QPointF(at->position_px.x, at->position_px.y);
  }
  std::vector<QLineF> lines;
  std::vector<QString> texts;
  for (const Pair& pair : measured_) {
    const auto from = scenegraph::pointInFixedNow(scene, pair.first);
    const auto to = scenegraph::pointInFixedNow(scene, pair.second);
    if (const auto seen = from && to ? scenegraph::toScreen(view, size, *from, *to) : std::nullopt) {
      lines.emplace_back(seen->first.x, seen->first.y, seen->second.x, seen->second.y);
      texts.push_back(text(scenegraph::measure(*from, *to)));
    }
  }
  if (ring != ring_ || lines != lines_ || texts != texts_) {
    ring_ = ring;
    lines_ = std::move(lines);
    texts_ = std::move(texts);
    update();
  }
  setGeometry(parentWidget()->rect());
  setVisible(ring_ || !lines_.empty());
}

void ViewPicks::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  for (const auto& [color, width] : {std::pair(kShadow, 4.0), std::pair(kColor, 1.6)}) {
    painter.setPen(QPen(color, width));
    if (ring_) {
      painter.drawEllipse(*ring_, kRingRadius, kRingRadius);
    }
    for (const QLineF& line : lines_) {
      painter.drawLine(line);
    }
  }
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const QPointF middle = lines_[i].center();
    QRectF box = painter.fontMetrics().boundingRect(texts_[i]).adjusted(-5, -3, 5, 3);
    box.moveCenter(middle - QPointF(0.0, box.height()));
    painter.fillRect(box, QColor(20, 22, 26, 200));
    painter.setPen(kColor);
    painter.drawText(box, Qt::AlignCenter, texts_[i]);
  }
}

}  // namespace stillframe::viewer
