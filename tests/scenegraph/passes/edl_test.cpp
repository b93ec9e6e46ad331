#include "scenegraph/passes/edl.h"

#include "tests/scenegraph/passes/pass_scene.h"

namespace stillframe::scenegraph {
namespace {

PostChain edlChain(const EdlSettings& settings) {
  PostChain chain;
  appendEdl(settings, chain);
  return chain;
}

CameraView lookDown(bool is_orthographic, double distance_m = 4.0) {
  return {.eye_from_fixed = lookAt({0, 0, distance_m}, {0, 0, 0}, {0, 1, 0}),
          .is_orthographic = is_orthographic,
          .vertical_extent_m = distance_m,
          .half_depth_m = 10.0 * distance_m};
}

class EdlTest : public PassTest {
 protected:
  /// A plate before a wall.
  static osg::ref_ptr<osg::Group> makePlate() {
    osg::ref_ptr<osg::Group> scene = new osg::Group;
    scene->addChild(makeQuad(50, 50, 0, {1, 1, 1, 1}));
    scene->addChild(makeQuad(0.7F, 0.7F, 0.5F, {1, 1, 1, 1}));
    return scene;
  }
  /// Mean light that is missing.
  double darkness(const CameraView& view, int size, const EdlSettings& settings) {
    const Picture picture = draw(view, size, size, edlChain(settings));
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      sum += 1.0 - static_cast<double>(picture.rgba[i]);
    }
    return sum / (static_cast<double>(size) * size);
  }
};

TEST_F(EdlTest, LeavesAWallAndTheSkyAlone) {
  background_ = {0.5F, 0.25F, 0.75F, 1.0F};
  root_->addChild(makeQuad(1, 1, 0, {1, 1, 1, 1}));
  for (const bool is_orthographic : {false, true}) {
    const Picture plain = draw(lookDown(is_orthographic), 64, 64, {});
    EXPECT_EQ(draw(lookDown(is_orthographic), 64, 64, edlChain({})).rgba, plain.rgba) << is_orthographic;
  }
}

TEST_F(EdlTest, OutlinesWhatStandsBeforeSomethingWithinItsBound) {
  root_ = makePlate();
  for (const bool is_orthographic : {false, true}) {
    for (const double strength : {0.5, 1.0, 4.0}) {
      const Picture picture =
          draw(lookDown(is_orthographic), 200, 200, edlChain({.strength = strength, .radius = 16.0}));
      float darkest = 1.0F;
      for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        darkest = std::min(darkest, picture.rgba[i]);
      }
      EXPECT_GE(darkest, static_cast<float>(std::exp2(-2.0 * strength)) * 0.999F) << is_orthographic;
      EXPECT_LT(darkest, 0.8F) << is_orthographic << strength;
      EXPECT_EQ(red(picture, 100, 100), 1.0F) << is_orthographic;
      EXPECT_EQ(red(picture, 3, 3), 1.0F) << is_orthographic;
    }
  }
}

TEST_F(EdlTest, LooksTheSameAtEveryResolution) {
  root_ = makePlate();
  for (const bool is_orthographic : {false, true}) {
    const double at_270 = darkness(lookDown(is_orthographic), 270, {.radius = 16.0});
    ASSERT_GT(at_270, 0.005);
    for (const int size : {540, 1080}) {
      EXPECT_NEAR(darkness(lookDown(is_orthographic), size, {.radius = 16.0}) / at_270, 1.0, 0.1) << size;
    }
  }
}

TEST_F(EdlTest, LooksTheSameAtEveryScale) {
  root_ = makePlate();
  const Picture metres = draw(lookDown(false), 100, 100, edlChain({.radius = 8.0}));
  osg::ref_ptr<osg::MatrixTransform> large = new osg::MatrixTransform(osg::Matrix::scale(1e4, 1e4, 1e4));
  large->addChild(makePlate());
  root_ = large;
  EXPECT_LT(rmse(draw(lookDown(false, 4e4), 100, 100, edlChain({.radius = 8.0})), metres), 1e-3);
}

}  // namespace
}  // namespace stillframe::scenegraph
