#pragma once

#include <QWidget>
#include <optional>

#include "scenegraph/color_legend.h"

namespace stillframe::viewer {

/// A histogram of values in the colours that they have, and a handle at each end of the range. GUI thread.
class RangeStrip : public QWidget {
  Q_OBJECT

 public:
  explicit RangeStrip(QWidget* parent = nullptr);

  void setLegend(const std::optional<scenegraph::ColorLegend>& legend);
  void setHistogram(const scenegraph::ValueHistogram& histogram);
  [[nodiscard]] const scenegraph::ValueHistogram& histogram() const noexcept { return histogram_; }
  /// Pixel of a value; values beyond what is shown lie at the rim.
  [[nodiscard]] double xOf(double value) const;
  [[nodiscard]] double valueAt(double x) const;
  [[nodiscard]] QSize sizeHint() const override;

 Q_SIGNALS:
  /// The user drags an end of the range to here.
  void dragged(double low, double high);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  enum class Handle { None, Low, High };
  void showExtent();

  std::optional<scenegraph::ColorLegend> legend_;
  scenegraph::ValueHistogram histogram_;
  double left_ = 0.0;  // values at the rims
  double right_ = 1.0;
  Handle dragged_ = Handle::None;
};

}  // namespace stillframe::viewer
