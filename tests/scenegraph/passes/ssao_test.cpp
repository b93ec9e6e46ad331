#include "scenegraph/passes/ssao.h"

#include "tests/scenegraph/passes/pass_scene.h"

namespace stillframe::scenegraph {
namespace {

constexpr int kSide = 120;

PostChain ssaoChain(const SsaoSettings& settings) {
  PostChain chain;
  appendSsao(settings, chain);
  return chain;
}

/// Towards the origin from `distance_m`, `angle_deg` off the z axis.
CameraView lookDown(double distance_m, double angle_deg, bool is_orthographic) {
  const double angle = angle_deg * std::numbers::pi / 180.0;
  const glm::dvec3 eye(std::sin(angle) * distance_m, 0.0, std::cos(angle) * distance_m);
  return {.eye_from_fixed = lookAt(eye, {0, 0, 0}, {0, 1, 0}),
          .is_orthographic = is_orthographic,
          .vertical_extent_m = 2.0 * distance_m,
          .near_m = 1e-3 * distance_m,
          .half_depth_m = 100.0 * distance_m};
}

class SsaoTest : public PassTest {};

TEST_F(SsaoTest, LeavesAPlaneAloneAtEveryAngle) {
  root_->addChild(makeQuad(400, 400, 0, {1, 1, 1, 1}));
  for (const bool is_orthographic : {false, true}) {
    for (const bool is_half : {false, true}) {
      for (const double angle : {0.0, 10.0, 30.0, 45.0, 60.0, 75.0, 85.0, 88.0}) {
        const CameraView view = lookDown(4.0, angle, is_orthographic);
        const Picture plain = draw(view, kSide, kSide, {});
        const Picture shaded = draw(view, kSide, kSide, ssaoChain({.radius = 1.0, .half_resolution = is_half}));
        EXPECT_EQ(plain.rgba, shaded.rgba)
            << angle << " degrees, orthographic " << is_orthographic << ", half " << is_half;
      }
    }
  }
}

TEST_F(SsaoTest, DarkensACreaseAndNotTheWallsFarFromIt) {
  root_ = makeCorner(4.0F);
  for (const bool is_orthographic : {false, true}) {
    for (const bool is_half : {false, true}) {
      const Picture shaded =
          draw(lookDown(5.0, 0.0, is_orthographic), kSide, kSide,
               ssaoChain({.radius = 0.6, .samples = 16, .half_resolution = is_half, .smoothing = true}));
      const float crease = std::min(red(shaded, kSide / 2, kSide / 2), red(shaded, kSide / 2 - 1, kSide / 2));
      EXPECT_LT(crease, 0.75F) << is_orthographic << is_half;
      EXPECT_GT(crease, 0.2F) << is_orthographic << is_half;
      EXPECT_GT(red(shaded, 3 * kSide / 4, kSide / 2), 0.999F) << is_orthographic << is_half;
      EXPECT_GT(red(shaded, kSide / 4, kSide / 2), 0.999F) << is_orthographic << is_half;
    }
  }
}

TEST_F(SsaoTest, IsTheSameAtEveryScale) {
  root_ = makeCorner(4.0F);
  const Picture metres = draw(lookDown(5.0, 20.0, false), kSide, kSide, ssaoChain({.radius = 0.6, .smoothing = true}));
  for (const double scale : {1e-2, 1e3}) {
    const osg::ref_ptr<osg::Group> unit = makeCorner(static_cast<float>(4.0 * scale));
    root_ = unit;
    const Picture scaled =
        draw(lookDown(5.0 * scale, 20.0, false), kSide, kSide, ssaoChain({.radius = 0.6 * scale, .smoothing = true}));
    EXPECT_LT(rmse(metres, scaled), 2e-3) << scale;
  }
}

TEST_F(SsaoTest, GoesWithRadiusAndIntensity) {
  root_ = makeCorner(4.0F);
  const auto brightness = [&](const SsaoSettings& settings) {
    const Picture picture = draw(lookDown(5.0, 0.0, false), kSide, kSide, ssaoChain(settings));
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      sum += static_cast<double>(picture.rgba[i]);
    }
    return sum;
  };
  const double usual = brightness({.radius = 0.5});
  EXPECT_LT(brightness({.radius = 1.0}), usual);
  EXPECT_LT(brightness({.radius = 0.5, .intensity = 2.0}), usual);
  EXPECT_GT(brightness({.radius = 0.5, .intensity = 0.0}), usual);
}

TEST_F(SsaoTest, ConvergesWithSamples) {
  root_ = makeCorner(4.0F);
  const CameraView view = lookDown(5.0, 30.0, false);
  const auto picture = [&](std::int64_t samples, bool smoothing) {
    return draw(view, kSide, kSide, ssaoChain({.radius = 0.8, .samples = samples, .smoothing = smoothing}));
  };
  const Picture reference = picture(1024, false);
  EXPECT_LT(rmse(picture(64, false), reference), rmse(picture(8, false), reference));
  EXPECT_LT(rmse(picture(8, true), reference), rmse(picture(8, false), reference));
  EXPECT_LT(rmse(picture(16, true), reference), 0.015);
}

TEST_F(SsaoTest, HasTheTargetItNeeds) {
  root_ = makeCorner(4.0F);
  (void)draw(lookDown(5.0, 0.0, false), 33, 17, ssaoChain({.half_resolution = true}));
  EXPECT_EQ(renderer_->lastFrame().passes, (std::vector<std::string>{"scene", "ssao", "ssao_apply"}));
}

}  // namespace
}  // namespace stillframe::scenegraph
