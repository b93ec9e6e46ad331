#pragma once

#include <osg/Image>
#include <vector>

#include "scenegraph/pipeline/point_drawer.h"
#include "scenegraph/raster/point_raster.h"

namespace stillframe::scenegraph {

/// Points drawn by this program, for where OpenGL is software. The work is spread over `threads`, 0 being all. Memory:
/// 8 bytes a pixel, and 12 more, which are uploaded; of the points nothing.
class CpuPoints final : public PointDrawer {
 public:
  explicit CpuPoints(unsigned threads = 0);

  std::size_t begin(const PointCollection& points, int width_px, int height_px) override;
  void draw(const PassRange& passes) override;
  std::size_t resolve(const PointShading& shading, const glm::vec4& background) override;
  [[nodiscard]] PointPixels pixels() const noexcept override;
  [[nodiscard]] std::span<const std::uint64_t> keys() const noexcept override { return raster_.keys(); }
  [[nodiscard]] bool needsContext() const noexcept override { return false; }
  [[nodiscard]] const char* name() const noexcept override { return "cpu"; }
  [[nodiscard]] osg::Texture2D& colorTexture() noexcept override { return *color_texture_; }
  [[nodiscard]] osg::Texture2D& depthTexture() noexcept override { return *depth_texture_; }

 private:
  PointRaster raster_;
  std::vector<PointBatch> batches_;
  osg::ref_ptr<osg::Image> color_;
  osg::ref_ptr<osg::Image> depth_;
  osg::ref_ptr<osg::Texture2D> color_texture_;
  osg::ref_ptr<osg::Texture2D> depth_texture_;
};

}  // namespace stillframe::scenegraph
