#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <osg/Array>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/Image>
#include <osg/Matrixd>
#include <osg/ref_ptr>
#include <span>
#include <string>
#include <vector>

#include "scenegraph/pipeline/point_collection.h"
#include "scenegraph/raster/point_raster.h"

namespace stillframe::scenegraph {

/// How far the picture of a PointStage has come.
struct PointProgress {
  std::size_t points = 0;  ///< of the scene, seen or not
  double share = 1.0;      ///< of them that have been drawn; below 1 the picture is a fair sample
  double raster_ms = 0.0;  ///< that this call took to draw points; 0 where none had to be
  double resolve_ms = 0.0;
};

/// The points of a scene graph, drawn on the CPU and put into the picture as a colour and a depth for each pixel.
///
/// It reads stock nodes: what the graph says is what is drawn, whichever layer put it there. Thread of the context
/// only; the work is spread over the raster's threads. Memory: 8 bytes a pixel, and 12 more, which are uploaded.
class PointStage {
 public:
  explicit PointStage(unsigned threads = 0);

  /// What the camera of the scene draws in place of the points: one full-screen step, the first of all.
  [[nodiscard]] osg::Node& picture() noexcept { return *triangle_; }
  /// Draws these points, as many as the time for it allows, and a few always. Without points there is no picture.
  PointProgress draw(PointCollection points, int width_px, int height_px,
                     double budget_ms = std::numeric_limits<double>::infinity());
  /// Which point is seen at each pixel, bottom row first (PointKey): of the picture as far as it has been drawn; of
  /// points that are others than those drawn last, the whole. Numbers count through the batches in their order.
  [[nodiscard]] std::span<const std::uint64_t> keys(PointCollection points, int width_px, int height_px);

 private:
  void resize(int width_px, int height_px);
  void startAnew(const std::vector<PointBatch>& batches, std::vector<osg::ref_ptr<const osg::Array>> arrays,
                 int width_px, int height_px);
  [[nodiscard]] std::uint32_t affordablePasses(std::size_t points, double budget_ms) const;

  PointRaster raster_;
  std::vector<PointBatch> batches_;                     // in the raster
  std::vector<osg::ref_ptr<const osg::Array>> arrays_;  // theirs: an address alone may have been given anew
  std::uint32_t passes_ = 0;                            // drawn of them
  double points_per_ms_;                                // measured
  osg::ref_ptr<osg::Geometry> triangle_;
  osg::ref_ptr<osg::Image> color_;
  osg::ref_ptr<osg::Image> depth_;
};

}  // namespace stillframe::scenegraph
