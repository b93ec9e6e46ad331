#include "scenegraph/raster/point_raster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>
#include <set>

#include "scenegraph/raster/points_in_view.h"
#include "tests/scenegraph/raster/point_clusters.h"

namespace stillframe::scenegraph {
namespace {

using test::clusters;
using test::kInfinity;
using test::kNan;
using test::perspective;

std::size_t countInView(const PointBatch& batch) {
  PointsInView seen;
  seen.add(batch, 160, 100);
  return seen.count();
}

std::vector<float> randomCloud(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> across(-3.0F, 3.0F);
  std::vector<float> cloud;
  for (std::size_t i = 0; i < count; ++i) {
    cloud.insert(cloud.end(), {across(random), across(random), across(random) - 3.0F});
  }
  return cloud;
}

std::vector<std::uint64_t> drawn(std::span<const PointBatch> batches, int width_px, int height_px,
                                 unsigned threads = 2) {
  PointRaster raster(threads);
  raster.begin(width_px, height_px);
  raster.draw(batches);
  return {raster.keys().begin(), raster.keys().end()};
}

/// Every point that may be seen at a pixel, by the definition, in double.
struct Model {
  int width_px;
  int height_px;
  std::vector<std::set<std::uint32_t>> candidates;  // nearest within 1e-6 of the depth, borders within 1/256 of a pixel

  Model(const PointBatch& batch, int width, int height) : width_px(width), height_px(height) {
    std::vector<double> sure(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0);
    candidates.resize(sure.size());
    for (const bool collect : {false, true}) {
      for (std::uint32_t i = 0; i < batch.count(); ++i) {
        const glm::dvec4 clip = batch.clip_from_points * glm::dvec4(batch.positions[3 * i], batch.positions[3 * i + 1],
                                                                    batch.positions[3 * i + 2], 1.0);
        const double depth = clip.z / clip.w;
        if (!(clip.w > 0.0) || !(depth > 0.0) || depth > 1.0 + 1e-6 || std::abs(clip.x) > clip.w * (1.0 + 1e-6) ||
            std::abs(clip.y) > clip.w * (1.0 + 1e-6)) {
          continue;
        }
        const double x = (clip.x / clip.w * 0.5 + 0.5) * width;
        const double y = (clip.y / clip.w * 0.5 + 0.5) * height;
        visit(x, y, batch, [&](std::size_t pixel, bool is_sure) {
          if (!collect) {
            sure[pixel] = is_sure ? std::max(sure[pixel], depth) : sure[pixel];
          } else if (depth >= sure[pixel] * (1.0 - 1e-6)) {
            candidates[pixel].insert(i);
          }
        });
      }
    }
    for (std::size_t pixel = 0; pixel < sure.size(); ++pixel) {
      if (sure[pixel] == 0.0) {
        candidates[pixel].insert(~0U);  // may be empty
      }
    }
  }

  template <typename Visit>
  void visit(double x, double y, const PointBatch& batch, const Visit& visit_pixel) const {
    const double size = std::max(1.0, batch.is_round ? static_cast<double>(batch.size) : std::nearbyint(batch.size));
    const double slack = 1.0 / 200.0;
    // A square is moved on to the grid of pixels, an odd one to a pixel's centre, an even one to a corner.
    const auto moved = [&](double at) {
      return std::lround(size) % 2 == 0 ? std::floor(at + 0.5) : std::floor(at) + 0.5;
    };
    const auto covers = [&](double at, int pixel) { return std::abs(pixel + 0.5 - moved(at)) < 0.5 * size; };
    for (int row = 0; row < height_px; ++row) {
      for (int column = 0; column < width_px; ++column) {
        const auto pixel = static_cast<std::size_t>(row * width_px + column);
        if (batch.is_round) {
          const double reach = std::hypot(column + 0.5 - x, row + 0.5 - y);
          if (reach <= 0.5 * size + slack) {
            visit_pixel(pixel, reach < 0.5 * size - slack);
          }
          continue;
        }
        const bool low = covers(x - slack, column) || covers(x + slack, column);
        const bool high = covers(y - slack, row) || covers(y + slack, row);
        if (low && high) {
          visit_pixel(pixel, covers(x - slack, column) && covers(x + slack, column) && covers(y - slack, row) &&
                                 covers(y + slack, row));
        }
      }
    }
  }
};

class PointRasterSizes : public testing::TestWithParam<std::pair<float, bool>> {};

TEST_P(PointRasterSizes, ShowsTheNearestPointOfEachPixel) {
  const std::vector<float> cloud = randomCloud(3000, 7);
  PointBatch batch{.positions = cloud, .clip_from_points = perspective(0.1)};
  batch.size = GetParam().first;
  batch.is_round = GetParam().second;
  const std::vector<std::uint64_t> keys = drawn({&batch, 1}, 41, 29);
  const Model model(batch, 41, 29);
  std::size_t covered = 0;
  for (std::size_t pixel = 0; pixel < keys.size(); ++pixel) {
    const std::uint32_t seen = keys[pixel] == 0 ? ~0U : PointKey::point(keys[pixel]);
    EXPECT_TRUE(model.candidates[pixel].contains(seen)) << "pixel " << pixel << " shows " << seen;
    covered += keys[pixel] != 0 ? 1 : 0;
  }
  EXPECT_GT(covered, 500U);
}

INSTANTIATE_TEST_SUITE_P(All, PointRasterSizes,
                         testing::Values(std::pair{1.0F, false}, std::pair{0.2F, false}, std::pair{2.0F, false},
                                         std::pair{3.0F, true}, std::pair{6.5F, false}, std::pair{7.0F, true}));

TEST(PointRaster, DependsNeitherOnThreadsNorOnPassesNorOnBatches) {
  const std::vector<float> cloud = randomCloud(200'000, 3);
  const PointBatch whole{.positions = cloud, .clip_from_points = perspective(0.1), .size = 2.0F};
  const std::vector<std::uint64_t> reference = drawn({&whole, 1}, 320, 200, 1);
  EXPECT_EQ(drawn({&whole, 1}, 320, 200, 4), reference);

  const std::size_t cut = 3 * 77'777;
  const std::array halves{PointBatch{whole}, PointBatch{whole}};
  std::array<PointBatch, 2> parts = halves;
  parts[0].positions = whole.positions.first(cut);
  parts[1].positions = whole.positions.subspan(cut);
  EXPECT_EQ(drawn(parts, 320, 200), reference);

  PointRaster raster(3);
  raster.begin(320, 200);
  for (std::uint32_t first = 0; first < kPassesOfBothLaps; first += 100) {
    raster.draw({&whole, 1}, {first, std::min(first + 100, kPassesOfBothLaps)});
  }
  EXPECT_TRUE(std::ranges::equal(raster.keys(), reference));
}

TEST(PointRaster, OfEquallyNearPointsTheFirstIsSeen) {
  const std::vector<float> cloud{0.0F, 0.0F, -1.0F, 0.0F, 0.0F, -1.0F};
  const PointBatch batch{.positions = cloud, .clip_from_points = perspective(0.5)};
  const std::vector<std::uint64_t> keys = drawn({&batch, 1}, 1, 1);
  EXPECT_EQ(PointKey::point(keys.front()), 0U);
  EXPECT_EQ(PointKey::depth(keys.front()), 0.5F);
}

TEST(PointRaster, LeavesOutWhatIsOutsideOrNowhere) {
  for (const std::vector<float>& point : std::vector<std::vector<float>>{{0.0F, 0.0F, 1.0F},
                                                                         {0.0F, 0.0F, 0.0F},
                                                                         {0.0F, 0.0F, -0.05F},
                                                                         {2.0F, 0.0F, -1.0F},
                                                                         {0.0F, -1.1F, -1.0F},
                                                                         {kNan, 0.0F, -1.0F},
                                                                         {0.0F, 0.0F, kNan},
                                                                         {kInfinity, 0.0F, -1.0F},
                                                                         {0.0F, 0.0F, -kInfinity}}) {
    const PointBatch batch{.positions = point, .clip_from_points = perspective(0.1), .size = 1.0F};
    EXPECT_THAT(drawn({&batch, 1}, 8, 8), testing::Each(0U)) << point[0] << " " << point[1] << " " << point[2];
  }
}

TEST(PointRaster, SurvivesDegenerateMatrices) {
  const std::vector<float> cloud = randomCloud(5000, 1);
  for (const double entry : {0.0, 1e-300, 1e300, static_cast<double>(kNan), static_cast<double>(kInfinity)}) {
    const PointBatch batch{
        .positions = cloud, .clip_from_points = glm::dmat4(entry), .size = kNan, .is_size_in_metres = true};
    EXPECT_EQ(drawn({&batch, 1}, 16, 16).size(), 256U);
  }
}

TEST(PointRaster, LeavesOutGroupsThatAreOutOfThePictureAndNothingElse) {
  std::vector<float> cloud = clusters(60);
  cloud[5] = kNan;
  std::fill_n(cloud.begin() + 3 * 1024, 3 * 1024, kNan);
  const std::vector<PointBox> boxes = boxesOf(cloud);
  ASSERT_EQ(boxes.size(), 60U);
  std::size_t in_view = 0;
  for (const glm::dvec3& eye : {glm::dvec3(0.0), glm::dvec3(0.3, -1.0, 2.0), glm::dvec3(20.0, 5.0, 90.0)}) {
    for (const double turn : {0.0, 1.0, 2.5, 4.0}) {
      PointBatch batch{.positions = cloud,
                       .clip_from_points = perspective(0.1) * glm::rotate(glm::dmat4(1.0), turn, {0.2, 1.0, 0.1}) *
                                           glm::translate(glm::dmat4(1.0), -eye)};
      const std::vector<std::uint64_t> reference = drawn({&batch, 1}, 160, 100);
      EXPECT_EQ(countInView(batch), batch.count());
      batch.boxes = boxes;
      EXPECT_EQ(drawn({&batch, 1}, 160, 100), reference);
      EXPECT_LT(countInView(batch), batch.count()) << "there is a group that is nowhere";
      in_view += countInView(batch);
      PointRaster stepwise(2);
      stepwise.begin(160, 100);
      stepwise.draw({&batch, 1}, {0, 300});
      stepwise.draw({&batch, 1}, {300, 1500});
      stepwise.draw({&batch, 1}, {1500, kPassesOfBothLaps});
      EXPECT_TRUE(std::ranges::equal(stepwise.keys(), reference));
    }
  }
  EXPECT_LT(in_view, 12 * cloud.size() / 3 * 8 / 10);
}

/// Walls of groups of points across the view, one behind another, as a scanner might order them.
std::vector<float> walls(const std::vector<float>& distances) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  constexpr int kAcross = 16;
  std::vector<float> cloud;
  for (const float distance : distances) {
    const float edge = 2.4F * distance / kAcross;
    for (int group = 0; group < kAcross * kAcross; ++group) {
      for (std::uint32_t i = 0; i < kPassesOfSample; ++i) {
        const auto column = static_cast<float>(group % kAcross - kAcross / 2);
        const auto row = static_cast<float>(group / kAcross - kAcross / 2);
        cloud.insert(cloud.end(), {(column + unit(random)) * edge, (row + unit(random)) * edge, -distance});
      }
    }
  }
  return cloud;
}

TEST(PointRaster, LeavesOutSmallGroupsBehindWhatIsSeen) {
  const std::vector<float> cloud = walls({2.0F, 5.0F, 11.0F});
  const std::vector<PointBox> boxes = boxesOf(cloud);
  for (const float size : {1.0F, 3.0F}) {
    PointBatch batch{.positions = cloud, .clip_from_points = perspective(0.1), .size = size};
    const std::vector<std::uint64_t> reference = drawn({&batch, 1}, 128, 128);
    batch.boxes = boxes;
    PointRaster raster(1);
    raster.begin(128, 128);
    EXPECT_LT(raster.draw({&batch, 1}), batch.count() / 2) << "the two walls behind";
    EXPECT_TRUE(std::ranges::equal(raster.keys(), reference));
    batch.positions = std::span(cloud).first(cloud.size() / 3);
    batch.boxes = std::span(boxes).first(boxes.size() / 3);
    EXPECT_GT(raster.draw({&batch, 1}), batch.count() / 2) << "a wall does not hide itself";
  }
}

TEST(PointRaster, SpendsNoMorePointsOnAFarGroupThanItsPixelsAreWorthUntilTheLastLap) {
  const std::vector<float> cloud = walls({1.0F});
  const std::vector<PointBox> boxes = boxesOf(cloud);
  const auto covered = [](const PointRaster& raster) {
    return std::ranges::count_if(raster.keys(), [](std::uint64_t key) { return key != 0; });
  };
  for (const double away_m : {8.0, 40.0, 200.0}) {
    const PointBatch batch{
        .positions = cloud,
        .clip_from_points = perspective(0.1) * glm::translate(glm::dmat4(1.0), glm::dvec3(0.3, 0.0, -away_m)),
        .boxes = boxes};
    PointRaster whole(2);
    whole.begin(160, 100);
    whole.draw({&batch, 1});
    PointRaster stepwise(2);
    stepwise.begin(160, 100);
    EXPECT_LT(stepwise.draw({&batch, 1}, {0, kPassesOfSample}), batch.count() / 20) << away_m;
    EXPECT_GE(covered(stepwise), covered(whole) * 95 / 100) << away_m;
    stepwise.draw({&batch, 1}, {kPassesOfSample, kPassesOfBothLaps});
    EXPECT_TRUE(std::ranges::equal(stepwise.keys(), whole.keys())) << away_m;
    PointsInView in_view;
    in_view.add(batch, 160, 100);
    EXPECT_EQ(in_view.count(), batch.count());
    EXPECT_LT(in_view.drawnBefore(kPassesOfSample), static_cast<double>(batch.count()) / 20.0);
    EXPECT_EQ(in_view.drawnBefore(kPassesOfBothLaps), static_cast<double>(batch.count()));
  }
}

TEST(PointRaster, DrawsPixelsOfADepthImageWhereTheirRaysLead) {
  const std::vector<float> rays{0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F,
                                0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F};
  const std::vector<float> depths{8.0F, 4.0F, 1.0F, -3e38F, 40.0F};
  PointBatch batch{.positions = rays,
                   .clip_from_points = perspective(0.5) * glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 1.0, -2.0)),
                   .depths = depths,
                   .unit = 0.5F,
                   .farthest = 10.0F};
  const std::vector<std::uint64_t> keys = drawn({&batch, 1}, 1, 1);
  EXPECT_EQ(PointKey::point(keys.front()), 1U) << "the third has no ray, the fourth no depth, the fifth is too far";
  EXPECT_EQ(PointKey::depth(keys.front()), 0.125F);
  batch.farthest = 3.0F;
  EXPECT_THAT(drawn({&batch, 1}, 1, 1), testing::Each(0U));
  batch.depths = batch.depths.first(1);
  batch.farthest = 10.0F;
  EXPECT_EQ(PointKey::depth(drawn({&batch, 1}, 1, 1).front()), 0.0625F) << "what has no depth is nowhere";
}

TEST(PointRaster, SizesInMetresShrinkWithDistance) {
  for (const float distance : {1.0F, 2.0F, 4.0F}) {
    const std::vector<float> point{0.0F, 0.0F, -distance};
    const PointBatch batch{
        .positions = point, .clip_from_points = perspective(0.1), .size = 32.0F, .is_size_in_metres = true};
    const std::vector<std::uint64_t> keys = drawn({&batch, 1}, 64, 64);
    const auto covered = std::ranges::count_if(keys, [](std::uint64_t key) { return key != 0; });
    EXPECT_EQ(covered, std::lround(32.0F / distance * 32.0F / distance)) << distance;
  }
}

TEST(PointRaster, APictureWithoutPixelsOrPointsIsEmpty) {
  PointRaster raster;
  raster.begin(0, 100);
  raster.draw({});
  EXPECT_TRUE(raster.keys().empty());
  raster.begin(-5, 3);
  EXPECT_TRUE(raster.keys().empty());
  raster.begin(2, 2);
  raster.draw({});
  const PointBatch none;
  raster.draw({&none, 1});
  EXPECT_THAT(raster.keys(), testing::Each(0U));
}

}  // namespace
}  // namespace stillframe::scenegraph
