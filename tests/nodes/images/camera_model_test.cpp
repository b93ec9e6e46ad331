#include "nodes/images/camera_model.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/nodes/images/image_builder.h"

namespace stillframe::test {
namespace {

using nodes::CameraModel;
using nodes::PixelGrid;
using scenegraph::CameraInfo;

CameraInfo lens(const std::string& model, std::vector<double> d, double focal = 525.0) {
  CameraInfo info = cameraInfo("f", 640, 480, focal);
  info.distortion_model = model;
  info.distortion = std::move(d);
  return info;
}

std::string codeOf(const CameraInfo& info, std::uint32_t width = 640, std::uint32_t height = 480,
                   PixelGrid grid = PixelGrid::Raw) {
  const auto model = CameraModel::make(info, width, height, grid);
  return model ? "Ok" : model.error().code;
}

TEST(CameraModel, PutsFloatPointsWithinAMillionthOfTheDoubleReference) {
  const CameraInfo info = cameraInfo("f", 640, 480, 525.3);
  const auto model = CameraModel::make(info, 640, 480, PixelGrid::Raw);
  ASSERT_TRUE(model);
  const auto rays = nodes::makeRays(*model, 640, 480);
  double worst = 0.0;
  for (std::uint32_t v = 0; v < 480; v += 7) {
    for (std::uint32_t u = 0; u < 640; u += 3) {
      const double depth = 0.001 * (300 + 13 * u + v);
      const auto depth_float = static_cast<float>(depth);
      const double x = (u - info.k[2]) * depth / info.k[0];
      const double y = (v - info.k[5]) * depth / info.k[4];
      const float* ray = &rays.xyz[3 * (std::size_t{640} * v + u)];
      // What the vertex shader computes, in its precision.
      const double dx = static_cast<double>(ray[0] * depth_float) - x;
      const double dy = static_cast<double>(ray[1] * depth_float) - y;
      const double dz = static_cast<double>(ray[2] * depth_float) - depth;
      worst = std::max(worst, std::sqrt(dx * dx + dy * dy + dz * dz) / std::sqrt(x * x + y * y + depth * depth));
    }
  }
  RecordProperty("relative_1e12", static_cast<int>(worst * 1e12));
  EXPECT_LT(worst, 1e-6);
  EXPECT_GT(worst, 1e-9) << "floats were compared";
  EXPECT_EQ(rays.largest_residual_px, 0.0);
}

TEST(CameraModel, InvertsEveryLensToABillionthOfAPixel) {
  const std::vector<CameraInfo> lenses = {
      lens("plumb_bob", {-0.28, 0.07, 0.0003, -0.0002, 0.0}), lens("plumb_bob", {0.12, -0.25, 0.001, 0.002, 0.1}),
      lens("rational_polynomial", {0.5, -2.6, 0.0005, -0.0003, 1.4, 0.4, -2.4, 1.4}),
      lens("rational_polynomial", {0.5, -2.6, 0.0005, -0.0003, 1.4, 0.4, -2.4, 1.4, 0.001, 0, -0.001, 0}),
      lens("equidistant", {-0.01, 0.03, -0.02, 0.005}, 300.0)};
  for (const CameraInfo& info : lenses) {
    SCOPED_TRACE(info.distortion_model + " " + testing::PrintToString(info.distortion));
    const auto model = CameraModel::make(info, 640, 480, PixelGrid::Raw);
    ASSERT_TRUE(model) << model.error().message;
    const auto rays = nodes::makeRays(*model, 640, 480);
    EXPECT_EQ(rays.without_ray, 0U);
    EXPECT_LT(rays.largest_residual_px, 1e-9);
    // And the other way about: an ideal point comes back from where the lens puts it.
    const CameraModel::Point ideal{0.31, -0.17};
    const auto seen = model->distorted(ideal);
    const auto back = model->ray(seen.x * info.k[0] + info.k[2], seen.y * info.k[4] + info.k[5]);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->at.x, ideal.x, 1e-11);
    EXPECT_NEAR(back->at.y, ideal.y, 1e-11);
    EXPECT_GT(std::abs(seen.x - ideal.x), 1e-4) << "the lens bends";
  }
}

TEST(CameraModel, HasNoRayBeyondTheFoldOfTheLens) {
  // With k1 = -0.4 the picture of a plane ends at r = 0.61 on z = 1: the corners see nothing.
  const auto model = CameraModel::make(lens("plumb_bob", {-0.4, 0, 0, 0, 0}, 400.0), 640, 480, PixelGrid::Raw);
  ASSERT_TRUE(model);
  EXPECT_FALSE(model->ray(0, 0));
  EXPECT_TRUE(model->ray(320, 100));
  const auto rays = nodes::makeRays(*model, 640, 480);
  EXPECT_GT(rays.without_ray, 1000U);
  EXPECT_LT(rays.without_ray, 640U * 480U / 2);
  EXPECT_EQ(rays.xyz[2], 0.0F);
  EXPECT_LT(rays.largest_residual_px, 1e-6);
}

TEST(CameraModel, RespectsBinningAndRegionOfInterest) {
  CameraInfo info = cameraInfo("f", 640, 480, 500.0);
  info.binning_x = info.binning_y = 2;
  info.roi_x_offset = 100;
  info.roi_y_offset = 50;
  info.roi_width = 200;
  info.roi_height = 100;
  EXPECT_EQ(codeOf(info), "CameraInfoMismatch");
  const auto model = CameraModel::make(info, 100, 50, PixelGrid::Raw);
  ASSERT_TRUE(model) << model.error().message;
  const auto ray = model->ray(10, 20);
  ASSERT_TRUE(ray);
  EXPECT_NEAR(ray->at.x, (120 - 319.5) / 500.0, 1e-12);
  EXPECT_NEAR(ray->at.y, (90 - 239.5) / 500.0, 1e-12);
}

TEST(CameraModel, TakesTheProjectionOfRectifiedImages) {
  CameraInfo info = lens("plumb_bob", {-0.28, 0.07, 0, 0, 0});
  info.p = {450, 0, 310, 0, 0, 460, 230, 0, 0, 0, 1, 0};
  const auto model = CameraModel::make(info, 640, 480, PixelGrid::Rectified);
  ASSERT_TRUE(model);
  EXPECT_FALSE(model->hasDistortion());
  EXPECT_NEAR(model->ray(400, 300)->at.x, 90.0 / 450.0, 1e-12);
  EXPECT_NEAR(model->ray(400, 300)->at.y, 70.0 / 460.0, 1e-12);
}

TEST(CameraModel, RefusesWhatIsNoCamera) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CameraInfo info = cameraInfo("f", 640, 480);
  EXPECT_EQ(codeOf(info), "Ok");
  EXPECT_EQ(codeOf(info, 320, 240), "CameraInfoMismatch");
  info.k[0] = 0.0;
  EXPECT_EQ(codeOf(info), "BadCameraInfo");
  info.k[0] = kNan;
  EXPECT_EQ(codeOf(info), "BadCameraInfo");
  EXPECT_EQ(codeOf(lens("plumb_bob", {0.1, kNan, 0, 0, 0})), "BadCameraInfo");
  EXPECT_EQ(codeOf(lens("plumb_bob", {0.1})), "UnknownDistortion");
  EXPECT_EQ(codeOf(lens("kaleidoscope", {0.1, 0, 0, 0})), "UnknownDistortion");
  EXPECT_EQ(codeOf(lens("kaleidoscope", {0.1, 0, 0, 0}), 640, 480, PixelGrid::Undone), "Ok");
  EXPECT_EQ(codeOf(lens("kaleidoscope", {0, 0, 0, 0})), "Ok");
  for (const double wild : {1e300, -1e300, 1e20, -1e5}) {
    const auto model = CameraModel::make(lens("plumb_bob", {wild, wild, wild, wild, wild}), 640, 480, PixelGrid::Raw);
    ASSERT_TRUE(model);
    for (const auto& [u, v] : {std::pair(0.0, 0.0), std::pair(500.0, 3.0)}) {
      if (const auto ray = model->ray(u, v)) {
        EXPECT_TRUE(std::isfinite(ray->at.x) && std::isfinite(ray->residual_px));
      }
    }
  }
}

}  // namespace
}  // namespace stillframe::test
