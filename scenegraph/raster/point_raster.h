#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "scenegraph/raster/point_blocks.h"
#include "scenegraph/raster/sample_order.h"

namespace stillframe::scenegraph {

class PointShading;

/// Points as they are rasterised: what a GL_POINTS draw would be given, less the colours.
struct PointBatch {
  std::span<const float> positions;  ///< x, y, z of one point after another, metres in the points' own frame
  glm::dmat4 clip_from_points{1.0};  ///< OpenGL clip space, z from 0 to w, reverse-Z (1 near, 0 at infinity)
  /// Edge of the square, pixels; in metres, what metres become at w = 1. Clamped to 1..255 pixels as the shader does.
  float size = 1.0F;
  bool is_size_in_metres = false;
  bool is_round = false;  ///< a disc instead of the square
  /// Of a depth image, one a point, else empty: the positions are rays, each to be multiplied by its depth and `unit`.
  /// Drawn are rays of z > 0 with a depth above 0 and not beyond `farthest`.
  std::span<const float> depths = {};
  float unit = 1.0F;
  float farthest = 0.0F;
  std::span<const PointBox> boxes = {};  ///< of the groups of points (not of rays); empty: not known, all are drawn

  [[nodiscard]] std::size_t count() const noexcept { return positions.size() / 3; }
  /// The same numbers at the same place in memory.
  friend bool operator==(const PointBatch& a, const PointBatch& b) noexcept {
    return a.positions.data() == b.positions.data() && a.positions.size() == b.positions.size() &&
           a.clip_from_points == b.clip_from_points && a.size == b.size && a.is_size_in_metres == b.is_size_in_metres &&
           a.is_round == b.is_round && a.depths.data() == b.depths.data() && a.depths.size() == b.depths.size() &&
           a.unit == b.unit && a.farthest == b.farthest;
  }
};

/// What is seen at a pixel, as PointRaster::keys() holds it: 0 is nothing.
struct PointKey {
  /// Window depth, reverse-Z.
  [[nodiscard]] static float depth(std::uint64_t key) noexcept;
  /// Number of the point: those of the first batch come first, then those of the second...
  [[nodiscard]] static std::uint32_t point(std::uint64_t key) noexcept {
    return ~static_cast<std::uint32_t>(key & 0xffffffffU);
  }
};

/// Draws points on the CPU into a picture of depth and point numbers.
///
/// Why: a software OpenGL takes some 330 ns a point, this some 12 (a point is one store, not a primitive to be set up).
/// A pixel is one 64-bit number, the depth over the complement of the point's number, and drawing is an atomic maximum:
/// the nearest point wins, of equally near ones the first, as GL_GREATER has it; so the picture depends neither on the
/// number of threads nor on the order or the number of calls in which a cloud's passes are drawn. Colours are looked
/// up afterwards, for what is seen alone. The coverage rule is OpenGL's for points, at 1/256 of a pixel; points whose
/// centre is outside the clip volume are clipped; NaN is.
///
/// Method: Schuetz, Kerbl, Wimmer, "Rendering Point Clouds with Compute Shaders and Vertex Order Optimization", 2021.
/// One thread calls; `threads` work. Memory: 8 bytes a pixel.
class PointRaster {
 public:
  /// At least one thread; 0 takes what the machine has.
  explicit PointRaster(unsigned threads = 0);
  ~PointRaster();
  PointRaster(const PointRaster&) = delete;
  PointRaster& operator=(const PointRaster&) = delete;

  /// Starts an empty picture. Sizes below 1 draw nothing; the memory of an earlier picture is kept for the next.
  void begin(int width_px, int height_px);
  /// Draws these passes of all batches (at most 2^32 - 1 points) on top of what is there. Left out are groups of points
  /// whose box is out of the picture, and small ones that lie behind what has been drawn: neither shows. Returns how
  /// many points that left, which may differ between runs where more than one thread works.
  std::size_t draw(std::span<const PointBatch> batches, const PassRange& passes = {});

  /// The picture in colour: linear red, green, blue and alpha of PointShading as half floats, and reverse-Z depth;
  /// `background` and 0 where nothing was drawn. One pixel a key; `shading` is that of the batches drawn.
  void resolve(const PointShading& shading, std::span<std::uint16_t> rgba, std::span<float> depth,
               const glm::vec4& background = glm::vec4(0.0F)) const;

  /// One key a pixel, bottom row first.
  [[nodiscard]] std::span<const std::uint64_t> keys() const noexcept { return keys_; }
  [[nodiscard]] int widthPx() const noexcept { return width_px_; }
  [[nodiscard]] int heightPx() const noexcept { return height_px_; }

 private:
  struct Threads;

  std::unique_ptr<Threads> threads_;
  std::vector<std::uint64_t> keys_;
  int width_px_ = 0;
  int height_px_ = 0;
};

}  // namespace stillframe::scenegraph
