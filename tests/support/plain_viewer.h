#pragma once

#include <osg/Node>

#include "scenegraph/camera/camera.h"
#include "scenegraph/export/picture_io.h"

namespace stillframe::test {

/// What a stock viewer shows of a graph: an osgViewer with nothing of ours on a context that nobody has drawn in, with
/// ordinary depth between `near_m` and `far_m`, an 8-bit target and OSG's default culling of the frustum's sides.
///
/// Stock osgviewer computes near and far from bounds; here they are given, so that both pictures have one camera. No
/// context is current afterwards. An empty picture when there is no OpenGL.
[[nodiscard]] scenegraph::BytePicture drawPlainly(osg::Node& scene, const scenegraph::CameraView& view, double near_m,
                                                  double far_m, int width_px, int height_px,
                                                  const scenegraph::Color& background);

/// How two pictures of one size differ.
struct PictureDifference {
  std::size_t pixels = 0;      ///< that differ at all
  std::size_t beyond_one = 0;  ///< that differ by more than one step of a channel
  int largest = 0;             ///< channel difference
};
[[nodiscard]] PictureDifference difference(const scenegraph::BytePicture& a, const scenegraph::BytePicture& b);

}  // namespace stillframe::test
