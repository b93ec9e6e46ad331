// Every way to draw points shows what GL_POINTS shows: at the origin and at an ECEF offset, from the near plane to the
// horizon, at every size and in every colour mode.
#include <gtest/gtest.h>

#include <random>

#include "scenegraph/objects/laser_scan.h"
#include "scenegraph/pipeline/point_stage.h"
#include "tests/nodes/images/image_builder.h"
#include "tests/nodes/scene_picture.h"

namespace stillframe::test {
namespace {

using scenegraph::FieldType;
using scenegraph::ObjectType;

constexpr int kWidthPx = 320;
constexpr int kHeightPx = 240;
/// Share of the pixels: where two depths tie, and the rim of a disc.
constexpr double kTolerance = 0.001;

/// A field of points 0.1 m to 10 km ahead of x, evenly over the logarithm of the distance, some behind.
scenegraph::PointCloud nearToHorizon(std::size_t count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  CloudBuilder builder("lidar");
  builder.xyz().field("intensity", FieldType::Float32).field("rgb", FieldType::Uint32);
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = std::pow(10.0, 5.0 * unit(random) - 1.0) * (i % 10 == 0 ? -1.0 : 1.0);
    const double across = (unit(random) - 0.5) * 2.0 * distance;
    const double up = (unit(random) - 0.5) * 1.5 * distance;
    builder.point({distance, across, up, unit(random) * 100.0, std::floor(unit(random) * 0xffffff)});
  }
  return builder.build();
}

struct Difference {
  double pixels = 0.0;  // share of the pixels that either shows points in, that are more than a step apart
  std::size_t drawn = 0;
};

Difference compare(const scenegraph::Picture& a, const scenegraph::Picture& b) {
  const auto bytes_a = scenegraph::toBytes(a);
  const auto bytes_b = scenegraph::toBytes(b);
  std::size_t apart = 0;
  Difference result;
  for (std::size_t i = 0; i < a.depth_m.size(); ++i) {
    const bool is_drawn = std::isfinite(a.depth_m[i]) || std::isfinite(b.depth_m[i]);
    result.drawn += is_drawn ? 1 : 0;
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      most = std::max(most, std::abs(bytes_a.rgb[3 * i + c] - bytes_b.rgb[3 * i + c]));
    }
    const double depths = std::isfinite(a.depth_m[i]) && std::isfinite(b.depth_m[i])
                              ? std::abs(a.depth_m[i] - b.depth_m[i]) / a.depth_m[i]
                              : (is_drawn ? 1.0 : 0.0);
    apart += most > 1 || depths > 1e-5 ? 1 : 0;
  }
  result.pixels = static_cast<double>(apart) / static_cast<double>(std::max<std::size_t>(result.drawn, 1));
  return result;
}

struct RasteriserCase {
  const char* name;
  scenegraph::SettingTexts settings;
};

class PointRasterisers : public ScenePictureTest, public testing::WithParamInterface<RasteriserCase> {
 public:
  static scenegraph::CameraView alongX(const glm::dvec3& eye) {
    return {.eye_from_fixed = scenegraph::lookAt(eye, eye + glm::dvec3(1, 0, 0), {0, 0, 1})};
  }

 protected:
  scenegraph::Picture picture(osg::Group& root, const scenegraph::CameraView& view, scenegraph::PointWay way) {
    auto drawn = renderer_->render(root, view,
                                   {.width = kWidthPx, .height = kHeightPx, .background = {0, 0, 0, 1}, .points = way});
    EXPECT_TRUE(drawn) << drawn.error().message;
    return drawn ? std::move(*drawn) : scenegraph::Picture{};
  }

  /// Of the layers of scene_, which have `points` points.
  void expectTheSame(const scenegraph::CameraView& view, double tolerance, std::size_t points) {
    scene_->update(tf::TimePoint{1_s});
    const scenegraph::Picture by_gl = picture(scene_->root(), view, scenegraph::PointWay::OpenGl);
    EXPECT_FALSE(renderer_->lastFrame().points);
    for (const auto& [name, way] :
         {std::pair("cpu", scenegraph::PointWay::Cpu), std::pair("compute", scenegraph::PointWay::Compute)}) {
      SCOPED_TRACE(name);
      const scenegraph::Picture drawn = picture(scene_->root(), view, way);
      ASSERT_TRUE(renderer_->lastFrame().points);
      EXPECT_EQ(renderer_->lastFrame().points->by, name);
      EXPECT_EQ(renderer_->lastFrame().points->points, points);
      const Difference difference = compare(by_gl, drawn);
      RecordProperty(std::string("share_of_pixels_apart_by_") + name, std::to_string(difference.pixels));
      std::cout << name << ": " << difference.pixels << " of " << difference.drawn << " pixels apart\n";
      EXPECT_GT(difference.drawn, 4000U);
      EXPECT_LE(difference.pixels, tolerance);
    }
  }

  void expectTheSame(const tf::RigidTransform& map_from_lidar, const scenegraph::CameraView& view, double tolerance) {
    open(DatasetBuilder()
             .topic("/tf", ObjectType::FrameTransforms)
             .transform(0, "map", "lidar", map_from_lidar)
             .topic("/points", ObjectType::PointCloud)
             .at(1_s, nearToHorizon(40'000))
             .build(),
         "map");
    add("/points", GetParam().settings);
    expectTheSame(view, tolerance, 40'000);
  }
};

TEST_P(PointRasterisers, AgreeAtTheOrigin) { expectTheSame({}, alongX({0, 0, 0}), kTolerance); }

TEST_P(PointRasterisers, AgreeAtAnEcefOffset) {
  const glm::dvec3 munich{4'177'000.25, 855'000.5, 4'728'000.125};
  expectTheSame({.translation = munich}, alongX(munich), kTolerance);
}

TEST_P(PointRasterisers, AgreeInParallelProjection) {
  scenegraph::CameraView view = alongX({-20, 0, 0});
  view.is_orthographic = true;
  view.vertical_extent_m = 30.0;
  expectTheSame({}, view, kTolerance);
}

INSTANTIATE_TEST_SUITE_P(
    All, PointRasterisers,
    testing::Values(RasteriserCase{"value", {{"color_field", "intensity"}}},
                    RasteriserCase{"rgb", {{"color_field", "rgb"}, {"point_size", "2"}}},
                    RasteriserCase{"axis", {{"color_field", "z"}, {"point_size", "3"}}},
                    RasteriserCase{"flat_discs",
                                   {{"color_field", "flat"}, {"point_size", "7"}, {"round_points", "true"}}},
                    RasteriserCase{"metres", {{"color_field", "x"}, {"point_size", "0.2"}, {"size_unit", "m"}}},
                    RasteriserCase{"fractional", {{"color_field", "intensity"}, {"point_size", "2.7"}}}),
    [](const auto& tested) { return tested.param.name; });

/// A wall with a hole, on a slope, seen by a depth camera that looks along the map's x.
scenegraph::Image slope(std::uint32_t width, std::uint32_t height) {
  std::vector<float> metres;
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      const bool is_hole = (row / 16 + column / 16) % 9 == 0;
      metres.push_back(is_hole ? std::numeric_limits<float>::quiet_NaN()
                               : 0.5F + 0.02F * static_cast<float>(column) + 0.001F * static_cast<float>(row * column));
    }
  }
  return makeImage("optical", "32FC1", width, metres);
}

class OtherPoints : public PointRasterisers {};

TEST_P(OtherPoints, DepthImagesAgree) {
  const glm::dvec3 munich{4'177'000.25, 855'000.5, 4'728'000.125};
  const tf::RigidTransform map_from_optical{.rotation = glm::dquat(0.5, -0.5, 0.5, -0.5), .translation = munich};
  const scenegraph::Image image = slope(320, 240);
  std::vector<std::uint8_t> colors(std::size_t{3} * 320 * 240);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    colors[i] = static_cast<std::uint8_t>(i * 7);
  }
  open(DatasetBuilder()
           .topic("/tf", ObjectType::FrameTransforms)
           .transform(0, "map", "optical", map_from_optical)
           .topic("/depth/camera_info", ObjectType::CameraInfo)
           .at(1_s, cameraInfo("optical", 320, 240))
           .topic("/depth/image_raw", ObjectType::Image)
           .at(1_s, image)
           .topic("/color/image_raw", ObjectType::Image)
           .at(1_s, makeImage("optical", "rgb8", 320, colors, 3))
           .build(),
       "map");
  add("/depth/image_raw", GetParam().settings);
  expectTheSame(alongX(munich + glm::dvec3(-0.2, 0.1, 0.05)), kTolerance, 320 * 240 + 1);
}

INSTANTIATE_TEST_SUITE_P(
    DepthImages, OtherPoints,
    testing::Values(RasteriserCase{"depth", {{"color_mode", "depth"}}},
                    RasteriserCase{"rgb", {{"color_mode", "rgb"}, {"point_size", "3"}}},
                    RasteriserCase{"near", {{"color_mode", "flat"}, {"max_depth_m", "20"}, {"point_size", "2"}}}),
    [](const auto& tested) { return tested.param.name; });

class ScanRasterisers : public PointRasterisers {};

TEST_P(ScanRasterisers, ScansAgree) {
  scenegraph::LaserScan scan;
  scan.frame_id = "lidar";
  scan.angle_min_rad = -1.2;
  scan.angle_increment_rad = 2.4 / 2000;
  scan.range_max_m = 100.0;
  for (int i = 0; i < 2000; ++i) {
    scan.ranges_m.push_back(3.0 + std::sin(0.02 * i) + (i % 7 == 0 ? 20.0 : 0.0));
    scan.intensities.push_back(i % 100);
  }
  open(DatasetBuilder()
           .topic("/tf", ObjectType::FrameTransforms)
           .transform(0, "map", "lidar", {})
           .topic("/scan", ObjectType::LaserScan)
           .at(1_s, scan)
           .build(),
       "map");
  add("/scan", GetParam().settings);
  expectTheSame({.eye_from_fixed = scenegraph::lookAt({-2, 0, 3}, {5, 0, 0}, {0, 0, 1})}, kTolerance, 2000);
}

INSTANTIATE_TEST_SUITE_P(All, ScanRasterisers,
                         testing::Values(RasteriserCase{"large", {{"point_size", "9"}, {"color_field", "intensity"}}}),
                         [](const auto& tested) { return tested.param.name; });

class PointStageSteps : public ScenePictureTest {
 protected:
  void SetUp() override {
    ScenePictureTest::SetUp();
    open(DatasetBuilder()
             .topic("/tf", ObjectType::FrameTransforms)
             .transform(0, "map", "lidar", {})
             .topic("/points", ObjectType::PointCloud)
             .at(1_s, nearToHorizon(40'000))
             .at(2_s, nearToHorizon(30'000))
             .build(),
         "map");
    layer_ = &add("/points", {{"color_field", "intensity"}});
    scene_->update(tf::TimePoint{1_s});
  }
  scenegraph::PointProgress step(scenegraph::PointStage& stage, double budget_ms, double eye_x = 0.0) {
    const auto view = PointRasterisers::alongX({eye_x, 0, 0});
    const glm::dmat4 clip_from_eye = scenegraph::projection(view, 1.0);
    return stage.draw(scenegraph::collectPoints(scene_->root(), osg::Matrixd(&view.eye_from_fixed[0][0]),
                                                osg::Matrixd(&clip_from_eye[0][0]), 64),
                      64, 64, {.budget_ms = budget_ms});
  }
  static std::vector<unsigned char> colors(scenegraph::PointStage& stage) {
    const auto* const texture = dynamic_cast<osg::Texture*>(
        stage.picture().getChild(0)->getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
    const osg::Image* const image = texture->getImage(0);
    return {image->data(), image->data() + image->getTotalSizeInBytes()};
  }
  scenegraph::Layer* layer_ = nullptr;
};

TEST_F(PointStageSteps, GoOnWhereTimeRanOutUntilThePictureIsWhole) {
  scenegraph::PointStage whole(2);
  EXPECT_EQ(step(whole, std::numeric_limits<double>::infinity()).share, 1.0);
  scenegraph::PointStage stepwise(2);
  double share = 0.0;
  int steps = 0;
  while (share < 1.0) {
    const auto progress = step(stepwise, 0.05);
    EXPECT_EQ(progress.points, 40'000U);
    ASSERT_GT(progress.share, share) << "each step draws something";
    share = progress.share;
    ++steps;
  }
  EXPECT_GT(steps, 3);
  EXPECT_EQ(colors(stepwise), colors(whole));
}

TEST_F(PointStageSteps, ComputeDrawsTheFirstPictureOfAContext) {
  const auto renderer = scenegraph::OffscreenRenderer::create();
  ASSERT_TRUE(renderer);
  const auto drawn = (*renderer)->render(scene_->root(), PointRasterisers::alongX({0, 0, 0}),
                                         {.width = 64, .height = 64, .points = scenegraph::PointWay::Compute});
  ASSERT_TRUE(drawn) << drawn.error().message;
  ASSERT_TRUE((*renderer)->lastFrame().points);
  EXPECT_EQ((*renderer)->lastFrame().points->by, "compute");
  EXPECT_TRUE(std::ranges::any_of(drawn->depth_m, [](float depth) { return std::isfinite(depth); }));
}

/// Draws nothing, at once, and notes what it was asked for.
class NotingDrawer final : public scenegraph::PointDrawer {
 public:
  explicit NotingDrawer(std::vector<scenegraph::PassRange>& asked) : asked_(asked) {}
  std::size_t begin(const scenegraph::PointCollection& /*points*/, int /*width*/, int /*height*/) override { return 0; }
  void draw(const scenegraph::PassRange& passes) override { asked_.push_back(passes); }
  std::size_t resolve(const scenegraph::PointShading& /*shading*/, const glm::vec4& /*background*/) override {
    return 0;
  }
  [[nodiscard]] bool needsContext() const noexcept override { return false; }
  [[nodiscard]] const char* name() const noexcept override { return "noting"; }
  [[nodiscard]] osg::Texture2D& colorTexture() noexcept override { return *color_; }
  [[nodiscard]] osg::Texture2D& depthTexture() noexcept override { return *depth_; }

 private:
  std::vector<scenegraph::PassRange>& asked_;
  osg::ref_ptr<osg::Texture2D> color_ = scenegraph::makePointTexture(GL_RGBA16F_ARB);
  osg::ref_ptr<osg::Texture2D> depth_ = scenegraph::makePointTexture(GL_R32F);
};

TEST_F(PointStageSteps, LookAtTheClockAgainWhereTimeDoesNotSufficeForAll) {
  std::vector<scenegraph::PassRange> asked;
  scenegraph::PointStage stage(std::make_unique<NotingDrawer>(asked));
  (void)step(stage, 1.0);  // half of what it is guessed to suffice for, then as much more as that turned out to take
  ASSERT_GT(asked.size(), 1U);
  EXPECT_LE(asked.front().end, 0.6 * scenegraph::kPassesOfBothLaps);
  for (std::size_t i = 1; i < asked.size(); ++i) {
    EXPECT_EQ(asked[i].first, asked[i - 1].end);
    EXPECT_LT(asked[i].first, asked[i].end);
  }
  asked.clear();
  (void)step(stage, std::numeric_limits<double>::infinity(), 1.0);
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked.front().end, scenegraph::kPassesOfBothLaps);
}

TEST_F(PointStageSteps, ComeToAnEndWithoutAnyTime) {
  scenegraph::PointStage stage(2);
  int steps = 0;
  while (step(stage, 0.0).share < 1.0) {
    ASSERT_LT(++steps, 80);
  }
  EXPECT_GT(steps, 60);
}

TEST_F(PointStageSteps, DrawNoPointAgainForAnotherColour) {
  scenegraph::PointStage stage(2);
  EXPECT_GT(step(stage, 1e9).raster_ms, 0.0);
  const auto before = colors(stage);
  EXPECT_EQ(step(stage, 1e9).raster_ms, 0.0);
  EXPECT_EQ(colors(stage), before);
  ASSERT_TRUE(layer_->applySettings({{"colormap", "turbo"}}));
  scene_->update(tf::TimePoint{1_s});
  EXPECT_EQ(step(stage, 1e9).raster_ms, 0.0);
  EXPECT_NE(colors(stage), before);
}

TEST_F(PointStageSteps, UploadNothingWhereNothingChanged) {
  scenegraph::PointStage stage(2);
  constexpr std::size_t kPicture = 64 * 64 * 12;
  EXPECT_EQ(step(stage, 1e9).upload_bytes, kPicture);
  for (int frame = 0; frame < 3; ++frame) {
    scene_->update(tf::TimePoint{1_s});
    const auto progress = step(stage, 1e9);
    EXPECT_EQ(progress.upload_bytes, 0U);
    EXPECT_EQ(progress.resolve_ms, 0.0);
    EXPECT_EQ(progress.share, 1.0);
  }
  ASSERT_TRUE(layer_->applySettings({{"color_field", "z"}}));
  scene_->update(tf::TimePoint{1_s});
  const auto recoloured = step(stage, 1e9);
  EXPECT_EQ(recoloured.raster_ms, 0.0);
  EXPECT_EQ(recoloured.upload_bytes, kPicture);
}

TEST_F(PointStageSteps, StartAnewWhenTheCameraMovesOrTheCloudIsAnother) {
  scenegraph::PointStage stage(2);
  step(stage, 1e9);
  EXPECT_GT(step(stage, 1e9, 0.5).raster_ms, 0.0);
  scene_->update(tf::TimePoint{2_s});
  const auto progress = step(stage, 1e9, 0.5);
  EXPECT_GT(progress.raster_ms, 0.0);
  EXPECT_EQ(progress.points, 30'000U);
  layer_->setVisible(false);
  scene_->update(tf::TimePoint{2_s});
  EXPECT_EQ(step(stage, 1e9).points, 0U);
  EXPECT_EQ(stage.picture().getNodeMask(), 0U) << "nothing to draw, no step";
}

}  // namespace
}  // namespace stillframe::test
