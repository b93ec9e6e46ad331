// What the id pass picks, held against every point projected in double: points of one pixel, by both rasterisers, near
// the origin and at an ECEF offset, with perspective and without.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <tuple>

#include "tests/nodes/pick/pick_picture.h"

namespace stillframe::test {
namespace {

using scenegraph::FieldType;
using scenegraph::ObjectType;
using scenegraph::PointWay;

constexpr int kWidthPx = 320;
constexpr int kHeightPx = 240;
constexpr int kReachPx = 8;

struct PickCase {
  const char* name;
  PointWay way;
  bool is_orthographic;
  double offset_m;
};

/// A point as the picture must show it.
struct Projected {
  std::size_t index = 0;
  int x = 0;
  int y = 0;
  double depth_m = 0.0;
  bool is_on_border = false;  // of its pixel: rounding decides
};

class PickedPoints : public PickTest, public testing::WithParamInterface<PickCase> {
 protected:
  void SetUp() override {
    PickTest::SetUp();
    Random random(11);
    map_from_lidar_ = turn(0.7, GetParam().offset_m, -0.6 * GetParam().offset_m, 0.3 * GetParam().offset_m);
    CloudBuilder builder("lidar");
    builder.field("x", FieldType::Float64)
        .field("y", FieldType::Float64)
        .field("z", FieldType::Float64)
        .field("intensity", FieldType::Float32)
        .field("ring", FieldType::Uint16);
    for (std::size_t i = 0; i < kPoints; ++i) {
      // Exact in float, so that the picture shows what the message says.
      const auto coordinate = [&](double half) {
        return static_cast<double>(static_cast<float>(random.number(-half, half)));
      };
      points_.push_back({coordinate(12.0), coordinate(9.0), coordinate(4.0)});
      builder.point({points_[i].x, points_[i].y, points_[i].z, static_cast<double>(i), static_cast<double>(i % 64)});
    }
    open(DatasetBuilder()
             .topic("/tf", ObjectType::FrameTransforms)
             .transform(0, "map", "lidar", map_from_lidar_)
             .topic("/points", ObjectType::PointCloud)
             .at(1_s, builder.stamp(77).build())
             .build(),
         "map");
    add("/points", {{"point_size", "1"}});
    const glm::dvec3 middle = map_from_lidar_.translation;
    view_ = {.eye_from_fixed = scenegraph::lookAt(middle + glm::dvec3(3, -2, 14), middle, {0, 1, 0}),
             .is_orthographic = GetParam().is_orthographic,
             .vertical_extent_m = 18.0};
    scene_->update(tf::TimePoint{1_s});
    const auto picture =
        renderer_->render(scene_->root(), view_, {.width = kWidthPx, .height = kHeightPx, .points = GetParam().way});
    ASSERT_TRUE(picture) << picture.error().message;
    project();
  }

  void project() {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto at = scenegraph::toScreen(view_, {double{kWidthPx}, double{kHeightPx}},
                                           tf::transformPoint(map_from_lidar_, points_[i]));
      if (!at) {
        continue;
      }
      constexpr double kUnsure = 0.01;
      const auto isNearBorder = [](double v) { return std::abs(v - std::round(v)) < kUnsure; };
      projected_.push_back({i, static_cast<int>(std::floor(at->position_px.x)),
                            static_cast<int>(std::floor(at->position_px.y)), at->depth_m,
                            isNearBorder(at->position_px.x) || isNearBorder(at->position_px.y)});
    }
  }
  /// The point that is meant at a pixel, by the definition; -1 for none, nullopt where rounding decides.
  [[nodiscard]] std::optional<int> reference(int x, int y) const {
    std::optional<Projected> best;
    for (const Projected& one : projected_) {
      const auto squareOf = [&](const Projected& p) { return (p.x - x) * (p.x - x) + (p.y - y) * (p.y - y); };
      if (squareOf(one) > (kReachPx + 2) * (kReachPx + 2)) {
        continue;
      }
      if (one.is_on_border) {
        return std::nullopt;
      }
      if (one.x < 0 || one.y < 0 || one.x >= kWidthPx || one.y >= kHeightPx) {
        continue;  // not in the picture
      }
      if (squareOf(one) > kReachPx * kReachPx) {
        continue;
      }
      // Of two on one pixel the nearer is seen, of two as far from the cursor the nearer is meant.
      if (!best || std::tuple(squareOf(one), one.depth_m) < std::tuple(squareOf(*best), best->depth_m)) {
        best = one;
      }
    }
    return best ? static_cast<int>(best->index) : -1;
  }

  static constexpr std::size_t kPoints = 600;
  tf::RigidTransform map_from_lidar_;
  std::vector<glm::dvec3> points_;
  scenegraph::CameraView view_;
  std::vector<Projected> projected_;
};

TEST_P(PickedPoints, AreThoseOfEveryPointProjectedInDouble) {
  Random random(5);
  int compared = 0;
  int found = 0;
  for (int i = 0; i < 400; ++i) {
    const int x = static_cast<int>(random.index(kWidthPx));
    const int y = static_cast<int>(random.index(kHeightPx));
    const auto expected = reference(x, y);
    if (!expected) {
      continue;
    }
    ++compared;
    const auto result = pickAt(x, y, kReachPx);
    ASSERT_EQ(result.has_value(), *expected >= 0) << "at " << x << ", " << y << ", expected " << *expected;
    if (!result) {
      EXPECT_EQ(result.error(), scenegraph::PickError::NothingThere);
      continue;
    }
    ++found;
    const auto index = static_cast<std::size_t>(*expected);
    ASSERT_EQ(result->picked.id, std::to_string(index)) << "at " << x << ", " << y;
    EXPECT_EQ(result->topic, "/points");
    EXPECT_EQ(result->picked.kind, "point");
    EXPECT_EQ(result->frame, "lidar");
    EXPECT_EQ(result->picked.stamp, tf::TimePoint{77});
    EXPECT_EQ(field(result->picked, "intensity"), std::to_string(index));
    EXPECT_EQ(field(result->picked, "ring"), std::to_string(index % 64));
    EXPECT_EQ(result->picked.point_in_frame, points_[index]);  // to the bit
    expectPoint(result->point_in_fixed, tf::transformPoint(map_from_lidar_, points_[index]));
  }
  EXPECT_GT(compared, 250);
  EXPECT_GT(found, 150);
}

TEST_P(PickedPoints, ArePickedAtTheirOwnPixelWithoutAnyReach) {
  int compared = 0;
  for (const Projected& one : projected_) {
    const bool is_alone = std::ranges::none_of(projected_, [&](const Projected& other) {
      return other.index != one.index && std::abs(other.x - one.x) < 2 && std::abs(other.y - one.y) < 2;
    });
    const bool is_inside = one.x >= 0 && one.y >= 0 && one.x < kWidthPx && one.y < kHeightPx;
    if (!is_alone || !is_inside || one.is_on_border) {
      continue;
    }
    const auto result = pickAt(one.x, one.y, 0);
    ASSERT_TRUE(result) << one.index;
    EXPECT_EQ(result->picked.id, std::to_string(one.index));
    ++compared;
  }
  EXPECT_GT(compared, 200);
}

INSTANTIATE_TEST_SUITE_P(Ways, PickedPoints,
                         testing::Values(PickCase{"gl", PointWay::OpenGl, false, 0.0},
                                         PickCase{"cpu", PointWay::Cpu, false, 0.0},
                                         PickCase{"gl_ecef", PointWay::OpenGl, false, 4e6},
                                         PickCase{"cpu_ecef", PointWay::Cpu, false, 4e6},
                                         PickCase{"gl_ortho", PointWay::OpenGl, true, 0.0},
                                         PickCase{"cpu_ortho_ecef", PointWay::Cpu, true, 4e6}),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace stillframe::test
