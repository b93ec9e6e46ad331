#include "nodes/legend/picture_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "scenegraph/srgb.h"

namespace stillframe::nodes {
namespace {

constexpr double kDesignHeight = 720.0;  // of a picture in which things have their own size

// In units of the design: pixels at scale 1.
constexpr double kMargin = 10.0;
constexpr double kRingRadius = 7.0;
constexpr double kLineHeight = 13.0;
constexpr double kTextPadding = 5.0;
constexpr double kLineCorner = 3.0;
constexpr std::array kStrokes{std::pair(PixelColor{0, 0, 0, 170}, 4.0), std::pair(PixelColor{255, 214, 64, 255}, 1.6)};
constexpr PixelColor kLineCard{20, 22, 26, 200};

/// What of a straight line lies within a box about the picture; lines may reach very far beyond it.
std::optional<std::pair<glm::dvec2, glm::dvec2>> clipped(const glm::dvec2& from, const glm::dvec2& to,
                                                         const glm::dvec2& low, const glm::dvec2& high) {
  double first = 0.0;
  double last = 1.0;
  const glm::dvec2 along = to - from;
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0.0) {
      if (from[axis] < low[axis] || from[axis] > high[axis]) {
        return std::nullopt;
      }
      continue;
    }
    const double a = (low[axis] - from[axis]) / along[axis];
    const double b = (high[axis] - from[axis]) / along[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  const bool is_seen = first <= last && std::isfinite(along.x) && std::isfinite(along.y);
  return is_seen ? std::optional(std::pair(from + first * along, from + last * along)) : std::nullopt;
}

double distanceTo(const glm::dvec2& point, const glm::dvec2& from, const glm::dvec2& along) {
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(point - from, along) / length2, 0.0, 1.0) : 0.0;
  return glm::length(point - from - t * along);
}

}  // namespace

double overlayScale(int height) noexcept { return std::clamp(height / kDesignHeight, 0.75, 8.0); }

PictureOverlay::PictureOverlay(std::span<float> rgba, int width, int height, double scale)
    : rgba_(rgba), width_(width), height_(height), scale_(scale) {}

void PictureOverlay::blend(int x, int y, const PixelColor& color, double share) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_ || !(share > 0.0)) {
    return;
  }
  float* const pixel =
      &rgba_[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x))];
  const auto above = static_cast<float>(std::min(share, 1.0) * color.a / 255.0);
  const float below = pixel[3] * (1.0F - above);
  const float alpha = above + below;
  const std::uint8_t parts[] = {color.r, color.g, color.b};
  for (int i = 0; i < 3; ++i) {
    const float behind = pixel[3] > 0.0F ? static_cast<float>(scenegraph::srgbFromLinear(pixel[i] / pixel[3])) : 0.0F;
    const float encoded = (static_cast<float>(parts[i]) / 255.0F * above + behind * below) / alpha;
    pixel[i] = scenegraph::linearFromSrgb(encoded) * alpha;
  }
  pixel[3] = alpha;
}

void PictureOverlay::lay(const LegendPicture& above, int left, int top) {
  for (int y = 0; y < above.height; ++y) {
    for (int x = 0; x < above.width; ++x) {
      const std::uint8_t* const from =
          &above.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(above.width) +
                           static_cast<std::size_t>(x))];
      blend(left + x, top + y, {from[0], from[1], from[2], from[3]}, 1.0);
    }
  }
}

void PictureOverlay::addLegends(std::span<const LegendEntry> entries) {
  const LegendPicture legend = drawFittingLegends(entries, scale_, width_, height_);
  const int margin = static_cast<int>(std::lround(kMargin * scale_));
  const int left = width_ - legend.width - margin;
  const int top = height_ - legend.height - margin;
  if (!legend.isEmpty() && left >= 0 && top >= 0) {
    lay(legend, left, top);
  }
}

void PictureOverlay::drawLine(const glm::dvec2& from_px, const glm::dvec2& to_px, double width_px,
                              const PixelColor& color) {
  const double reach = width_px / 2.0 + 0.5;
  const auto seen = clipped(from_px, to_px, glm::dvec2(-reach), glm::dvec2(width_ + reach, height_ + reach));
  if (!seen) {
    return;
  }
  const auto& [from, to] = *seen;
  const glm::dvec2 along = to - from;
  const int top = static_cast<int>(std::floor(std::min(from.y, to.y) - reach));
  const int bottom = static_cast<int>(std::ceil(std::max(from.y, to.y) + reach));
  for (int y = std::max(0, top); y < std::min(height_, bottom); ++y) {
    // The part of the line that is near this row.
    const auto at = [&](double row) {
      return from.x + (along.y == 0.0 ? 0.0 : std::clamp((row - from.y) / along.y, 0.0, 1.0)) * along.x;
    };
    const bool is_level = std::abs(along.y) < 1.0;
    const double a = is_level ? from.x : at(y + 0.5 - reach);
    const double b = is_level ? to.x : at(y + 0.5 + reach);
    const int left = static_cast<int>(std::floor(std::min(a, b) - reach));
    const int right = static_cast<int>(std::ceil(std::max(a, b) + reach));
    for (int x = std::max(0, left); x < std::min(width_, right); ++x) {
      blend(x, y, color, std::clamp(reach - distanceTo({x + 0.5, y + 0.5}, from, along), 0.0, 1.0));
    }
  }
}

void PictureOverlay::drawRing(const glm::dvec2& middle_px, double radius_px, double width_px, const PixelColor& color) {
  const double reach = width_px / 2.0 + 0.5;
  const double outer = radius_px + reach;
  if (!(middle_px.x > -outer && middle_px.y > -outer && middle_px.x < width_ + outer &&
        middle_px.y < height_ + outer)) {
    return;
  }
  for (int y = static_cast<int>(std::floor(middle_px.y - outer)); y < middle_px.y + outer; ++y) {
    for (int x = static_cast<int>(std::floor(middle_px.x - outer)); x < middle_px.x + outer; ++x) {
      const double from_ring = std::abs(glm::length(glm::dvec2(x + 0.5, y + 0.5) - middle_px) - radius_px);
      blend(x, y, color, std::clamp(reach - from_ring, 0.0, 1.0));
    }
  }
}

void PictureOverlay::addPicks(const scenegraph::PlacedPicks& picks) {
  for (const auto& [color, width] : kStrokes) {
    if (picks.ring_px) {
      drawRing(*picks.ring_px, kRingRadius * scale_, width * scale_, color);
    }
    for (const auto& line : picks.lines) {
      drawLine(line.from_px, line.to_px, width * scale_, color);
    }
  }
  for (const auto& line : picks.lines) {
    addLength(line);
  }
}

void PictureOverlay::addLength(const scenegraph::PlacedPicks::Line& line) {
  const double text_height = kLineHeight * scale_;
  const double padding = kTextPadding * scale_;
  GlyphCanvas ruler(0, 0);
  const int width = static_cast<int>(std::ceil(ruler.textWidth(line.text, text_height) + 2.0 * padding));
  const int height = static_cast<int>(std::ceil(text_height * 1.35 + padding));
  const auto corner =
      scenegraph::textCorner(line, {width, height}, {static_cast<double>(width_), static_cast<double>(height_)});
  if (!corner) {
    return;
  }
  GlyphCanvas canvas(width, height);
  canvas.fillRounded(kLineCard, kLineCorner * scale_);
  canvas.drawText(line.text, padding, text_height + padding / 2.0, text_height, kStrokes.back().first);
  lay({width, height, canvas.takePixels()}, static_cast<int>(std::lround(corner->x)),
      static_cast<int>(std::lround(corner->y)));
}

}  // namespace stillframe::nodes
