#pragma once

#include <string>
#include <vector>

namespace stillframe::accuracy {

struct PlotPoint {
  double x = 0.0;  ///< must be positive
  double y = 0.0;  ///< zero is drawn hollow, on the lower edge
};

struct PlotSeries {
  std::string name;  ///< where all panels have the same names, one legend stands for them
  std::vector<PlotPoint> points;
};

struct PlotPanel {
  std::string title;
  std::vector<PlotSeries> series;
};

/// Panels of log-log curves with shared axes, one legend and a caption.
struct PlotFigure {
  std::string title;
  std::string caption;
  std::string x_label;
  std::string y_label;
  std::vector<PlotPanel> panels;
  std::size_t columns = 2;
};

/// The figure as a self-contained SVG. Up to seven series, told apart by colour (the Okabe-Ito palette, made for colour
/// blindness) and by marker.
[[nodiscard]] std::string renderSvg(const PlotFigure& figure);

}  // namespace stillframe::accuracy
