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

/// Vertex attribute that holds the values of points.
inline constexpr unsigned kPointValueAttribute = 6;

/// The opaque points of a scene graph (geometry.h: kOpaquePoints), ready for a rasteriser. Views into its arrays.
struct PointCollection {
  std::vector<PointBatch> batches;
  std::vector<osg::ref_ptr<const osg::Array>> arrays;  ///< their positions, kept alive
  std::vector<PointColors> colors;                     ///< theirs
  std::vector<osg::NodePath> paths;                    ///< to their geometries, for as long as the graph stays
  std::size_t count = 0;
};

/// Finds the points beneath `root` that are not masked off, and reads the uniforms of nodes/point_cloud's shader. For a
/// picture of `height_px`. Microseconds a cloud. Whoever may touch the graph.
[[nodiscard]] PointCollection collectPoints(osg::Node& root, const osg::Matrixd& eye_from_fixed,
                                            const osg::Matrixd& clip_from_eye, int height_px);

}  // namespace stillframe::scenegraph
