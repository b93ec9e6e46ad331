#include "viewer/layers/range_strip.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "viewer/layers/number_box.h"

namespace stillframe::viewer {
namespace {

constexpr int kHeight = 34;
constexpr double kMargin = 5.0;  // half a handle
constexpr double kReach = 9.0;   // px from a handle at which it is taken

QColor colorAt(const scenegraph::ColorLegend& legend, double value) {
  const auto last = static_cast<double>(legend.colors.size() - 1);
  const double width = legend.high - legend.low;
  const double t = width != 0.0 && std::isfinite(width) ? std::clamp((value - legend.low) / width, 0.0, 1.0) : 0.5;
  const auto& color = legend.colors[static_cast<std::size_t>(std::lround(t * last))];
  return QColor::fromRgbF(color[0], color[1], color[2]);
}

}  // namespace

RangeStrip::RangeStrip(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setCursor(Qt::SizeHorCursor);
  setToolTip(tr("How often each value occurs. Drag the ends of the range."));
}

QSize RangeStrip::sizeHint() const { return {80, kHeight}; }

void RangeStrip::setLegend(const std::optional<scenegraph::ColorLegend>& legend) {
  if (legend_ != legend) {
    legend_ = legend;
    showExtent();
  }
}

void RangeStrip::setHistogram(const scenegraph::ValueHistogram& histogram) {
  histogram_ = histogram;
  showExtent();
}

/// All values, and the range with them; while a handle is dragged the scale stays under it.
void RangeStrip::showExtent() {
  if (dragged_ == Handle::None) {
    left_ = legend_ ? std::min(legend_->low, legend_->high) : 0.0;
    right_ = legend_ ? std::max(legend_->low, legend_->high) : 1.0;
    if (!histogram_.counts.empty()) {
      left_ = legend_ ? std::min(left_, histogram_.low) : histogram_.low;
      right_ = legend_ ? std::max(right_, histogram_.high) : histogram_.high;
    }
    if (!std::isfinite(left_) || !std::isfinite(right_ - left_) || right_ <= left_) {
      left_ = std::isfinite(left_) ? left_ - 0.5 : 0.0;
      right_ = left_ + 1.0;
    }
  }
  update();
}

double RangeStrip::xOf(double value) const {
  const double t = std::clamp((value - left_) / (right_ - left_), 0.0, 1.0);
  return kMargin + (std::isfinite(t) ? t : 0.0) * (width() - 2 * kMargin);
}

double RangeStrip::valueAt(double x) const {
  const double t = std::clamp((x - kMargin) / std::max(1.0, width() - 2 * kMargin), 0.0, 1.0);
  const bool is_end = t <= 0.0 || t >= 1.0;
  const double value = t >= 1.0 ? right_ : left_ + t * (right_ - left_);
  return is_end ? value : std::clamp(roundedTo(value, right_ - left_), left_, right_);
}

void RangeStrip::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  const double bottom = height() - 3.0;
  if (!histogram_.counts.empty()) {
    const auto most = static_cast<double>(*std::ranges::max_element(histogram_.counts));
    const auto bins = static_cast<double>(histogram_.counts.size());
    for (std::size_t i = 0; i < histogram_.counts.size(); ++i) {
      const auto at = [&](double k) { return histogram_.low + (histogram_.high - histogram_.low) * k / bins; };
      const double from = xOf(at(static_cast<double>(i)));
      const double to = std::max(from + 1.0, xOf(at(static_cast<double>(i + 1))));
      // By the root: a few values far off still show beside the many.
      const double share = most > 0.0 ? std::sqrt(static_cast<double>(histogram_.counts[i]) / most) : 0.0;
      const QColor color = legend_ && !legend_->colors.empty() ? colorAt(*legend_, at(static_cast<double>(i) + 0.5))
                                                               : palette().color(QPalette::Mid);
      painter.fillRect(QRectF(from, bottom - share * (bottom - 2.0), to - from, share * (bottom - 2.0)), color);
    }
  }
  painter.setPen(palette().color(QPalette::Mid));
  painter.drawLine(QPointF(kMargin, bottom), QPointF(width() - kMargin, bottom));
  if (legend_) {
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(palette().color(QPalette::WindowText), 1.5));
    painter.setBrush(palette().color(QPalette::WindowText));
    for (const double end : {legend_->low, legend_->high}) {
      const double x = xOf(end);
      painter.drawLine(QPointF(x, 1.0), QPointF(x, bottom));
      const QPointF grip[] = {{x - 4.0, height() - 0.5}, {x + 4.0, height() - 0.5}, {x, height() - 7.0}};
      painter.drawPolygon(grip, 3);
    }
  }
}

void RangeStrip::mousePressEvent(QMouseEvent* event) {
  if (!legend_ || event->button() != Qt::LeftButton) {
    return;
  }
  const double x = event->position().x();
  const double to_low = std::abs(x - xOf(legend_->low));
  const double to_high = std::abs(x - xOf(legend_->high));
  if (std::min(to_low, to_high) <= kReach) {
    // Where both lie on one place, the one that can go that way.
    const bool is_low = to_low == to_high ? x < xOf(legend_->low) : to_low < to_high;
    dragged_ = is_low ? Handle::Low : Handle::High;
  }
}

void RangeStrip::mouseMoveEvent(QMouseEvent* event) {
  if (!legend_ || dragged_ == Handle::None) {
    return;
  }
  const double value = valueAt(event->position().x());
  scenegraph::ColorLegend changed = *legend_;
  (dragged_ == Handle::Low ? changed.low : changed.high) = value;
  setLegend(changed);
  Q_EMIT dragged(changed.low, changed.high);
}

void RangeStrip::mouseReleaseEvent(QMouseEvent* /*event*/) {
  dragged_ = Handle::None;
  showExtent();
}

}  // namespace stillframe::viewer
