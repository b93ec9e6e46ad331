#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "nodes/legend/glyph_canvas.h"
#include "nodes/legend/legend_picture.h"
#include "scenegraph/pick/place_picks.h"

namespace stillframe::nodes {

/// Draws over a picture for a file what a window shows over its view: legends, what is picked and measured. Colours are
/// mixed as they are encoded, as user interfaces do. No OpenGL, no Qt. GUI thread (fonts are OSG's).
class PictureOverlay {
 public:
  /// 4 floats a pixel, top row first: linear light, premultiplied by alpha. `scale`: pixels of the picture to one of
  /// the design, 1 on an ordinary display.
  PictureOverlay(std::span<float> rgba, int width, int height, double scale);

  /// One below the other in the lower right corner; as many as there is room for.
  void addLegends(std::span<const LegendEntry> entries);
  /// A ring round what is picked, lines with their lengths for what is measured.
  void addPicks(const scenegraph::PlacedPicks& picks);

  /// Straight alpha, with its upper left corner there; what lies outside is left out.
  void lay(const LegendPicture& above, int left, int top);
  void drawLine(const glm::dvec2& from_px, const glm::dvec2& to_px, double width_px, const PixelColor& color);
  void drawRing(const glm::dvec2& middle_px, double radius_px, double width_px, const PixelColor& color);

 private:
  void blend(int x, int y, const PixelColor& color, double share);
  void addLength(const scenegraph::PlacedPicks::Line& line);

  std::span<float> rgba_;
  int width_ = 0;
  int height_ = 0;
  double scale_ = 1.0;
};

/// The scale that suits a picture which nobody has looked at in a window: the larger it is, the larger.
[[nodiscard]] double overlayScale(int height) noexcept;

}  // namespace stillframe::nodes
