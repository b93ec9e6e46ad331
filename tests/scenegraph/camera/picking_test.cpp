#include "scenegraph/camera/picking.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "scenegraph/camera/orbit_camera.h"
#include "scenegraph/camera/top_down_camera.h"
#include "tests/scenegraph/camera/camera_cases.h"
#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

using test::TfBuilder;
using test::translate;
using namespace tf::literals;

class PickFrames : public testing::Test {
 protected:
  PickFrames() {
    buffer = TfBuilder()
                 .edge("map", "left")
                 .at(0_s, translate(0, -1, 0))
                 .edge("map", "right")
                 .at(0_s, translate(0, 1, 0))
                 .edge("map", "nearer_right")
                 .at(0_s, translate(5, 0.5, 0))
                 .edge("map", "behind")
                 .at(0_s, translate(20, 0, 0))
                 .edge("map", "late")
                 .at(10_s, translate(0, 0, 0.5))
                 .edge("other", "elsewhere")
                 .at(0_s, translate(0, 0, 0.5))
                 .build();
    buffer->snapshot(*buffer->findFrame("map"), {5_s}, map_from_frames);
    camera.setLookAt({10, 0, 0}, {0, 0, 0});
  }
  std::optional<FramePick> at(double x, double y, double reach = 20.0) const {
    const auto picks = pickFrames(*buffer, map_from_frames, camera.view(), kSize, {x, y}, reach);
    return picks.empty() ? std::nullopt : std::optional(picks.front());
  }
  std::shared_ptr<tf::TransformBuffer> buffer;
  tf::Snapshot map_from_frames;
  OrbitCamera camera;
};

TEST_F(PickFrames, TakesTheNearestOriginWithinReach) {
  const auto left = toScreen(camera.view(), kSize, {0, -1, 0});
  const auto pick = at(left->position_px.x + 3, left->position_px.y + 4);
  ASSERT_TRUE(pick);
  EXPECT_EQ(pick->frame, "left");
  EXPECT_NEAR(pick->distance_px, 5.0, 1e-9);
  EXPECT_NEAR(pick->depth_m, 10.0, 1e-9);
  EXPECT_FALSE(at(left->position_px.x + 30, left->position_px.y));
}

TEST_F(PickFrames, OfTwoAtOnePixelTakesTheOneNearerToTheEye) {
  const auto right = toScreen(camera.view(), kSize, {0, 1, 0});
  const auto nearer = toScreen(camera.view(), kSize, {5, 0.5, 0});
  ASSERT_NEAR(right->position_px.x, nearer->position_px.x, 1e-9);
  const auto pick = at(right->position_px.x, right->position_px.y);
  ASSERT_TRUE(pick);
  EXPECT_EQ(pick->frame, "nearer_right");
}

TEST_F(PickFrames, ListsTheOthersWithinReachByDistance) {
  const auto right = toScreen(camera.view(), kSize, {0, 1, 0});
  const auto all =
      pickFrames(*buffer, map_from_frames, camera.view(), kSize, right->position_px + glm::dvec2(1, 0), 300.0, 9);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].frame, "nearer_right");
  EXPECT_EQ(all[1].frame, "right");
  EXPECT_EQ(all[2].frame, "map");
  EXPECT_EQ(all[3].frame, "left");
}

TEST_F(PickFrames, FindsTheSameInAnOrthographicView) {
  TopDownCamera above;
  const auto left = toScreen(above.view(), kSize, {0, -1, 0});
  ASSERT_TRUE(left);
  const auto picks = pickFrames(*buffer, map_from_frames, above.view(), kSize, left->position_px, 5.0);
  ASSERT_EQ(picks.size(), 1U);
  EXPECT_EQ(picks.front().frame, "left");
}

TEST_F(PickFrames, NeverPicksWhatIsBehindOrHasNoPlace) {
  // "behind" would mirror onto the centre, "late" and "elsewhere" have no place in map at 5 s.
  const auto pick = at(kSize.width_px / 2, kSize.height_px / 2, 2000.0);
  ASSERT_TRUE(pick);
  EXPECT_EQ(pick->frame, "map");
  camera.setLookAt({-10, 0, 0}, {-20, 0, 0});
  EXPECT_FALSE(at(kSize.width_px / 2, kSize.height_px / 2, 1e9)) << "everything is behind";
}

TEST_F(PickFrames, PicksNothingInAPictureWithoutArea) {
  EXPECT_TRUE(pickFrames(*buffer, map_from_frames, camera.view(), {0, 0}, {0, 0}, 1e9).empty());
  EXPECT_TRUE(pickFrames(*buffer, map_from_frames, camera.view(), {kNan, 5}, {0, 0}, 1e9).empty());
  EXPECT_FALSE(at(kNan, 0));
}

TEST(SightLine, GoesThroughWhatFallsOnItsPixelWhateverTheCamera) {
  test::Random random(3);
  for (const double offset : {0.0, 6.4e6}) {
    for (const bool is_orthographic : {false, true}) {
      const glm::dvec3 eye(offset + 3.0, -offset, 5.0 - offset);
      const CameraView view{.eye_from_fixed = lookAt(eye, eye + glm::dvec3(-3, 2, -4), {0, 0, 1}),
                            .is_orthographic = is_orthographic,
                            .vertical_extent_m = 8.0};
      for (int i = 0; i < 50; ++i) {
        const glm::dvec2 pixel(random.number(0, 1280), random.number(0, 720));
        const auto line = sightLine(view, kSize, pixel);
        ASSERT_TRUE(line);
        const double metres = random.number(0.1, 100.0);
        const auto back = toScreen(view, kSize, line->origin + metres * line->direction);
        ASSERT_TRUE(back);
        EXPECT_NEAR(back->position_px.x, pixel.x, 1e-4);
        EXPECT_NEAR(back->position_px.y, pixel.y, 1e-4);
        EXPECT_NEAR(back->depth_m, metres, 1e-7);
      }
    }
  }
  EXPECT_FALSE(sightLine({}, {0.0, 720.0}, {1, 1}));
}

TEST(LineOnScreen, IsCutAtTheNearPlaneAndGoneBehindTheEye) {
  const CameraView view{.eye_from_fixed = lookAt({0, 0, 0}, {0, 1, 0}, {0, 0, 1}), .near_m = 0.1};
  const auto whole = toScreen(view, kSize, {-1, 10, 0}, {1, 10, 0});
  ASSERT_TRUE(whole);
  EXPECT_NEAR(whole->first.x + whole->second.x, 1280.0, 1e-9);
  EXPECT_NEAR(whole->first.y, 360.0, 1e-9);
  for (const bool is_turned : {false, true}) {
    const glm::dvec3 before(0, 10, 0);
    const glm::dvec3 behind(2, -10, 0);
    const auto cut = is_turned ? toScreen(view, kSize, behind, before) : toScreen(view, kSize, before, behind);
    ASSERT_TRUE(cut);
    const glm::dvec2 seen = is_turned ? cut->second : cut->first;
    const glm::dvec2 end = is_turned ? cut->first : cut->second;
    EXPECT_NEAR(seen.x, 640.0, 1e-9);
    EXPECT_GT(end.x, 640.0) << "to the side where it passes the eye";
  }
  EXPECT_FALSE(toScreen(view, kSize, {0, -1, 0}, {1, -5, 0}));
  EXPECT_FALSE(toScreen(view, kSize, {0, 0, 0}, {0, 0, 0}));
  EXPECT_FALSE(toScreen(view, kSize, {kNan, 1, 0}, {0, 2, 0}));
}

}  // namespace
}  // namespace stillframe::scenegraph
