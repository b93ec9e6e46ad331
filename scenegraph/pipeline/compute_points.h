#pragma once

#include <cstddef>
#include <cstdint>
#include <osg/State>
#include <osg/observer_ptr>
#include <vector>

#include "scenegraph/pipeline/point_drawer.h"

namespace stillframe::scenegraph {

/// Points drawn by compute shaders: for GPUs, where a point is not worth a primitive.
///
/// As PointRaster does it, with 32-bit atomics, which every OpenGL 4.5 has: one run over the points finds the nearest
/// depth of each pixel, a second one the first point that has it; so the picture is the same whatever the order in
/// which threads come. It reads the buffers that GL_POINTS would be drawn from, and adds 8 bytes a pixel, two textures
/// of 12, and 8 bytes for each group of points in view. One of the files with OpenGL calls of its own. Method: Schuetz,
/// Kerbl, Wimmer, "Rendering Point Clouds with Compute Shaders and Vertex Order Optimization", 2021; "Software
/// Rasterization of 2 Billion Points in Real Time", 2022. Thread of the context, which is current in every call, the
/// destructor's too.
class ComputePoints final : public PointDrawer {
 public:
  explicit ComputePoints(osg::State& state);
  ~ComputePoints() override;
  ComputePoints(const ComputePoints&) = delete;
  ComputePoints& operator=(const ComputePoints&) = delete;

  /// Whether all points are small: of large ones OpenGL itself fills the squares faster.
  [[nodiscard]] static bool suits(const PointCollection& points);

  std::size_t begin(const PointCollection& points, int width_px, int height_px) override;
  void draw(const PassRange& passes) override;
  std::size_t resolve(const PointShading& shading, const glm::vec4& background) override;
  [[nodiscard]] bool needsContext() const noexcept override { return true; }
  [[nodiscard]] const char* name() const noexcept override { return "compute"; }
  [[nodiscard]] osg::Texture2D& colorTexture() noexcept override { return *color_; }
  [[nodiscard]] osg::Texture2D& depthTexture() noexcept override { return *depth_; }

 private:
  /// A part of a batch that is no larger than what a shader may be handed in one buffer.
  struct Slice {
    std::size_t batch = 0;
    std::uint32_t first_number = 0;  // of the batch, in the picture
    std::uint32_t first_group = 0;   // of the slice, in the batch
    std::uint32_t points = 0;
    std::uint32_t first_in_view = 0;  // in the buffer of groups
    std::uint32_t groups_in_view = 0;
  };
  /// A group in view, as the shader has it.
  struct Group {
    std::uint32_t number = 0;  // in its batch
    std::uint32_t most = 0;    // of the passes of the first lap
  };
  std::vector<Group> cut(const PointCollection& points, int width_px, int height_px);
  void bindSlice(unsigned binding, const osg::Array* array, const Slice& slice, std::size_t bytes_a_point) const;
  std::size_t upload(const osg::Array* array) const;
  std::size_t fit(int width_px, int height_px);
  void leave() const;

  osg::State& state_;
  std::uint32_t draw_program_ = 0;
  std::uint32_t resolve_program_ = 0;
  std::vector<std::uint32_t> buffers_;
  std::size_t largest_slice_ = 0;  // points, whole groups
  PointCollection points_;
  std::vector<Slice> slices_;
  int width_px_ = 0;
  int height_px_ = 0;
  osg::ref_ptr<osg::Texture2D> color_;
  osg::ref_ptr<osg::Texture2D> depth_;
};

}  // namespace stillframe::scenegraph
