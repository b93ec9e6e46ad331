#pragma once

#include <cstddef>
#include <cstdint>
#include <osg/ref_ptr>
#include <osgText/Font>
#include <string>
#include <string_view>
#include <vector>

namespace stillframe::nodes {

/// sRGB-encoded, straight alpha.
struct PixelColor {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
  std::uint8_t a = 255;
};

/// A small picture that rectangles and lines of text are drawn into, without OpenGL and without Qt: what a window and a
/// picture file show alike. Colours are mixed as they are encoded, as other user interfaces do. Each character is drawn
/// by a font that has it, one after the other in visualOrder(). GUI thread.
class GlyphCanvas {
 public:
  /// Transparent at first.
  GlyphCanvas(int width, int height);

  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  /// 4 bytes a pixel, straight alpha, top row first; the canvas is empty after it.
  [[nodiscard]] std::vector<std::uint8_t> takePixels() { return std::move(pixels_); }

  /// Pixels from (left, top) to before (right, bottom), replaced.
  void fill(int left, int top, int right, int bottom, const PixelColor& color);
  /// The whole of it, with round corners.
  void fillRounded(const PixelColor& color, double radius);
  /// UTF-8, on one line whose foot is at `baseline`; `height` is that of the font.
  void drawText(std::string_view utf8, double x, double baseline, double height, const PixelColor& color);
  [[nodiscard]] double textWidth(std::string_view utf8, double height);
  /// The text, or as much of its end as fits into `most`, after "...": what topics differ in comes last.
  [[nodiscard]] std::string shortened(std::string_view utf8, double height, double most);

 private:
  /// The four bytes of a pixel that lies within.
  [[nodiscard]] std::uint8_t* at(int x, int y) {
    return &pixels_[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x))];
  }
  void blend(int x, int y, const PixelColor& color, double share);
  [[nodiscard]] osgText::Glyph* glyph(unsigned code, double height);

  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> pixels_;
  osg::ref_ptr<osgText::Font> font_;
  osg::ref_ptr<osgText::Font> east_asian_;  // none before the first such character
  bool has_looked_east_ = false;
};

}  // namespace stillframe::nodes
