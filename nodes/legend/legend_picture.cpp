#include "nodes/legend/legend_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "nodes/legend/glyph_canvas.h"

namespace stillframe::nodes {
namespace {

// In units of the design: pixels at scale 1.
constexpr double kWidth = 216.0;
constexpr double kPadding = 8.0;
constexpr double kGap = 7.0;  // between legends
constexpr double kTextHeight = 12.0;
constexpr double kLine = 15.0;
constexpr double kBarTop = 2 * kLine + 3.0;  // clear of the feet of g and y
constexpr double kBar = 11.0;
constexpr double kNumbersTop = kBarTop + kBar + 2.0;
constexpr double kEntry = kNumbersTop + kLine;
constexpr double kCorner = 4.0;

// What legends may take of a picture.
constexpr double kLeastPicture = 320.0;  // of its width, for there to be room beside them
constexpr double kSmallest = 0.75;       // of their own size, and of a pixel of the design: texts stay legible
constexpr double kMostOfWidth = 1.0 / 3.0;
constexpr double kMostOfHeight = 0.4;
constexpr double kMostOfArea = 1.0 / 6.0;

constexpr PixelColor kCard{18, 20, 24, 205};
constexpr PixelColor kText{240, 240, 240, 255};
constexpr PixelColor kDim{176, 180, 188, 255};
constexpr PixelColor kRim{90, 94, 102, 255};

PixelColor toPixel(const std::array<float, 3>& color) {
  const auto byte = [](float part) {
    return static_cast<std::uint8_t>(std::lround((part > 0.0F ? std::min(part, 1.0F) : 0.0F) * 255.0F));
  };
  return {byte(color[0]), byte(color[1]), byte(color[2]), 255};
}

/// What lies at t of 0..1, as the shaders mix it.
std::array<float, 3> colorAt(const scenegraph::ColorLegend& legend, double t) {
  const double x = std::clamp(t, 0.0, 1.0) * static_cast<double>(legend.colors.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(x), legend.colors.size() - 1);
  const auto above = std::min(below + 1, legend.colors.size() - 1);
  const auto share = static_cast<float>(x - static_cast<double>(below));
  std::array<float, 3> color{};
  for (std::size_t i = 0; i < 3; ++i) {
    color[i] = legend.colors[below][i] + (legend.colors[above][i] - legend.colors[below][i]) * share;
  }
  return color;
}

class Card {
 public:
  Card(GlyphCanvas& canvas, double scale) : canvas_(canvas), scale_(scale) {}

  void add(const LegendEntry& entry, double top) {
    const scenegraph::ColorLegend& legend = entry.legend;
    text(entry.layer, kPadding, top, kDim, Align::Left);
    text(legend.unit.empty() ? legend.title : legend.title + " (" + legend.unit + ")", kPadding, top + kLine, kText,
         Align::Left);
    bar(legend, top + kBarTop);
    const double numbers = top + kNumbersTop;
    const double middle = legend.low / 2 + legend.high / 2;
    const bool is_one = legend.low == legend.high;  // which has the colour in the middle
    text(legendNumber(middle, legend.low, legend.high), kWidth / 2, numbers, is_one ? kText : kDim, Align::Centre);
    if (!is_one) {
      text(legendNumber(legend.low, legend.low, legend.high), kPadding, numbers, kText, Align::Left);
      text(legendNumber(legend.high, legend.low, legend.high), kWidth - kPadding, numbers, kText, Align::Right);
    }
  }
  void note(const std::string& words, double top) { text(words, kPadding, top, kDim, Align::Left); }

 private:
  enum class Align : std::uint8_t { Left, Centre, Right };

  void text(const std::string& words, double x, double top, const PixelColor& color, Align align) {
    const double most = (kWidth - 2 * kPadding) * scale_;
    const std::string shown = canvas_.shortened(words, kTextHeight * scale_, most);
    const double width = canvas_.textWidth(shown, kTextHeight * scale_);
    const double from = align == Align::Left ? 0.0 : align == Align::Right ? width : width / 2;
    canvas_.drawText(shown, x * scale_ - from, (top + kTextHeight) * scale_, kTextHeight * scale_, color);
  }
  void bar(const scenegraph::ColorLegend& legend, double top) {
    const int left = px(kPadding);
    const int right = px(kWidth - kPadding);
    canvas_.fill(left - 1, px(top) - 1, right + 1, px(top + kBar) + 1, kRim);
    for (int x = left; x < right; ++x) {
      const double t = right - left > 1 ? static_cast<double>(x - left) / (right - left - 1) : 0.5;
      canvas_.fill(x, px(top), x + 1, px(top + kBar), toPixel(colorAt(legend, t)));
    }
  }
  [[nodiscard]] int px(double units) const { return static_cast<int>(std::lround(units * scale_)); }

  GlyphCanvas& canvas_;
  double scale_;
};

}  // namespace

std::vector<LegendEntry> legendEntries(const scenegraph::Scene& scene) {
  std::vector<LegendEntry> entries;
  for (const auto& slot : scene.layers()) {
    if (auto legend = slot->layer->isVisible() ? slot->layer->legend() : std::nullopt;
        legend && legend->is_shown && !legend->colors.empty()) {
      entries.push_back({slot->title, std::move(*legend)});
    }
  }
  return entries;
}

std::string legendNumber(double value, double low, double high) {
  const double width = std::abs(high / 2 - low / 2) * 2;
  const double largest = std::max(std::abs(low), std::abs(high));
  int digits = 3;
  if (width > 0.0 && std::isfinite(largest / width)) {
    digits = std::clamp(static_cast<int>(std::ceil(std::log10(largest / width))) + 3, 3, 15);
  } else if (width == 0.0) {
    digits = 6;
  }
  // What is left of a sum that should be zero is zero.
  const double shown = std::abs(value) < width * 1e-9 ? 0.0 : value;
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, shown);
  return text.data();
}

LegendPicture drawLegends(std::span<const LegendEntry> entries, double scale, int most_px) {
  if (!(scale > 0.0) || scale > 16.0) {
    return {};
  }
  const auto heightOf = [&](std::size_t count) {
    const auto n = static_cast<double>(count);
    const double note = count < entries.size() ? kLine : 0.0;
    return static_cast<int>(std::ceil((2 * kPadding + n * kEntry + (n - 1) * kGap + note) * scale));
  };
  std::size_t count = entries.size();
  while (count > 0 && heightOf(count) > most_px) {
    --count;
  }
  if (count == 0) {
    return {};
  }
  GlyphCanvas canvas(static_cast<int>(std::ceil(kWidth * scale)), heightOf(count));
  canvas.fillRounded(kCard, kCorner * scale);
  Card card(canvas, scale);
  double top = kPadding - 2.0;
  for (const LegendEntry& entry : entries.first(count)) {
    card.add(entry, top);
    top += kEntry + kGap;
  }
  if (count < entries.size()) {
    card.note("and " + std::to_string(entries.size() - count) + " more", top - kGap);
  }
  return {canvas.width(), canvas.height(), canvas.takePixels()};
}

LegendPicture drawFittingLegends(std::span<const LegendEntry> entries, double scale, int width_px, int height_px) {
  if (!(width_px >= kLeastPicture * scale)) {
    return {};
  }
  const double least = std::min(scale, std::max(kSmallest * scale, kSmallest));
  const auto draw = [&](double fitting) {
    const double most = std::min(kMostOfHeight * height_px, kMostOfArea * width_px * height_px / (kWidth * fitting));
    return drawLegends(entries, fitting, static_cast<int>(most));
  };
  LegendPicture picture = draw(std::clamp(kMostOfWidth * width_px / kWidth, least, scale));
  return picture.isEmpty() ? draw(least) : picture;
}

}  // namespace stillframe::nodes
