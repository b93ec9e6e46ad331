#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <osg/Group>
#include <osg/Matrixd>
#include <osg/Program>
#include <osg/RenderInfo>
#include <osg/StateSet>
#include <osg/Uniform>
#include <osg/ref_ptr>
#include <span>
#include <vector>

#include "scenegraph/pipeline/id_target.h"
#include "scenegraph/pipeline/point_collection.h"

namespace stillframe::scenegraph {

/// A drawable of the scene, and where it is.
struct IdDrawable {
  osg::NodePath path;
  osg::Matrixd eye_from_local;
  bool is_thin = false;  ///< points and lines: what one aims at and misses by a few pixels
};

/// What a pixel near the cursor shows.
struct IdSample {
  int dx = 0;  ///< pixels from the cursor, right and up
  int dy = 0;
  std::uint32_t drawable = 0;  ///< into IdPass::drawables()
  std::uint32_t instance = 0, primitive = 0, vertex = 0;
  float depth = 0.0F;  ///< reverse-Z
};

/// Draws the few pixels about the cursor once more, with numbers in place of colours (id_program.h), and reads them
/// back.
///
/// Nothing is made before the first draw(): no target, no shader. What lies outside those pixels is left out before it
/// is drawn: whole drawables and runs of triangles (TriangleBoxes) by their boxes, points by the vertex shader. What
/// answers rays (RayTarget) is asked instead. Rasterised as in the picture, for the viewport is the picture's, moved.
/// Thread of the context only, with a context current; leaves another framebuffer bound.
class IdPass {
 public:
  struct View {
    osg::Matrixd eye_from_fixed;
    osg::Matrixd clip_from_eye;
    int width_px = 0;
    int height_px = 0;
    int x_px = 0;  ///< the cursor's, from the bottom left
    int y_px = 0;
    int reach_px = 8;
  };
  /// All pixels within reach of the cursor that show something. `points`: the opaque points, which the CPU has drawn,
  /// and their picture (PointStage::keys); nullopt: OpenGL draws them. Nullopt when the driver has no such target.
  struct CpuPoints {
    std::span<const std::uint64_t> keys;
    const PointCollection& points;
  };
  [[nodiscard]] std::optional<std::vector<IdSample>> draw(osg::Group& root, const View& view, osg::RenderInfo& info,
                                                          const std::optional<CpuPoints>& points);
  /// Draws one thing in sight whose shaders draw() would have to make, so that it finds them. Returns whether there was
  /// one; `with_points` as with draw().
  [[nodiscard]] bool warm(osg::Group& root, const View& view, osg::RenderInfo& info, bool with_points);
  /// Of the last draw(); the paths are good until the graph changes.
  [[nodiscard]] const std::vector<IdDrawable>& drawables() const noexcept { return drawables_; }

  /// Frees what is on the GPU. The context that it was made in must be current.
  void release(osg::State& state);

 private:
  void collect(osg::Group& root, const View& view, bool with_points);
  /// Those that are drawn; those that rays are cast at come behind them.
  [[nodiscard]] std::size_t drawnCount() const;
  void castRays(const View& view, std::size_t first, std::vector<gl::IdTarget::Id>& ids,
                std::vector<float>& depths) const;
  void drawGl(const View& view, osg::RenderInfo& info);
  void drawOne(const IdDrawable& one, const View& view, std::uint32_t number, osg::RenderInfo& info);
  void makeState(const View& view);
  struct Derived {
    osg::ref_ptr<const osg::Program> of;  // held, so that its address names it
    osg::ref_ptr<osg::Program> program;
    osg::ref_ptr<osg::StateSet> state;
  };
  [[nodiscard]] const Derived& derive(const osg::Program* program);

  gl::IdTarget target_;
  osg::ref_ptr<osg::StateSet> base_;
  osg::ref_ptr<osg::Uniform> drawable_;
  osg::ref_ptr<osg::Uniform> is_point_;
  std::map<const osg::Program*, Derived> derived_;
  std::vector<IdDrawable> drawables_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> runs_;  // that were drawn, of a drawable that was not whole
};

/// The samples in the order in which somebody who points at the cursor means them.
///
/// What the cursor's own pixel shows comes first, but for points and lines near it that do not lie behind that surface:
/// they are aimed at and missed. The nearest of those in the picture comes first, of equally near ones the nearest to
/// the eye. Then all others by their distance from the cursor.
[[nodiscard]] std::vector<IdSample> inOrderOfMeaning(std::vector<IdSample> samples,
                                                     std::span<const IdDrawable> drawables);

}  // namespace stillframe::scenegraph
