#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <osg/Geometry>
#include <osg/ref_ptr>
#include <span>
#include <string>
#include <vector>

#include "scenegraph/pipeline/point_collection.h"
#include "scenegraph/pipeline/point_drawer.h"
#include "scenegraph/raster/point_raster.h"
#include "scenegraph/raster/points_in_view.h"

namespace stillframe::scenegraph {

/// How much of the points a frame may draw.
struct PointLimits {
  /// Time for the points of one frame, to the picture of them; what it does not reach for is drawn by the next frames.
  double budget_ms = std::numeric_limits<double>::infinity();
  /// Passes of sample_order.h that are drawn at most, however many frames there are.
  std::uint32_t passes = kPassesOfBothLaps;
};

/// How far the picture of a PointStage has come.
struct PointProgress {
  std::string by;           ///< the drawer's name
  std::size_t points = 0;   ///< of the scene, seen or not
  std::size_t in_view = 0;  ///< of them, those of groups that are not out of the picture as a whole
  double share = 1.0;       ///< of them that have been drawn; below 1 the picture is a sample: fair, and of groups that
                            ///< cover few pixels no more of it than shows there
  double raster_ms = 0.0;   ///< that this call took to draw points; 0 where none had to be
  double resolve_ms = 0.0;  ///< to look up their colours; 0 where neither points nor colours changed
  std::size_t upload_bytes = 0;
};

/// The points of a scene graph, drawn past OpenGL's GL_POINTS and put into the picture as a colour and a depth for each
/// pixel.
///
/// It reads stock nodes: what the graph says is what is drawn, whichever layer put it there. Where points, camera and
/// size are those of the frame before, no point is drawn again; where the colours are too, nothing is uploaded either.
/// Thread of the context only.
class PointStage {
 public:
  explicit PointStage(std::unique_ptr<PointDrawer> drawer);
  /// Drawn on the CPU.
  explicit PointStage(unsigned threads = 0);

  /// What the camera of the scene draws in place of the points: one full-screen step, the first of all.
  [[nodiscard]] osg::Node& picture() noexcept { return *triangle_; }
  [[nodiscard]] const PointDrawer& drawer() const noexcept { return *drawer_; }
  /// Draws these points, as many as the limits allow, and a few always. Without points there is no picture.
  PointProgress draw(PointCollection points, int width_px, int height_px, const PointLimits& limits = {});
  /// Which point is seen at each pixel (PointDrawer::keys): of the picture as far as it has been drawn; of points that
  /// are others than those drawn last, the whole.
  [[nodiscard]] std::span<const std::uint64_t> keys(PointCollection points, int width_px, int height_px);

 private:
  [[nodiscard]] std::size_t startAnew(const PointCollection& points, int width_px, int height_px);
  [[nodiscard]] std::uint32_t affordableEnd(double points, std::uint32_t most_passes) const;
  void drawPasses(const PointLimits& limits, std::chrono::steady_clock::time_point start);
  void noteRate(double points_per_ms, double points, bool is_first);

  std::unique_ptr<PointDrawer> drawer_;
  PointCollection drawn_;  // its arrays kept alive: an address alone may have been given anew
  int width_px_ = 0;
  int height_px_ = 0;
  PointsInView in_view_;
  std::uint32_t passes_ = 0;  // drawn of them
  double points_per_ms_;      // measured
  double resolve_ms_ = 0.0;   // measured
  osg::ref_ptr<osg::Geometry> triangle_;
};

}  // namespace stillframe::scenegraph
