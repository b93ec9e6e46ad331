#pragma once

#include <cstddef>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/Image>
#include <osg/Matrixd>
#include <osg/ref_ptr>
#include <string>
#include <vector>

#include "scenegraph/raster/point_raster.h"
#include "scenegraph/raster/point_shading.h"

namespace stillframe::scenegraph {

/// Vertex attribute that holds their values.
inline constexpr unsigned kPointValueAttribute = 6;

/// The points of a scene graph, drawn on the CPU and put into the picture as a colour and a depth for each pixel.
///
/// It reads stock nodes: what the graph says is what is drawn, whichever layer put it there. Thread of the context
/// only; the work is spread over the raster's threads. Memory: 8 bytes a pixel, and 12 more, which are uploaded.
class PointStage {
 public:
  explicit PointStage(unsigned threads = 0);

  /// What the camera of the scene draws in place of the points: one full-screen step, the first of all.
  [[nodiscard]] osg::Node& picture() noexcept { return *triangle_; }
  /// Draws the points beneath `root` that are not masked off. Returns how many there are.
  std::size_t draw(osg::Group& root, const osg::Matrixd& eye_from_fixed, const osg::Matrixd& clip_from_eye,
                   int width_px, int height_px, const PassRange& passes = {});

 private:
  void resize(int width_px, int height_px);

  PointRaster raster_;
  osg::ref_ptr<osg::Geometry> triangle_;
  osg::ref_ptr<osg::Image> color_;
  osg::ref_ptr<osg::Image> depth_;
};

}  // namespace stillframe::scenegraph
