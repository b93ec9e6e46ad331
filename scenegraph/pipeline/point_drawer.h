#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <osg/Texture2D>
#include <osg/ref_ptr>
#include <span>

#include "scenegraph/pipeline/point_collection.h"
#include "scenegraph/raster/point_shading.h"
#include "scenegraph/raster/sample_order.h"

namespace stillframe::scenegraph {

/// A picture, bottom row first: scene-linear red, green, blue and alpha as half floats, and reverse-Z depth.
struct PointPixels {
  std::span<const std::uint16_t> rgba;
  std::span<const float> depths;
};

/// Draws points into a picture of colour and depth, in passes. PointStage says which points, and how many in a frame.
///
/// All that there are show the same picture. One thread at a time, that of the context where needsContext() says so.
class PointDrawer {
 public:
  virtual ~PointDrawer() = default;

  /// Starts an empty picture of these points, which stay until the next begin(). Returns the bytes uploaded.
  virtual std::size_t begin(const PointCollection& points, int width_px, int height_px) = 0;
  /// Draws these passes of all of them; when it returns they are drawn.
  virtual void draw(const PassRange& passes) = 0;
  /// Brings what was drawn into the textures, in these colours, and this one where there are no points. Returns the
  /// bytes uploaded.
  virtual std::size_t resolve(const PointShading& shading, const glm::vec4& background) = 0;

  /// Which point is seen at each pixel, bottom row first (PointKey), numbers counting through the batches in their
  /// order; empty where the pixels are not within reach of the CPU.
  [[nodiscard]] virtual std::span<const std::uint64_t> keys() const noexcept { return {}; }

  /// What the textures are made of, where that is within reach of the CPU.
  [[nodiscard]] virtual PointPixels pixels() const noexcept { return {}; }

  /// Whether begin(), draw() and resolve() call OpenGL.
  [[nodiscard]] virtual bool needsContext() const noexcept = 0;
  [[nodiscard]] virtual const char* name() const noexcept = 0;
  /// Scene-linear, and what PointShading says in alpha.
  [[nodiscard]] virtual osg::Texture2D& colorTexture() noexcept = 0;
  /// Reverse-Z; 0 where there are no points.
  [[nodiscard]] virtual osg::Texture2D& depthTexture() noexcept = 0;
};

/// A texture of one texel a pixel, read as it is.
[[nodiscard]] osg::ref_ptr<osg::Texture2D> makePointTexture(int internal_format);

}  // namespace stillframe::scenegraph
