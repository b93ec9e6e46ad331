#include "scenegraph/passes/view_effects.h"
#include "tests/nodes/robot_scene.h"
#include "tests/nodes/scene_picture.h"

namespace stillframe::test {
namespace {

/// Which colours of real layers exposure and tone mapping touch.
class GradedColors : public ScenePictureTest {
 protected:
  void SetUp() override {
    ScenePictureTest::SetUp();
    open(robotAt({0, 0, 0}), "map");
  }
  scenegraph::BytePicture drawWith(const scenegraph::SettingTexts& tone) {
    scenegraph::ViewEffects effects;
    effects.setOn("tonemap", !tone.empty());
    EXPECT_TRUE(effects.apply("tonemap", tone));
    return draw(1_s, {.eye_from_fixed = scenegraph::lookAt({3.5, -5.0, 4.0}, {0, 0, 0.3}, {0, 0, 1})}, 160, 120,
                effects.chain());
  }
};

TEST_F(GradedColors, ALegendsColoursAreTheSameUnderEveryToneMapper) {
  add("grid");
  add("tf", {{"axis_length", "0.8"}, {"hidden_frames", "utm"}});
  scenegraph::Layer& cloud = add("/points", {{"color_field", "z"}, {"point_size", "3"}});
  for (const scenegraph::SettingTexts& settings :
       {scenegraph::SettingTexts{}, {{"colormap", "viridis"}, {"color_field", "intensity"}}, {{"opacity", "0.5"}}}) {
    ASSERT_TRUE(cloud.applySettings(settings));
    const auto plain = drawWith({});
    ASSERT_GT(drawnPixels(plain), 3000);
    for (const char* curve : {"none", "aces", "neutral"}) {
      for (const char* exposure : {"-4", "0", "1.5", "8"}) {
        EXPECT_EQ(drawWith({{"curve", curve}, {"exposure", exposure}}), plain) << curve << ' ' << exposure;
      }
    }
  }
}

TEST_F(GradedColors, PhotographicColoursAreGraded) {
  add("/points", {{"color_field", "rgb"}, {"point_size", "3"}});
  const auto sum = [](const scenegraph::BytePicture& picture) {
    double total = 0.0;
    for (const std::uint8_t value : picture.rgb) {
      total += value;
    }
    return total;
  };
  const double plain = sum(drawWith({}));
  EXPECT_GT(sum(drawWith({{"curve", "none"}, {"exposure", "1"}})), 1.2 * plain);
  EXPECT_LT(sum(drawWith({{"curve", "none"}, {"exposure", "-1"}})), 0.8 * plain);
  EXPECT_NE(sum(drawWith({{"curve", "aces"}})), plain);
}

}  // namespace
}  // namespace stillframe::test
