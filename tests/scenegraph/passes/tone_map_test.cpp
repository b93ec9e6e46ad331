#include "scenegraph/passes/tone_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <osg/BlendFunc>
#include <vector>

#include "tests/scenegraph/passes/pass_scene.h"

namespace stillframe::scenegraph {
namespace {

constexpr int kSteps = 256;

PostChain toneChain(const ToneMapSettings& settings) {
  PostChain chain;
  appendToneMap(settings, chain);
  return chain;
}

class ToneMapTest : public PassTest {
 protected:
  Picture drawRow(const std::vector<osg::Vec4>& colors, const ToneMapSettings& settings) {
    root_ = new osg::Group;
    root_->addChild(makeRow(colors));
    return draw(lookAcross(static_cast<int>(colors.size()), 2), static_cast<int>(colors.size()), 2,
                toneChain(settings));
  }
  /// From 2^-12 to 2^15.9, with alpha as the share of data.
  static std::vector<osg::Vec4> ramp(float alpha) {
    std::vector<osg::Vec4> colors;
    for (int i = 0; i < kSteps; ++i) {
      const float light = std::exp2(-12.0F + 27.9F * static_cast<float>(i) / (kSteps - 1));
      colors.emplace_back(light, 0.5F * light, 0.25F * light, alpha);
    }
    return colors;
  }
};

TEST_F(ToneMapTest, CurvesAreMonotoneAndEndAtWhite) {
  for (const char* curve : {"aces", "neutral"}) {
    for (const double exposure : {-16.0, -2.0, 0.0, 3.0, 16.0}) {
      const Picture row = drawRow(ramp(0.0F), {curve, exposure});
      EXPECT_EQ(badValues(row), 0U);
      for (int i = 1; i < kSteps; ++i) {
        EXPECT_GE(red(row, i, 0), red(row, i - 1, 0)) << curve << exposure << " at " << i;
      }
      EXPECT_LE(red(row, kSteps - 1, 0), 1.0F) << curve << exposure;
    }
    EXPECT_GT(red(drawRow(ramp(0.0F), {curve, 0.0}), kSteps - 1, 0), 0.97F) << curve;
  }
}

TEST_F(ToneMapTest, HitsThePublishedValues) {
  const Picture aces = drawRow({{0.18F, 0.18F, 0.18F, 0}, {1, 1, 1, 0}}, {"aces", 0.0});
  EXPECT_NEAR(red(aces, 0, 0), 0.18F * (2.51F * 0.18F + 0.03F) / (0.18F * (2.43F * 0.18F + 0.59F) + 0.14F), 1e-3F);
  EXPECT_NEAR(red(aces, 1, 0), 2.54F / 3.16F, 1e-3F);
  // Below the start of its compression the neutral curve takes 4 % off and does nothing else.
  const Picture neutral = drawRow({{0.5F, 0.25F, 0.125F, 0}, {0.8F, 0.8F, 0.8F, 0}, {1, 1, 1, 0}}, {"neutral", 0.0});
  EXPECT_NEAR(red(neutral, 0, 0), 0.46F, 1e-3F);
  EXPECT_NEAR(red(neutral, 1, 0), 0.76F, 1e-3F);
  EXPECT_NEAR(red(neutral, 2, 0), 1.0F - 0.24F * 0.24F / (0.96F + 0.24F - 0.76F), 1e-3F);
}

/// Khronos PBR Neutral as its specification writes it, beside the shader's own way of writing it.
std::array<double, 3> specifiedNeutral(const osg::Vec4& light) {
  const double least = std::min({light.x(), light.y(), light.z()});
  const double offset = least < 0.08 ? least - 6.25 * least * least : 0.04;
  std::array<double, 3> color{light.x() - offset, light.y() - offset, light.z() - offset};
  const double peak = *std::ranges::max_element(color);
  if (peak >= 0.76) {
    const double compressed = 1.0 - 0.24 * 0.24 / (peak + 0.24 - 0.76);
    const double grey = 1.0 - 1.0 / (0.15 * (peak - compressed) + 1.0);
    for (double& part : color) {
      part = part * compressed / peak * (1.0 - grey) + compressed * grey;
    }
  }
  return color;
}

TEST_F(ToneMapTest, NeutralIsTheSpecifiedCurveWhichTakesOffTheSameFromAllChannelsBelowItsStart) {
  std::vector<osg::Vec4> colors;
  for (const float peak : {0.0F, 0.01F, 0.0625F, 0.078125F, 0.09375F, 0.25F, 0.5F, 0.75F, 0.875F, 1.0F, 2.0F, 16.0F}) {
    for (const float share : {0.0F, 0.125F, 0.5F, 1.0F}) {
      colors.emplace_back(peak, peak * share, 0.5F * peak * (1.0F + share), 0.0F);
    }
  }
  const Picture row = drawRow(colors, {"neutral", 0.0});
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const auto specified = specifiedNeutral(colors[i]);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(row.rgba[4 * i + channel], specified[channel], 1e-3) << i << ' ' << channel;
    }
    if (colors[i].x() <= 0.75F) {
      EXPECT_NEAR(row.rgba[4 * i] - row.rgba[4 * i + 1], colors[i].x() - colors[i].y(), 1e-3)
          << "linear, but less what a dielectric reflects: it is not the identity";
    }
  }
}

TEST_F(ToneMapTest, ExposureDoublesTheLightOfEachStep) {
  const Picture row = drawRow({{0.125F, 0.25F, 0.5F, 0}}, {"none", 2.0});
  EXPECT_EQ(red(row, 0, 0), 0.5F);
  EXPECT_EQ(row.rgba[2], 2.0F);
}

TEST_F(ToneMapTest, DataColoursComeOutBitForBit) {
  const Picture untouched = drawRow(ramp(1.0F), {"none", 0.0});
  for (const char* curve : {"none", "aces", "neutral"}) {
    for (const double exposure : {-16.0, -1.0, 0.0, 5.0, 16.0}) {
      EXPECT_EQ(drawRow(ramp(1.0F), {curve, exposure}).rgba, untouched.rgba) << curve << exposure;
    }
  }
}

TEST_F(ToneMapTest, DataBlendedOverDataAndBackgroundIsNotGraded) {
  background_ = {0.9F, 0.2F, 0.4F, 1.0F};
  root_->addChild(makeShape(GL_QUADS, {{0, -1, 0}, {2, -1, 0}, {2, 1, 0}, {0, 1, 0}}, {{0, 1, 0, 1}}));
  for (const float left : {0.0F, 1.0F}) {
    const auto translucent =
        makeShape(GL_QUADS, {{left, -1, 1}, {left + 3, -1, 1}, {left + 3, 1, 1}, {left, 1, 1}}, {{1, 0.5F, 0, 0.3F}});
    translucent->getOrCreateStateSet()->setAttributeAndModes(
        new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA));
    translucent->getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    root_->addChild(translucent);
  }
  const Picture plain = draw(lookAcross(6, 2), 6, 2, {});
  EXPECT_EQ(draw(lookAcross(6, 2), 6, 2, toneChain({"aces", 4.0})).rgba, plain.rgba);
}

TEST_F(ToneMapTest, DataOverAGradedSurfaceLeavesItsShareUngraded) {
  const auto surface = [](float x) {
    return makeRawShape(GL_QUADS, {{x, -1, 0}, {x + 1, -1, 0}, {x + 1, 1, 0}, {x, 1, 0}}, {{0.5F, 0.5F, 0.5F, 0.0F}});
  };
  root_->addChild(surface(0));
  root_->addChild(surface(1));
  const auto data = makeShape(GL_QUADS, {{1, -1, 1}, {2, -1, 1}, {2, 1, 1}, {1, 1, 1}}, {{1, 1, 1, 0.5F}});
  data->getOrCreateStateSet()->setAttributeAndModes(
      new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA));
  root_->addChild(data);
  const Picture picture = draw(lookAcross(2, 2), 2, 2, toneChain({"none", 1.0}));
  EXPECT_EQ(red(picture, 0, 0), 1.0F);
  // 0.75 in all, of which half is to be graded.
  EXPECT_NEAR(red(picture, 1, 0), 0.5F * 1.5F + 0.5F * 0.75F, 1e-3F);
}

}  // namespace
}  // namespace stillframe::scenegraph
