#include "nodes/legend/glyph_canvas.h"

#include <algorithm>
#include <cmath>
#include <osgText/Glyph>

#include "nodes/text/find_font.h"
#include "nodes/text/visual_order.h"

namespace stillframe::nodes {
namespace {

constexpr std::string_view kDots = "...";

unsigned rowsOf(double height) { return static_cast<unsigned>(std::clamp(std::lround(height), 4L, 256L)); }

}  // namespace

GlyphCanvas::GlyphCanvas(int width, int height)
    : width_(width),
      height_(height),
      pixels_(std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      font_(findFont()) {
  if (!font_.valid()) {
    font_ = osgText::Font::getDefaultFont();
  }
}

void GlyphCanvas::fill(int left, int top, int right, int bottom, const PixelColor& color) {
  for (int y = std::max(0, top); y < std::min(bottom, height_); ++y) {
    for (int x = std::max(0, left); x < std::min(right, width_); ++x) {
      std::uint8_t* const pixel = at(x, y);
      pixel[0] = color.r;
      pixel[1] = color.g;
      pixel[2] = color.b;
      pixel[3] = color.a;
    }
  }
}

void GlyphCanvas::fillRounded(const PixelColor& color, double radius) {
  fill(0, 0, width_, height_, color);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      // How far the pixel's middle lies beyond the circle of its corner.
      const double dx = std::max({radius - (x + 0.5), x + 0.5 - (width_ - radius), 0.0});
      const double dy = std::max({radius - (y + 0.5), y + 0.5 - (height_ - radius), 0.0});
      const double share = std::clamp(radius + 0.5 - std::hypot(dx, dy), 0.0, 1.0);
      std::uint8_t& alpha = at(x, y)[3];
      alpha = static_cast<std::uint8_t>(std::lround(alpha * share));
    }
  }
}

void GlyphCanvas::blend(int x, int y, const PixelColor& color, double share) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_ || share <= 0.0) {
    return;
  }
  std::uint8_t* const pixel = at(x, y);
  const double above = share * color.a / 255.0;
  const double below = pixel[3] / 255.0 * (1.0 - above);
  const double alpha = above + below;
  const std::uint8_t parts[] = {color.r, color.g, color.b};
  for (int i = 0; i < 3; ++i) {
    pixel[i] = static_cast<std::uint8_t>(std::lround((parts[i] * above + pixel[i] * below) / alpha));
  }
  pixel[3] = static_cast<std::uint8_t>(std::lround(alpha * 255.0));
}

osgText::Glyph* GlyphCanvas::glyph(unsigned code, double height) {
  osgText::Font* font = font_.get();
  if (isEastAsian(code)) {
    if (!has_looked_east_) {
      east_asian_ = findEastAsianFont();  // OSG keeps what it has read
      has_looked_east_ = true;
    }
    font = east_asian_.valid() ? east_asian_.get() : font;
  }
  return font->getGlyph(osgText::FontResolution(rowsOf(height), rowsOf(height)), code);
}

double GlyphCanvas::textWidth(std::string_view utf8, double height) {
  double width = 0.0;
  for (const unsigned code : visualOrder(utf8)) {
    if (const osgText::Glyph* const shape = glyph(code, height)) {
      width += static_cast<double>(shape->getHorizontalAdvance()) * rowsOf(height);
    }
  }
  return width;
}

std::string GlyphCanvas::shortened(std::string_view utf8, double height, double most) {
  if (textWidth(utf8, height) <= most) {
    return std::string(utf8);
  }
  std::string_view rest = utf8;
  while (!rest.empty() && textWidth(std::string(kDots) + std::string(rest), height) > most) {
    rest.remove_prefix(1);
    while (!rest.empty() && (static_cast<unsigned char>(rest.front()) & 0xC0U) == 0x80U) {
      rest.remove_prefix(1);
    }
  }
  return std::string(kDots) + std::string(rest);
}

void GlyphCanvas::drawText(std::string_view utf8, double x, double baseline, double height, const PixelColor& color) {
  const auto rows = static_cast<double>(rowsOf(height));
  double pen = x;
  for (const unsigned code : visualOrder(utf8)) {
    const osgText::Glyph* const shape = glyph(code, height);
    if (shape == nullptr) {
      continue;
    }
    // Metrics are in heights of the font; the image has its lowest row first.
    const auto left = static_cast<int>(std::lround(pen + shape->getHorizontalBearing().x() * rows));
    const auto foot = static_cast<int>(std::lround(baseline - shape->getHorizontalBearing().y() * rows));
    const unsigned size = shape->data() != nullptr ? shape->getPixelSizeInBits() / 8 : 0;
    for (int row = 0; size > 0 && row < shape->t(); ++row) {
      for (int column = 0; column < shape->s(); ++column) {
        // Of several components the last is the alpha; of one it is that.
        const unsigned char* const texel = shape->data(static_cast<unsigned>(column), static_cast<unsigned>(row));
        blend(left + column, foot - 1 - row, color, texel[size - 1] / 255.0);
      }
    }
    pen += shape->getHorizontalAdvance() * rows;
  }
}

}  // namespace stillframe::nodes
