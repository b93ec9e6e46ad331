#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenegraph/export/picture_io.h"
#include "scenegraph/passes/view_effects.h"
#include "tests/support/golden.h"
#include "tests/support/offscreen_test.h"
#include "tools/accuracy/post_scene.h"

namespace stillframe::scenegraph {
namespace {

using test::matchesGolden;

constexpr int kWidth = 240;
constexpr int kHeight = 160;

/// The scene of the accuracy report through each effect alone and through all; the numbers beside say what it did.
class EffectPicture : public test::OffscreenTest {
 protected:
  void SetUp() override {
    OffscreenTest::SetUp();
    plain_ = draw({});
  }
  Picture draw(const ViewEffects& effects) {
    return render(*scene_, accuracy::postSceneView(), {.width = kWidth, .height = kHeight, .post = effects.chain()});
  }
  static ViewEffects with(const std::string& effect, const SettingTexts& settings = {}) {
    ViewEffects effects;
    effects.setOn(effect, true);
    EXPECT_TRUE(effects.apply(effect, settings));
    return effects;
  }
  /// Mean of light up to white.
  static double light(const Picture& picture) {
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
      sum += i % 4 == 3 ? 0.0 : std::min(1.0, static_cast<double>(picture.rgba[i]));
    }
    return sum / (3.0 * kWidth * kHeight);
  }
  /// Pixels that differ from the plain picture by more than a byte's step, in parts of all.
  [[nodiscard]] double changed(const Picture& picture) const {
    const BytePicture a = toBytes(plain_);
    const BytePicture b = toBytes(picture);
    int count = 0;
    for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
      bool differs = false;
      for (std::size_t c = i; c < i + 3; ++c) {
        differs = differs || std::abs(a.rgb[c] - b.rgb[c]) > 1;
      }
      count += differs ? 1 : 0;
    }
    return static_cast<double>(count) / (kWidth * kHeight);
  }

  osg::ref_ptr<osg::Group> scene_ = accuracy::makePostScene();
  Picture plain_;
};

TEST_F(EffectPicture, None) {
  EXPECT_TRUE(matchesGolden(toBytes(plain_), "effects_none"));
  EXPECT_EQ(changed(plain_), 0.0);
}

TEST_F(EffectPicture, AmbientOcclusion) {
  const Picture picture = draw(with("ssao", {{"radius", "1"}, {"samples", "16"}, {"smoothing", "true"}}));
  EXPECT_TRUE(matchesGolden(toBytes(picture), "effects_ssao"));
  EXPECT_LT(light(picture), 0.99 * light(plain_));
  EXPECT_GT(light(picture), 0.8 * light(plain_));
}

TEST_F(EffectPicture, EyeDomeLighting) {
  const Picture picture = draw(with("edl", {{"radius", "8"}}));
  EXPECT_TRUE(matchesGolden(toBytes(picture), "effects_edl"));
  EXPECT_LT(light(picture), 0.97 * light(plain_));
  EXPECT_GT(light(picture), 0.5 * light(plain_));
}

TEST_F(EffectPicture, ToneMapping) {
  const Picture aces = draw(with("tonemap", {{"curve", "aces"}, {"exposure", "-0.5"}}));
  EXPECT_TRUE(matchesGolden(toBytes(aces), "effects_aces"));
  const Picture neutral = draw(with("tonemap", {{"curve", "neutral"}, {"exposure", "-0.5"}}));
  EXPECT_TRUE(matchesGolden(toBytes(neutral), "effects_neutral"));
  EXPECT_LT(light(neutral), light(plain_));
  EXPECT_GT(changed(neutral), 0.4);
}

TEST_F(EffectPicture, ExposureAlone) {
  const Picture picture = draw(with("tonemap", {{"curve", "none"}, {"exposure", "-1"}}));
  EXPECT_TRUE(matchesGolden(toBytes(picture), "effects_exposure"));
  EXPECT_LT(light(picture), 0.75 * light(plain_));
  EXPECT_GT(light(picture), 0.4 * light(plain_)) << "points and lines keep their light";
}

TEST_F(EffectPicture, Dithering) {
  const Picture picture = draw(with("dither"));
  EXPECT_TRUE(matchesGolden(toBytes(picture), "effects_dither"));
  EXPECT_EQ(changed(picture), 0.0) << "a step of a byte, no more";
  EXPECT_NE(toBytes(picture), toBytes(plain_));
  EXPECT_NEAR(light(picture), light(plain_), 1e-3);
}

TEST_F(EffectPicture, Antialiasing) {
  const Picture truth = draw(with("aa", {{"mode", "ssaa"}, {"samples", "64"}}));
  const auto error = [&](const Picture& picture) {
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
      const double difference =
          std::min(1.0, static_cast<double>(picture.rgba[i])) - std::min(1.0, static_cast<double>(truth.rgba[i]));
      sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(picture.rgba.size()));
  };
  for (const char* mode : {"fxaa", "msaa", "ssaa"}) {
    const Picture picture = draw(with("aa", {{"mode", mode}}));
    EXPECT_TRUE(matchesGolden(toBytes(picture), std::string("effects_") + mode));
    EXPECT_LT(error(picture), error(plain_)) << mode;
  }
}

TEST_F(EffectPicture, AllTogether) {
  ViewEffects all;
  for (const EffectType& type : effectTypes()) {
    all.setOn(type.name, true);
  }
  ASSERT_TRUE(all.apply("tonemap", {{"exposure", "-0.5"}}));
  ASSERT_TRUE(all.apply("ssao", {{"samples", "16"}, {"smoothing", "true"}}));
  ASSERT_TRUE(all.apply("aa", {{"mode", "msaa"}}));
  const Picture picture = draw(all);
  EXPECT_TRUE(matchesGolden(toBytes(picture), "effects_all"));
  EXPECT_LT(light(picture), light(plain_));
  EXPECT_GT(changed(picture), 0.4);
}

}  // namespace
}  // namespace stillframe::scenegraph
