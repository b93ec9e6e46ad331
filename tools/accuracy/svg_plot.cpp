#include "tools/accuracy/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>

#include "scenegraph/layout/xml_text.h"

namespace stillframe::accuracy {
namespace {

constexpr double kPanelWidth = 400.0, kPanelHeight = 270.0;  // of the plotting area
constexpr double kLeft = 80.0, kGapX = 80.0, kGapY = 90.0;
constexpr double kTop = 110.0, kBottom = 90.0, kRight = 30.0;
// Okabe and Ito, "Color Universal Design": black, vermilion, blue, green, purple, orange, sky blue.
constexpr std::array kColours{"#000000", "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

/// `markup` has its tags and entities already.
void addMarkup(std::string& svg, double x, double y, const std::string& markup, const std::string& attributes) {
  svg.append("<text x=\"").append(number(x)).append("\" y=\"").append(number(y)).append("\" ");
  svg.append(attributes).append(">").append(markup).append("</text>\n");
}

void addText(std::string& svg, double x, double y, const std::string& text, const std::string& attributes) {
  std::string markup;
  scenegraph::appendXmlText(text, markup);
  addMarkup(svg, x, y, markup, attributes);
}

void addLine(std::string& svg, double x1, double y1, double x2, double y2, const char* colour) {
  svg.append("<line x1=\"").append(number(x1)).append("\" y1=\"").append(number(y1));
  svg.append("\" x2=\"").append(number(x2)).append("\" y2=\"").append(number(y2));
  svg.append("\" stroke=\"").append(colour).append("\"/>\n");
}

/// A power of ten with its exponent raised.
std::string decadeLabel(int exponent) {
  return std::string("10<tspan dy=\"-5\" font-size=\"9\">").append(std::to_string(exponent)).append("</tspan>");
}

/// Whole decades on one axis and where they lie on the page.
struct Axis {
  int low = 0;
  int high = 1;
  double start = 0.0;
  double length = 1.0;
  [[nodiscard]] double at(double value) const {
    const double clamped = std::max(std::log10(value), static_cast<double>(low));
    return start + length * (clamped - low) / (high - low);
  }
  [[nodiscard]] int step() const { return std::max(1, (high - low + 7) / 8); }
};

/// Whole decades around every positive value.
Axis axisAround(const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const double value : values) {
    if (value > 0.0) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  Axis axis;
  if (high > 0.0) {
    axis.low = static_cast<int>(std::floor(std::log10(low)));
    axis.high = std::max(axis.low + 1, static_cast<int>(std::ceil(std::log10(high))));
  }
  return axis;
}

/// Circle, square, triangle or diamond; hollow for a value of zero.
void addMarker(std::string& svg, std::size_t series, double x, double y, bool hollow) {
  constexpr double kSize = 4.0;
  const std::string colour = kColours[series % kColours.size()];
  const std::string paint = std::string(" stroke=\"")
                                .append(colour)
                                .append("\" fill=\"")
                                .append(hollow ? "#ffffff" : colour)
                                .append("\"/>\n");
  const auto point = [&](double dx, double dy) {
    return number(x + dx * kSize).append(",").append(number(y + dy * kSize)).append(" ");
  };
  switch (series % 4) {
    case 0:
      svg.append("<circle cx=\"").append(number(x)).append("\" cy=\"").append(number(y)).append("\" r=\"4\"");
      break;
    case 1:
      svg.append("<polygon points=\"").append(point(-1, -1)).append(point(1, -1)).append(point(1, 1));
      svg.append(point(-1, 1)).append("\"");
      break;
    case 2:
      svg.append("<polygon points=\"").append(point(0, -1.2)).append(point(1.2, 1)).append(point(-1.2, 1)).append("\"");
      break;
    default:
      svg.append("<polygon points=\"").append(point(0, -1.4)).append(point(1.4, 0)).append(point(0, 1.4));
      svg.append(point(-1.4, 0)).append("\"");
  }
  svg.append(paint);
}

/// Between two decades that stand alone, so that their place can be read.
constexpr std::array kWithinDecade{2.0, 4.0, 6.0, 8.0};

std::string withinDecadeLabel(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

void addAxes(std::string& svg, const Axis& x, const Axis& y) {
  for (const double part : kWithinDecade) {
    if (x.high - x.low == 1) {
      const double at = x.at(part * std::pow(10.0, x.low));
      addLine(svg, at, y.start, at, y.start + y.length, "#f2f2f2");
      addText(svg, at, y.start + 18, withinDecadeLabel(part * std::pow(10.0, x.low)),
              "text-anchor=\"middle\" font-size=\"12\"");
    }
    if (y.high - y.low == 1) {
      const double at = y.at(part * std::pow(10.0, y.low));
      addLine(svg, x.start, at, x.start + x.length, at, "#f2f2f2");
      addText(svg, x.start - 8, at + 4, withinDecadeLabel(part * std::pow(10.0, y.low)),
              "text-anchor=\"end\" font-size=\"12\"");
    }
  }
  for (int decade = x.low; decade <= x.high; ++decade) {
    const double at = x.start + x.length * (decade - x.low) / (x.high - x.low);
    addLine(svg, at, y.start, at, y.start + y.length, "#dddddd");
    if ((decade - x.low) % x.step() == 0) {
      addMarkup(svg, at, y.start + 18, decadeLabel(decade), "text-anchor=\"middle\" font-size=\"12\"");
    }
  }
  for (int decade = y.low; decade <= y.high; ++decade) {
    const double at = y.start + y.length * (decade - y.low) / (y.high - y.low);
    const bool labelled = (decade - y.low) % y.step() == 0;
    addLine(svg, x.start, at, x.start + x.length, at, labelled ? "#dddddd" : "#f2f2f2");
    if (labelled) {
      addMarkup(svg, x.start - 8, at + 4, decadeLabel(decade), "text-anchor=\"end\" font-size=\"12\"");
    }
  }
  addLine(svg, x.start, y.start, x.start + x.length, y.start, "#444444");
  addLine(svg, x.start, y.start, x.start, y.start + y.length, "#444444");
}

void addSeries(std::string& svg, std::size_t index, const PlotSeries& series, const Axis& x, const Axis& y) {
  svg.append("<polyline fill=\"none\" stroke-width=\"1.8\" stroke=\"").append(kColours[index % kColours.size()]);
  svg.append("\" points=\"");
  const auto top = [&](const PlotPoint& point) { return point.y > 0.0 ? y.at(point.y) : y.start; };
  for (const PlotPoint& point : series.points) {
    svg.append(number(x.at(point.x))).append(",").append(number(top(point))).append(" ");
  }
  svg.append("\"/>\n");
  for (const PlotPoint& point : series.points) {
    addMarker(svg, index, x.at(point.x), top(point), !(point.y > 0.0));
  }
}

void addLegendEntry(std::string& svg, std::size_t index, const std::string& name, double x, double y) {
  addLine(svg, x, y, x + 24, y, kColours[index % kColours.size()]);
  addMarker(svg, index, x + 12, y, false);
  addText(svg, x + 30, y + 4, name, "font-size=\"13\"");
}

/// Of all panels, above them.
void addLegend(std::string& svg, const PlotPanel& panel) {
  double x = kLeft;
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    addLegendEntry(svg, i, panel.series[i].name, x, 66);
    x += 48.0 + 7.0 * static_cast<double>(panel.series[i].name.size());
  }
}

bool sharesLegend(const PlotFigure& figure) {
  const auto has_names_of_first = [&](const PlotPanel& panel) {
    return std::ranges::equal(panel.series, figure.panels.front().series, {}, &PlotSeries::name, &PlotSeries::name);
  };
  return std::ranges::all_of(figure.panels, has_names_of_first);
}

}  // namespace

std::string renderSvg(const PlotFigure& figure) {
  const std::size_t columns = std::max<std::size_t>(1, std::min(figure.columns, figure.panels.size()));
  const std::size_t rows = (figure.panels.size() + columns - 1) / columns;
  const auto column_count = static_cast<double>(columns);
  const auto row_count = static_cast<double>(rows);
  const double width = kLeft + column_count * kPanelWidth + (column_count - 1) * kGapX + kRight;
  const double height = kTop + row_count * kPanelHeight + (row_count - 1) * kGapY + kBottom;
  std::string svg("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"");
  svg.append(number(width)).append("\" height=\"").append(number(height)).append("\" viewBox=\"0 0 ");
  svg.append(number(width)).append(" ").append(number(height));
  svg.append("\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" fill=\"#222222\">\n");
  svg.append("<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n");
  addText(svg, kLeft, 32, figure.title, "font-size=\"18\" font-weight=\"bold\"");
  const bool shares_legend = sharesLegend(figure);
  if (shares_legend && !figure.panels.empty()) {
    addLegend(svg, figure.panels.front());
  }
  std::vector<double> all_x;
  for (const PlotPanel& panel : figure.panels) {
    for (const PlotSeries& series : panel.series) {
      std::transform(series.points.begin(), series.points.end(), std::back_inserter(all_x),
                     [](const PlotPoint& point) { return point.x; });
    }
  }
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const PlotPanel& panel = figure.panels[i];
    std::vector<double> panel_y;
    for (const PlotSeries& series : panel.series) {
      std::transform(series.points.begin(), series.points.end(), std::back_inserter(panel_y),
                     [](const PlotPoint& point) { return point.y; });
    }
    Axis x = axisAround(all_x);
    x.start = kLeft + static_cast<double>(i % columns) * (kPanelWidth + kGapX);
    x.length = kPanelWidth;
    Axis y = axisAround(panel_y);
    const auto row = i / columns;
    y.start = kTop + static_cast<double>(row) * (kPanelHeight + kGapY) + kPanelHeight;
    y.length = -kPanelHeight;
    addAxes(svg, x, y);
    addText(svg, x.start, y.start + y.length - 8, panel.title, "font-size=\"13\" font-weight=\"bold\"");
    addText(svg, x.start + x.length / 2, y.start + 38, figure.x_label, "text-anchor=\"middle\" font-size=\"12\"");
    const std::string turn = std::string("rotate(-90 ").append(number(x.start - 48)).append(" ");
    addText(svg, x.start - 48, y.start + y.length / 2, figure.y_label,
            std::string("text-anchor=\"middle\" font-size=\"12\" transform=\"")
                .append(turn)
                .append(number(y.start + y.length / 2))
                .append(")\""));
    for (std::size_t series = 0; series < panel.series.size(); ++series) {
      addSeries(svg, series, panel.series[series], x, y);
      if (!shares_legend) {
        addLegendEntry(svg, series, panel.series[series].name, x.start + 14,
                       y.start + y.length + 18 + 20 * static_cast<double>(series));
      }
    }
  }
  addText(svg, kLeft, height - 18, figure.caption, "font-size=\"12\" fill=\"#444444\"");
  return svg.append("</svg>\n");
}

}  // namespace stillframe::accuracy
