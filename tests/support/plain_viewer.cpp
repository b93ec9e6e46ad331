#include "tests/support/plain_viewer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>
#include <osg/Camera>
#include <osg/Image>
#include <osgDB/ReadFile>
#include <osgViewer/Renderer>
#include <osgViewer/Viewer>

#include "scenegraph/export/osgt_export.h"
#include "scenegraph/pipeline/offscreen_context.h"

namespace stillframe::test {

scenegraph::BytePicture drawPlainly(osg::Node& scene, const scenegraph::CameraView& view, double near_m, double far_m,
                                    int width_px, int height_px, const scenegraph::Color& background) {
  const auto context = scenegraph::OffscreenContext::create();
  if (!context) {
    return {};
  }
  const osg::ref_ptr<osg::Node> held = &scene;
  osgViewer::Viewer viewer;
  viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  viewer.setUseConfigureAffinity(false);
  viewer.setUpViewerAsEmbeddedInWindow(0, 0, width_px, height_px);
  // A context without a window has no framebuffer of its own: the camera draws into an image.
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(width_px, height_px, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
  osg::ref_ptr<osg::Camera> camera = new osg::Camera;
  camera->setReferenceFrame(osg::Camera::ABSOLUTE_RF);
  camera->setRenderOrder(osg::Camera::PRE_RENDER);
  camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera->attach(osg::Camera::COLOR_BUFFER, image);
  camera->setViewport(0, 0, width_px, height_px);
  camera->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);  // not said, it inherits the viewer's: nothing
  camera->setClearColor({background.r, background.g, background.b, 1.0F});
  camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  const double aspect = static_cast<double>(width_px) / height_px;
  if (view.is_orthographic) {
    const double half = view.vertical_extent_m / 2.0;
    camera->setProjectionMatrixAsOrtho(-half * aspect, half * aspect, -half, half, near_m, far_m);
  } else {
    camera->setProjectionMatrixAsPerspective(view.vertical_fov_rad * 180.0 / std::numbers::pi, aspect, near_m, far_m);
  }
  camera->setViewMatrix(osg::Matrixd(glm::value_ptr(view.eye_from_fixed)));
  camera->addChild(&scene);
  osg::ref_ptr<osg::Group> root = new osg::Group;
  root->addChild(camera);
  viewer.getCamera()->setClearMask(0);
  viewer.setSceneData(root);
  // OSG's compile step draws text outright, here with no framebuffer bound.
  if (auto* const renderer = dynamic_cast<osgViewer::Renderer*>(viewer.getCamera()->getRenderer())) {
    renderer->setCompileOnNextDraw(false);
  }
  viewer.frame();
  scenegraph::BytePicture picture{.width = width_px, .height = height_px, .rgb = {}};
  for (int row = height_px; row-- > 0;) {
    const unsigned char* const first = image->data(0, row);
    picture.rgb.insert(picture.rgb.end(), first, first + static_cast<std::ptrdiff_t>(3) * width_px);
  }
  camera->removeChildren(0, camera->getNumChildren());
  scene.releaseGLObjects(viewer.getCamera()->getGraphicsContext()->getState());
  return picture;
}

osg::ref_ptr<osg::Node> exportedAndRead(const osg::Group& scene, const std::string& extension, int viewport_height_px) {
  const auto& test = *testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test.test_suite_name()) + "." + test.name() + extension;
  std::ranges::replace(name, '/', '_');
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / name;
  const auto written = scenegraph::exportGraph(
      scene,
      {.time = {}, .fixed_frame = "map", .source = "test", .layers = {}, .viewport_height_px = viewport_height_px},
      path);
  EXPECT_TRUE(written) << written.error().message;
  osg::ref_ptr<osg::Node> read = written ? osgDB::readRefNodeFile(path.string()) : nullptr;
  EXPECT_TRUE(read.valid()) << path;
  std::filesystem::remove(path);
  return read;
}

PictureDifference difference(const scenegraph::BytePicture& a, const scenegraph::BytePicture& b) {
  if (a.width != b.width || a.height != b.height || a.rgb.size() != b.rgb.size()) {
    const std::size_t all = std::max(a.rgb.size(), b.rgb.size()) / 3;
    return {.pixels = all, .beyond_one = all, .largest = 255};
  }
  PictureDifference result;
  for (std::size_t pixel = 0; pixel < a.rgb.size(); pixel += 3) {
    int largest = 0;
    for (std::size_t channel = pixel; channel < pixel + 3; ++channel) {
      largest = std::max(largest, std::abs(static_cast<int>(a.rgb[channel]) - static_cast<int>(b.rgb[channel])));
    }
    result.pixels += largest > 0 ? 1U : 0U;
    result.beyond_one += largest > 1 ? 1U : 0U;
    result.largest = std::max(result.largest, largest);
  }
  return result;
}

}  // namespace stillframe::test
