#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <osg/Array>
#include <osg/ref_ptr>

#include "nodes/images/camera_model.h"
#include "scenegraph/objects/image.h"
#include "scenegraph/status.h"

namespace stillframe::nodes {

/// A depth image as it is uploaded: metres of every pixel. Made on a worker, cached, shared by all views.
struct DepthFrame {
  std::shared_ptr<const scenegraph::Image> source;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  osg::ref_ptr<osg::FloatArray> depths;  ///< DepthMap::metres, and a hole for the eye
  std::size_t valid = 0;
  float nearest_m = 0.0F;
  float farthest_m = 0.0F;

  [[nodiscard]] static std::expected<DepthFrame, scenegraph::Status> make(
      std::shared_ptr<const scenegraph::Image> image);
  /// Frees the array on the GPU, in every context. GUI thread.
  void releaseGlObjects() const { depths->releaseGLObjects(); }
  [[nodiscard]] std::size_t pixels() const noexcept { return std::size_t{width} * height; }
  [[nodiscard]] std::size_t byteSize() const;
};

/// Rays of the pixels of one camera as they are uploaded; the same for all images with equal intrinsics.
struct CameraRays {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  osg::ref_ptr<osg::Vec3Array>
      rays;  ///< RayTable::xyz, and the eye (0, 0, 0), so that the bound reaches from it to z = 1
  std::size_t without_ray = 0;
  double largest_residual_px = 0.0;

  [[nodiscard]] static CameraRays make(const CameraModel& model, std::uint32_t width, std::uint32_t height);
  [[nodiscard]] std::size_t byteSize() const;
};

/// Colours of the pixels of a registered image as they are uploaded.
struct ColorFrame {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  osg::ref_ptr<osg::Vec4ubArray> colors;  ///< and one for the eye

  [[nodiscard]] static std::expected<ColorFrame, scenegraph::Status> make(const scenegraph::Image& image);
  [[nodiscard]] std::size_t byteSize() const;
};

}  // namespace stillframe::nodes
