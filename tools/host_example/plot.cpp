#include "plot.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <limits>
#include <vector>

namespace host_example {

using stillframe::tf::TimePoint;

Plot::Plot(QWidget* parent) : QWidget(parent) { setMinimumHeight(140); }

void Plot::setValue(std::optional<Value> value) {
  value_ = std::move(value);
  update();
}

void Plot::setRange(TimePoint first, TimePoint last) {
  first_ = first;
  last_ = last;
  update();
}

void Plot::setTime(TimePoint time) {
  time_ = time;
  update();
}

TimePoint Plot::timeAt(double x) const {
  const double fraction = std::clamp(x / std::max(width() - 1, 1), 0.0, 1.0);
  return TimePoint{first_.ns + static_cast<std::int64_t>(fraction * static_cast<double>(last_.ns - first_.ns))};
}

double Plot::xAt(TimePoint time) const {
  const auto span = static_cast<double>(std::max<std::int64_t>(last_.ns - first_.ns, 1));
  return (width() - 1) * static_cast<double>(time.ns - first_.ns) / span;
}

void Plot::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), palette().base());
  std::vector<std::optional<double>> samples;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int x = 0; value_ && x < width(); ++x) {
    samples.push_back(value_->at(timeAt(x)));
    low = std::min(low, samples.back().value_or(low));
    high = std::max(high, samples.back().value_or(high));
  }
  const double span = std::max(high - low, 1e-9);
  QPainterPath curve;
  for (std::size_t x = 0; x < samples.size(); ++x) {
    if (samples[x]) {
      const QPointF point(static_cast<double>(x), 8.0 + (height() - 16.0) * (high - *samples[x]) / span);
      x > 0 && samples[x - 1] ? curve.lineTo(point) : curve.moveTo(point);
    }
  }
  painter.setPen(QPen(QColor(0x2a, 0x78, 0xd6), 1.5));
  painter.drawPath(curve);
  painter.setPen(palette().color(QPalette::Text));
  if (low <= high) {
    painter.drawText(4, 14, QString::number(high, 'g', 4));
    painter.drawText(4, height() - 4, QString::number(low, 'g', 4));
  }
  painter.setPen(QPen(QColor(0xd6, 0x3a, 0x2a), 1.0));
  painter.drawLine(QPointF(xAt(time_), 0.0), QPointF(xAt(time_), height()));
}

void Plot::mousePressEvent(QMouseEvent* event) { Q_EMIT seekRequested(timeAt(event->position().x())); }

void Plot::mouseMoveEvent(QMouseEvent* event) {
  if (event->buttons().testFlag(Qt::LeftButton)) {
    Q_EMIT seekRequested(timeAt(event->position().x()));
  }
}

}  // namespace host_example
