#include "scenegraph/pipeline/offscreen_renderer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <osg/Depth>
#include <osg/MatrixTransform>

#include "scenegraph/blending.h"
#include "tests/scenegraph/pipeline/shader_scene.h"
#include "tests/support/offscreen_test.h"

namespace stillframe::scenegraph {
namespace {

int byteFromLinear(float linear) {
  const double value = static_cast<double>(linear);
  const double srgb = value <= 0.0031308 ? value * 12.92 : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
  return static_cast<int>(std::lround(srgb * 255.0));
}

class OffscreenRendererTest : public test::OffscreenTest {
 protected:
  Picture draw(const CameraView& view, int width, int height) {
    return render(*root_, view, {.width = width, .height = height});
  }
  /// Red, green, blue as sRGB bytes.
  static std::array<int, 3> pixel(const Picture& picture, int x, int y) {
    const float* rgba = &picture.rgba[static_cast<std::size_t>(y * picture.width + x) * 4];
    return {byteFromLinear(rgba[0]), byteFromLinear(rgba[1]), byteFromLinear(rgba[2])};
  }
  static float depth(const Picture& picture, int x, int y) {
    return picture.depth_m[static_cast<std::size_t>(y * picture.width + x)];
  }

  osg::ref_ptr<osg::Group> root_ = new osg::Group;
};

CameraView lookDown(double height) { return {.eye_from_fixed = lookAt({0, 0, height}, {0, 0, 0}, {0, 1, 0})}; }

TEST_F(OffscreenRendererTest, DrawsBackgroundWithInfiniteDepthForAnEmptyScene) {
  const auto picture = renderer_->render(*root_, {}, {.width = 8, .height = 4, .background = {0.2F, 0.4F, 0.6F, 1.0F}});
  ASSERT_TRUE(picture);
  ASSERT_EQ(picture->rgba.size(), 8U * 4U * 4U);
  EXPECT_EQ(pixel(*picture, 7, 3), (std::array{51, 102, 153}));
  EXPECT_EQ(picture->rgba[3], 1.0F);
  EXPECT_EQ(depth(*picture, 0, 0), std::numeric_limits<float>::infinity());
  EXPECT_EQ(renderer_->lastFrame().passes, std::vector<std::string>{"scene"});
}

TEST_F(OffscreenRendererTest, ATransparentBackgroundLeavesWhatHidesIt) {
  // From left to right an opaque thing, one of alpha 0.25, and nothing.
  root_->addChild(makeShape(GL_QUADS, {{-3, -1, 0}, {-1, -1, 0}, {-1, 1, 0}, {-3, 1, 0}}, {{1, 0, 0, 1}}));
  const auto pane = makeShape(GL_QUADS, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 0, 0.25F}});
  setBlended(*pane->getOrCreateStateSet(), true);
  root_->addChild(pane);
  CameraView view = lookDown(3.0);
  view.is_orthographic = true;
  view.vertical_extent_m = 2.0;
  const auto at = [](const Picture& picture, std::size_t x) {
    const float* rgba = &picture.rgba[4 * (8 * 48 + x)];
    return std::array{rgba[0], rgba[1], rgba[2], rgba[3]};
  };
  RenderOptions options{.width = 48, .height = 16, .background = {0, 0, 0, 0}};
  const auto clear = renderer_->render(*root_, view, options);
  ASSERT_TRUE(clear);
  EXPECT_TRUE(clear->has_alpha);
  EXPECT_EQ(at(*clear, 4), (std::array{1.0F, 0.0F, 0.0F, 1.0F}));
  for (const auto& [channel, value] : {std::pair{1, 0.25F}, {3, 0.25F}, {0, 0.0F}}) {
    EXPECT_NEAR(at(*clear, 24)[static_cast<std::size_t>(channel)], value, 1e-3F) << "premultiplied";
  }
  EXPECT_EQ(at(*clear, 44), (std::array{0.0F, 0.0F, 0.0F, 0.0F}));

  options.background = {1, 1, 1, 0.5F};
  const auto half = renderer_->render(*root_, view, options);
  ASSERT_TRUE(half);
  EXPECT_EQ(at(*half, 4), (std::array{1.0F, 0.0F, 0.0F, 1.0F}));
  EXPECT_NEAR(at(*half, 24)[3], 0.25F + 0.75F * 0.5F, 1e-3F);
  EXPECT_EQ(at(*half, 44), (std::array{0.5F, 0.5F, 0.5F, 0.5F}));

  options.background.a = 1.0F;
  const auto opaque = renderer_->render(*root_, view, options);
  ASSERT_TRUE(opaque);
  EXPECT_FALSE(opaque->has_alpha);
  EXPECT_EQ(at(*opaque, 24)[3], 1.0F);
}

TEST_F(OffscreenRendererTest, PutsThePictureUpright) {
  root_->addChild(makeShape(GL_TRIANGLES, {{-1, 1, 0}, {0, 1, 0}, {-1, 0, 0}}, {{1, 0, 0, 1}}));
  const Picture picture = draw(lookDown(3.0), 64, 64);
  EXPECT_EQ(pixel(picture, 20, 20), (std::array{255, 0, 0}));  // x left, y up
  EXPECT_NE(pixel(picture, 20, 44), (std::array{255, 0, 0}));
  EXPECT_NE(pixel(picture, 44, 20), (std::array{255, 0, 0}));
}

TEST_F(OffscreenRendererTest, GivesDepthInMetresFromFiveCentimetresToTenThousandKilometres) {
  for (const double distance : {0.05, 1.0, 1e3, 1e7}) {
    root_->removeChildren(0, root_->getNumChildren());
    const auto size = static_cast<float>(distance * 10.0);
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform{osg::Matrixd::translate(0, 0, -distance)};
    place->addChild(makeQuad(size, size, 0.0F, {1, 1, 1, 1}));
    root_->addChild(place);
    const Picture picture = draw({}, 16, 16);
    EXPECT_NEAR(depth(picture, 8, 8) / distance, 1.0, 1e-6) << distance;
  }
}

TEST_F(OffscreenRendererTest, GivesDepthInMetresForAnOrthographicView) {
  root_->addChild(makeQuad(2.0F, 2.0F, 1.0F, {1, 1, 1, 1}));
  CameraView view = lookDown(3.0);
  view.is_orthographic = true;
  view.vertical_extent_m = 10.0;
  for (const double half_depth_m : {1e2, 1e4, 1e6}) {
    view.half_depth_m = half_depth_m;
    const Picture picture = draw(view, 50, 50);
    EXPECT_NEAR(depth(picture, 25, 25), 2.0, 1.2e-7 * half_depth_m) << half_depth_m;  // 24 bits over twice that
    EXPECT_EQ(depth(picture, 1, 1), std::numeric_limits<float>::infinity());
  }
}

TEST_F(OffscreenRendererTest, SeparatesMillimetresInAnOrthographicViewOnTheEarthsSurface) {
  // Half the picture each: the nearer quad drawn first, the nearer drawn last; 5 mm between them.
  const glm::dvec3 ecef{-2694892.0, -4297557.0, 3854577.0};
  const auto add = [&](double x, double z, const osg::Vec4& color) {
    osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform{osg::Matrixd::translate(ecef.x + x, ecef.y, ecef.z + z)};
    place->addChild(makeQuad(1.0F, 2.0F, 0.0F, color));
    root_->addChild(place);
  };
  add(-1.0, 0.005, {1, 0, 0, 1});
  add(-1.0, 0.0, {0, 1, 0, 1});
  add(1.0, 0.0, {0, 1, 0, 1});
  add(1.0, 0.005, {1, 0, 0, 1});
  CameraView view{.eye_from_fixed = lookAt(ecef + glm::dvec3(0, 0, 50), ecef, {0, 1, 0})};
  view.is_orthographic = true;
  view.vertical_extent_m = 4.0;
  const Picture picture = draw(view, 64, 64);
  EXPECT_EQ(pixel(picture, 16, 32), (std::array{255, 0, 0}));
  EXPECT_EQ(pixel(picture, 48, 32), (std::array{255, 0, 0}));
}

TEST_F(OffscreenRendererTest, SeparatesNearAndFarInOnePicture) {
  // Left half: 5 cm before 6 cm. Right half: 10 000 km before 10 010 km. The farther is drawn last in both.
  const auto add = [&](double distance, double side, const osg::Vec4& color) {
    osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform{osg::Matrixd::translate(side * distance * 5.0, 0, -distance)};
    const auto half = static_cast<float>(distance * 5.0);
    place->addChild(makeQuad(half, half, 0.0F, color));
    root_->addChild(place);
  };
  add(0.05, -1.0, {1, 0, 0, 1});
  add(0.06, -1.0, {0, 1, 0, 1});
  add(1.000e7, 1.0, {0, 0, 1, 1});
  add(1.001e7, 1.0, {1, 1, 0, 1});
  const Picture picture = draw({}, 64, 64);
  EXPECT_EQ(pixel(picture, 10, 32), (std::array{255, 0, 0}));
  EXPECT_EQ(pixel(picture, 54, 32), (std::array{0, 0, 255}));
}

TEST_F(OffscreenRendererTest, BringsEverySrgbByteBackExactly) {
  std::vector<osg::Vec3> vertices;
  std::vector<osg::Vec4> colors;
  for (int value = 0; value < 256; ++value) {
    const float x = static_cast<float>(value) - 127.5F;
    const float shade = static_cast<float>(value) / 255.0F;
    vertices.emplace_back(x, 0.0F, 0.0F);
    colors.emplace_back(shade, 1.0F - shade, shade, 1.0F);
  }
  root_->addChild(makeShape(GL_POINTS, vertices, colors));
  CameraView view = lookDown(10.0);
  view.is_orthographic = true;
  view.vertical_extent_m = 5.0;
  const auto state = root_->getOrCreateStateSet();
  state->setMode(GL_VERTEX_PROGRAM_POINT_SIZE, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
  const Picture picture = draw(view, 256, 5);
  for (int value = 0; value < 256; ++value) {
    EXPECT_EQ(pixel(picture, value, 2), (std::array{value, 255 - value, value}));
  }
}

TEST_F(OffscreenRendererTest, DrawsTheSamePixelsFarFromTheOrigin) {
  const auto scene = [](const osg::Vec3d& offset) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform{osg::Matrixd::rotate(0.3, 0.2, 0.5, 0.8) * osg::Matrixd::translate(offset)};
    place->addChild(makeQuad(0.7F, 0.4F, 0.1F, {0.8F, 0.3F, 0.1F, 1}));
    place->addChild(makeShape(GL_LINES, {{-1, -1, 0}, {1, 1, 0.5F}, {-1, 1, 0}, {1, -1, 0}}, {{0, 1, 1, 1}}));
    place->addChild(makeShape(GL_POINTS, {{0.9F, 0, 0}, {0, 0.9F, 0.3F}}, {{1, 1, 0, 1}}));
    root->addChild(place);
    return root;
  };
  const glm::dvec3 eye{1.5, -2.0, 1.25};
  const glm::dvec3 ecef{-2694892.0, -4297557.0, 3854577.0};  // whole numbers: the offset itself costs no rounding
  root_ = scene({0, 0, 0});
  const Picture at_origin = draw({.eye_from_fixed = lookAt(eye, {0, 0, 0}, {0, 0, 1})}, 320, 240);
  root_ = scene({ecef.x, ecef.y, ecef.z});
  const Picture far_away = draw({.eye_from_fixed = lookAt(ecef + eye, ecef, {0, 0, 1})}, 320, 240);
  ASSERT_LT(depth(at_origin, 160, 120), 10.0F);  // something is there to compare
  std::size_t different = 0;
  for (std::size_t i = 0; i < at_origin.rgba.size(); ++i) {
    different += at_origin.rgba[i] != far_away.rgba[i] ? 1U : 0U;
  }
  EXPECT_EQ(different, 0U);
}

TEST_F(OffscreenRendererTest, DrawsOnePointAlone) {
  root_->addChild(makeShape(GL_POINTS, {{0, 0, 0}}, {{1, 1, 1, 1}}));
  EXPECT_EQ(pixel(draw(lookDown(3.0), 65, 65), 32, 32), (std::array{255, 255, 255}));
}

TEST_F(OffscreenRendererTest, IgnoresADepthFunctionMadeForOrdinaryDepth) {
  const auto quad = makeQuad(1.0F, 1.0F, 0.0F, {0, 1, 0, 1});
  quad->getOrCreateStateSet()->setAttributeAndModes(new osg::Depth{osg::Depth::LESS});
  root_->addChild(quad);
  EXPECT_EQ(pixel(draw(lookDown(3.0), 9, 9), 4, 4), (std::array{0, 255, 0}));
}

TEST_F(OffscreenRendererTest, RefusesSizesThatCannotBe) {
  EXPECT_EQ(renderer_->render(*root_, {}, {.width = 0, .height = 0}).error().code, "BadSize");
  EXPECT_EQ(renderer_->render(*root_, {}, {.width = -5, .height = 9}).error().code, "BadSize");
  EXPECT_EQ(renderer_->render(*root_, {}, {.width = 100000, .height = 100000}).error().code, "TooLarge");
  EXPECT_EQ(renderer_->render(*root_, {}, {.width = 16384, .height = 16384}).error().code, "TooLarge");
  EXPECT_TRUE(renderer_->render(*root_, {}, {.width = 1, .height = 1}));
}

TEST_F(OffscreenRendererTest, DrawsAnotherRootAfterTheFirst) {
  root_->addChild(makeQuad(1, 1, 0, {1, 0, 0, 1}));
  EXPECT_EQ(pixel(draw(lookDown(3.0), 9, 9), 4, 4), (std::array{255, 0, 0}));
  const auto first = root_;
  root_ = new osg::Group;
  root_->addChild(makeQuad(1, 1, 0, {0, 0, 1, 1}));
  EXPECT_EQ(pixel(draw(lookDown(3.0), 9, 9), 4, 4), (std::array{0, 0, 255}));
  root_ = first;
  EXPECT_EQ(pixel(draw(lookDown(3.0), 9, 9), 4, 4), (std::array{255, 0, 0}));
}

TEST_F(OffscreenRendererTest, APassOfTwoInputsReadsThemAfterAnotherPipelineToo) {
  PostChain chain;
  chain.passes.push_back({.name = "both",
                          .fragment_source = "#version 450 compatibility\n"
                                             "uniform sampler2D u_image;\nuniform sampler2D u_depth;\nvoid main() {\n"
                                             "  float depth = texelFetch(u_depth, ivec2(gl_FragCoord.xy), 0).r;\n"
                                             "  gl_FragColor = texelFetch(u_image, ivec2(gl_FragCoord.xy), 0) * "
                                             "(depth > 0.0 ? 1.0 : 0.0);\n}\n",
                          .inputs = {{"u_image", "scene"}, {"u_depth", "depth"}}});
  for (int round = 0; round < 3; ++round) {
    root_ = new osg::Group;  // so that the renderer makes a pipeline for it, while the texture units stay as they were
    root_->addChild(makeQuad(1, 1, 0, {1, 0, 0, 1}));
    const auto picture = renderer_->render(*root_, lookDown(3.0), {.width = 9, .height = 9, .post = chain});
    ASSERT_TRUE(picture);
    EXPECT_EQ(pixel(*picture, 4, 4), (std::array{255, 0, 0})) << round;
  }
}

}  // namespace
}  // namespace stillframe::scenegraph
