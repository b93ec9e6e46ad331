#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <future>
#include <limits>
#include <memory>
#include <optional>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/ref_ptr>
#include <span>
#include <string>
#include <vector>

#include "scenegraph/executor.h"
#include "scenegraph/pipeline/point_collection.h"
#include "scenegraph/pipeline/point_drawer.h"
#include "scenegraph/pipeline/point_picture.h"
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
/// Thread of the context only; start() has its work done by another, which every other call waits for.
class PointStage {
 public:
  explicit PointStage(std::unique_ptr<PointDrawer> drawer);
  /// Drawn on the CPU.
  explicit PointStage(unsigned threads = 0);
  ~PointStage();
  PointStage(const PointStage&) = delete;
  PointStage& operator=(const PointStage&) = delete;

  /// What the camera of the scene draws in place of the points, before all else: a full-screen step, or a copy.
  [[nodiscard]] osg::Group& picture() noexcept { return *picture_; }
  /// Where the pixels of the next draw() or start() may be copied to; nullopt: they are drawn, over what is there.
  void setTargets(const std::optional<PointTargets>& targets);
  [[nodiscard]] const PointDrawer& drawer() const noexcept { return *drawer_; }
  /// Draws these points, as many as the limits allow, and a few always. Without points there is no picture.
  PointProgress draw(PointCollection points, int width_px, int height_px, const PointLimits& limits = {});
  /// The same on a thread of its own, for a drawer that needs no context; finish() says what came of it. `wake` is
  /// called from there, once finish() no longer waits. picture() must not be drawn before that.
  void start(PointCollection points, int width_px, int height_px, const PointLimits& limits,
             std::function<void()> wake);
  /// Whether `wake` is still to come.
  [[nodiscard]] bool isUnderWay() const noexcept { return is_under_way_; }
  /// Waits for what was started; of a start() each.
  [[nodiscard]] PointProgress finish() { return started_.get(); }
  /// Waits for what was started and has not been finished.
  void wait() const;
  /// Which point is seen at each pixel (PointDrawer::keys): of the picture as far as it has been drawn; of points that
  /// are others than those drawn last, the whole.
  [[nodiscard]] std::span<const std::uint64_t> keys(PointCollection points, int width_px, int height_px);

 private:
  PointProgress drawNow(PointCollection points, int width_px, int height_px, const PointLimits& limits);
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
  glm::vec4 background_{0.0F};
  bool is_background_new_ = false;
  osg::ref_ptr<osg::Geometry> triangle_;
  osg::ref_ptr<PointPicture> copy_;
  osg::ref_ptr<osg::Group> picture_;
  std::atomic<bool> is_under_way_{false};
  std::future<PointProgress> started_;
  std::unique_ptr<Executor> aside_;  // none before start(); last, so that what is under way ends before the rest goes
};

}  // namespace stillframe::scenegraph
