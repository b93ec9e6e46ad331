#pragma once

#include <cstddef>
#include <osg/Array>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/ref_ptr>
#include <vector>

#include "scenegraph/raster/point_raster.h"
#include "scenegraph/raster/point_shading.h"

namespace stillframe::scenegraph {

/// Vertex attribute that holds the values of points, the depths of pixels.
inline constexpr unsigned kPointValueAttribute = 6;

/// The arrays that a batch and its colours are views of, as the geometry has them.
struct PointArrays {
  osg::ref_ptr<const osg::Array> positions;
  osg::ref_ptr<const osg::Array> rgba;
  osg::ref_ptr<const osg::Array> values;  ///< of the colour field; the depths of a depth image
};

/// The opaque points of a scene graph (geometry.h: kOpaquePoints), ready for a rasteriser. Views into its arrays.
struct PointCollection {
  std::vector<PointBatch> batches;
  std::vector<PointArrays> arrays;   ///< theirs, kept alive
  std::vector<PointColors> colors;   ///< theirs
  std::vector<osg::NodePath> paths;  ///< to their geometries, for as long as the graph stays
  std::size_t count = 0;
};

/// Finds the points beneath `root` that are not masked off, and reads the uniforms of the shaders of nodes/point_cloud
/// and nodes/depth_image. For a picture of `height_px`. Microseconds a cloud. Whoever may touch the graph.
[[nodiscard]] PointCollection collectPoints(osg::Node& root, const osg::Matrixd& eye_from_fixed,
                                            const osg::Matrixd& clip_from_eye, int height_px);

}  // namespace stillframe::scenegraph
