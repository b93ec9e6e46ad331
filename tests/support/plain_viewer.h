#pragma once

#include <array>
#include <osg/Group>
#include <osg/ref_ptr>
#include <string>

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

/// What there is of `scene` in a file: exported under a name of the running test's and read again by OpenSceneGraph
/// alone. nullptr, and a failure, where either cannot be done. Sizes in metres are those of a picture so many pixels
/// high.
[[nodiscard]] osg::ref_ptr<osg::Node> exportedAndRead(const osg::Group& scene, const std::string& extension = ".osgt",
                                                      int viewport_height_px = 240);
inline constexpr std::array<const char*, 2> kExportExtensions{".osgt", ".osgb"};

/// How two pictures of one size differ.
struct PictureDifference {
  std::size_t pixels = 0;      ///< that differ at all
  std::size_t beyond_one = 0;  ///< that differ by more than one step of a channel
  int largest = 0;             ///< channel difference
};
[[nodiscard]] PictureDifference difference(const scenegraph::BytePicture& a, const scenegraph::BytePicture& b);

}  // namespace stillframe::test
