#include <limits>

#include "scenegraph/passes/view_effects.h"
#include "tests/scenegraph/passes/pass_scene.h"

namespace stillframe::scenegraph {
namespace {

/// Every effect alone, both resolutions and modes of those that have two, then all of them.
std::vector<PostChain> allChains() {
  std::vector<PostChain> chains;
  ViewEffects all;
  for (const EffectType& type : effectTypes()) {
    ViewEffects alone;
    alone.setOn(type.name, true);
    all.setOn(type.name, true);
    chains.push_back(alone.chain());
  }
  for (const SettingTexts& aa :
       {SettingTexts{{"mode", "fxaa"}}, {{"mode", "ssaa"}, {"samples", "2"}}, {{"mode", "msaa"}}}) {
    EXPECT_TRUE(all.apply("aa", aa));
    EXPECT_TRUE(all.apply("ssao", {{"half_resolution", aa.at("mode") == "fxaa" ? "true" : "false"}}));
    chains.push_back(all.chain());
  }
  return chains;
}

class ExtremeTest : public PassTest {
 protected:
  void expectFinite(const CameraView& view, int width, int height, const std::string& what) {
    const std::vector<PostChain> chains = allChains();
    for (std::size_t i = 0; i < chains.size(); ++i) {
      EXPECT_EQ(badValues(draw(view, width, height, chains[i])), 0U) << what << ", chain " << i;
    }
  }
  static CameraView lookDown(double distance_m) {
    return {.eye_from_fixed = lookAt({0, 0, distance_m}, {0, 0, 0}, {0, 1, 0})};
  }
};

TEST_F(ExtremeTest, NoNaNLeavesAPassWhateverGoesIn) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::vector<osg::Vec4> colors;
  for (const float value : {kNaN, -kNaN, kInfinity, -kInfinity, 1e38F, -1e38F, 65505.0F, -1.0F, 1e-45F}) {
    colors.emplace_back(value, 0.5F, 0.25F, 0.0F);
    colors.emplace_back(0.5F, value, value, 1.0F);
    colors.emplace_back(value, value, value, value);
  }
  const int width = static_cast<int>(colors.size());
  root_->addChild(makeRow(colors));
  expectFinite(lookAcross(width, 8), width, 8, "colours");
}

TEST_F(ExtremeTest, FiveCentimetresBesideTenThousandKilometres) {
  root_->addChild(makeQuad(0.02F, 0.02F, 0.0F, {1, 0, 0, 1}));
  root_->addChild(makeQuad(8e6F, 8e6F, -1e7F, {0, 1, 0, 1}));
  root_->addChild(makeQuad(8.0F, 3.0F, -10.0F, {0, 0, 1, 1}));
  expectFinite(lookDown(0.05), 64, 48, "depths");
  ViewEffects effects;
  effects.setOn("ssao", true);
  const Picture plain = draw(lookDown(0.05), 64, 48, {});
  const Picture shaded = draw(lookDown(0.05), 64, 48, effects.chain());
  // A thing 10 m behind another takes no light from it, and the far wall none at all.
  EXPECT_EQ(red(shaded, 32, 24), red(plain, 32, 24));
  const std::size_t corner = 4 * (2 * 64 + 2);
  EXPECT_EQ(shaded.rgba[corner + 1], plain.rgba[corner + 1]);
  EXPECT_GT(plain.rgba[corner + 1], 0.9F);
}

TEST_F(ExtremeTest, AnEarthCentredSceneIsTheSamePicture) {
  const glm::dvec3 ecef{-2694892.0, -4297557.0, 3854577.0};
  const auto scene = [](const glm::dvec3& origin) {
    osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform(osg::Matrix::translate(origin.x, origin.y, origin.z));
    place->addChild(makeCorner(2.0F));
    return place;
  };
  const glm::dvec3 eye{1.5, -2.0, 3.25};
  for (const PostChain& chain : allChains()) {
    root_ = scene({0, 0, 0});
    const Picture here = draw({.eye_from_fixed = lookAt(eye, {0, 0, 0}, {0, 0, 1})}, 96, 64, chain);
    root_ = scene(ecef);
    EXPECT_EQ(draw({.eye_from_fixed = lookAt(ecef + eye, ecef, {0, 0, 1})}, 96, 64, chain).rgba, here.rgba);
  }
}

TEST_F(ExtremeTest, SmallestPictures) {
  root_ = makeCorner(2.0F);
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {1, 2}, {3, 3}, {1, 300}, {300, 1}}) {
    expectFinite(lookDown(3.0), width, height, std::to_string(width) + "x" + std::to_string(height));
  }
}

TEST_F(ExtremeTest, AnEmptySkyIsTheBackground) {
  background_ = {1, 1, 1, 1};
  for (const PostChain& chain : allChains()) {
    const Picture sky = draw(lookDown(3.0), 40, 30, chain);
    EXPECT_EQ(std::ranges::count(sky.rgba, 1.0F), 40 * 30 * 4);
  }
}

TEST_F(ExtremeTest, CameraInsideAMeshAndOnASurface) {
  root_->addChild(makeQuad(1, 1, -0.0101F, {1, 1, 1, 1}));
  root_->addChild(makeQuad(1, 1, 0.02F, {1, 1, 1, 1}));
  root_->addChild(makeCorner(0.05F));
  expectFinite({.eye_from_fixed = lookAt({0, 0, 0}, {0, 0, -1}, {0, 1, 0})}, 64, 48, "inside");
  expectFinite({.eye_from_fixed = lookAt({0, 0, 0.01}, {1, 0.2, 0.0}, {0, 0, 1})}, 64, 48, "along");
}

TEST_F(ExtremeTest, OrthographicViewsOfAnyDepth) {
  root_ = makeCorner(2.0F);
  for (const double half_depth : {1.0, 1e4, 1e9}) {
    expectFinite({.eye_from_fixed = lookAt({0, 0, 0.5}, {0, 0, 0}, {0, 1, 0}),
                  .is_orthographic = true,
                  .vertical_extent_m = 4.0,
                  .half_depth_m = half_depth},
                 64, 48, "orthographic " + std::to_string(half_depth));
  }
}

TEST_F(ExtremeTest, TheLargestPictureAndOneBeyond) {
  ViewEffects effects;
  effects.setOn("edl", true);
  effects.setOn("tonemap", true);
  root_->addChild(makeQuad(0.5F, 0.5F, 0, {1, 1, 1, 1}));
  {
    const Picture picture = draw(lookDown(3.0), 8192, 8192, effects.chain());
    ASSERT_EQ(picture.rgba.size(), std::size_t{8192} * 8192 * 4);
    EXPECT_EQ(red(picture, 4096, 4096), 1.0F);
    EXPECT_EQ(red(picture, 8191, 8191), 0.0F);
  }
  for (const auto& [width, height] : {std::pair{8193, 8192}, {100'000, 2}}) {
    const auto refused =
        renderer_->render(*root_, lookDown(3.0), {.width = width, .height = height, .post = effects.chain()});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, "TooLarge");
  }
  EXPECT_TRUE(effects.apply("aa", {{"mode", "msaa"}, {"samples", "64"}}));
  effects.setOn("aa", true);
  const auto refused =
      renderer_->render(*root_, lookDown(3.0), {.width = 8192, .height = 8192, .post = effects.chain()});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "TooLarge");
  EXPECT_NE(refused.error().message.find("MiB"), std::string::npos);
}

}  // namespace
}  // namespace stillframe::scenegraph
