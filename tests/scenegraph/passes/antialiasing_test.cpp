#include "scenegraph/passes/antialiasing.h"

#include "tests/scenegraph/passes/pass_scene.h"

namespace stillframe::scenegraph {
namespace {

PostChain aaChain(const AntialiasingSettings& settings) {
  PostChain chain;
  appendAntialiasing(settings, chain);
  return chain;
}

class AntialiasingTest : public PassTest {
 protected:
  void SetUp() override {
    PassTest::SetUp();
    osg::ref_ptr<osg::MatrixTransform> turned = new osg::MatrixTransform(osg::Matrix::rotate(0.2, osg::Vec3d(0, 0, 1)));
    turned->addChild(makeQuad(1, 1, 0, {1, 1, 1, 1}));
    root_->addChild(turned);
  }
  static CameraView view() { return {.eye_from_fixed = lookAt({0, 0, 4}, {0, 0, 0}, {0, 1, 0})}; }
  Picture drawWith(const AntialiasingSettings& settings) { return draw(view(), 96, 96, aaChain(settings)); }
};

TEST_F(AntialiasingTest, EveryModeIsNearerToTheTruth) {
  const Picture truth = drawWith({"ssaa", 64});
  const double none = rmse(draw(view(), 96, 96, {}), truth);
  const double fxaa = rmse(drawWith({"fxaa", 4}), truth);
  const double msaa = rmse(drawWith({"msaa", 4}), truth);
  ASSERT_EQ(renderer_->lastFrame().samples, 4);
  const double ssaa = rmse(drawWith({"ssaa", 4}), truth);
  EXPECT_GT(none, 0.03);
  EXPECT_LT(fxaa, 0.7 * none);
  EXPECT_LT(ssaa, 0.35 * none);
  EXPECT_LT(rmse(drawWith({"ssaa", 16}), truth), ssaa);
  EXPECT_LT(msaa, 0.5 * none);
}

TEST_F(AntialiasingTest, MultisamplingWorksOnThisDriver) {
  (void)drawWith({"msaa", 4});
  EXPECT_EQ(renderer_->lastFrame().samples, 4);
  EXPECT_EQ(renderer_->lastFrame().passes, (std::vector<std::string>{"scene", "resolve"}));
}

TEST_F(AntialiasingTest, MoreSamplesThanTheDriverHasAreAsManyAsItHas) {
  const Picture picture = drawWith({"msaa", 64});
  EXPECT_LE(renderer_->lastFrame().samples, 64);
  EXPECT_EQ(badValues(picture), 0U);
  EXPECT_EQ(red(picture, 48, 48), 1.0F);
}

TEST_F(AntialiasingTest, DepthAndPlainAreasStayAsTheyAre) {
  const Picture plain = draw(view(), 96, 96, {});
  for (const char* mode : {"fxaa", "msaa", "ssaa"}) {
    const Picture smooth = drawWith({mode, 4});
    for (const auto& [x, y] : {std::pair{48, 48}, {2, 2}, {40, 60}}) {
      EXPECT_EQ(red(smooth, x, y), red(plain, x, y)) << mode;
    }
    const std::size_t middle = 48 * 96 + 48;
    EXPECT_NEAR(smooth.depth_m[middle], plain.depth_m[middle], 1e-5F) << mode;
    EXPECT_TRUE(std::isinf(smooth.depth_m[0])) << mode;
  }
}

TEST_F(AntialiasingTest, PointsKeepTheirSizeInPixels) {
  root_ = new osg::Group;
  root_->addChild(makeShape(GL_POINTS, {{0, 0, 0}}, {{1, 1, 1, 1}}));
  for (const char* mode : {"msaa", "ssaa"}) {
    const Picture picture = drawWith({mode, 4});
    double area = 0.0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      area += static_cast<double>(picture.rgba[i]);
    }
    EXPECT_NEAR(area, 25.0, 2.0) << mode;
  }
}

}  // namespace
}  // namespace stillframe::scenegraph
