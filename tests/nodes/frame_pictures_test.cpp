#include <gmock/gmock.h>

#include <algorithm>

#include "tests/nodes/scene_picture.h"

namespace stillframe::test {
namespace {

using scenegraph::ObjectType;
using testing::HasSubstr;

std::shared_ptr<scenegraph::Dataset> tree() {
  return DatasetBuilder()
      .topic("/tf", ObjectType::FrameTransforms)
      .transform(0, "map", "base", translate(5, 0, 0))
      .transform(0, "base", "arm", turn(1.5707963267948966, 0, 5, 0))
      .transform(5_s, "base", "late", translate(0, -5, 0))
      .build();
}

class AxesPicture : public ScenePictureTest {};

TEST_F(AxesPicture, DrawsATriadAtEachFrameAndALineToItsParent) {
  open(tree(), "map");
  const auto& layer = add("tf", {{"axis_length", "2"}});
  const auto picture = draw(1_s, fromAbove());
  // base lies at (5, 0) = pixel (150, 100), its x to the right, its y up; arm at (5, 5), turned left.
  const auto isRed = [](const Bytes3& c) { return c[0] > 120 && c[1] < 80 && c[2] < 80; };
  const auto isGreen = [](const Bytes3& c) { return c[1] > 100 && c[0] < 80 && c[2] < 100; };
  EXPECT_TRUE(isRed(pixel(picture, 165, 100)));
  EXPECT_TRUE(isGreen(pixel(picture, 150, 85)));
  EXPECT_TRUE(isRed(pixel(picture, 150, 35)));
  EXPECT_TRUE(isGreen(pixel(picture, 135, 50)));
  int magenta = 0;
  for (int x = 122; x < 148; ++x) {
    for (int y = 99; y <= 100; ++y) {
      magenta += pixel(picture, x, y) == Bytes3{255, 0, 255} ? 1 : 0;
    }
  }
  EXPECT_GE(magenta, 25) << "line from base to map";
  EXPECT_EQ(layer.counts(), (scenegraph::LayerCounts{{"frames", 4}, {"unresolved", 1}}));
  EXPECT_EQ(layer.status().code, "UnresolvedFrames");
  EXPECT_THAT(layer.status().message, HasSubstr("late"));
}

TEST_F(AxesPicture, HidesLinesAndFramesOnDemand) {
  open(tree(), "map");
  auto& layer = add("tf", {{"axes", "false"}});
  const int lines = drawnPixels(draw(1_s, fromAbove()));
  EXPECT_NEAR(lines, 100, 6) << "two lines of 5 m";
  ASSERT_TRUE(layer.applySettings({{"parent_lines", "false"}}));
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
  ASSERT_TRUE(layer.applySettings({{"parent_lines", "true"}, {"hidden_frames", " arm ,late"}}));
  EXPECT_NEAR(drawnPixels(draw(1_s, fromAbove())), 50, 4);
  EXPECT_EQ(layer.counts()[0].second, 2U);
  ASSERT_TRUE(layer.applySettings({{"hidden_frames", ""}, {"frame_filter", "^a"}}));
  EXPECT_NEAR(drawnPixels(draw(1_s, fromAbove())), 50, 4);
  EXPECT_EQ(layer.counts()[0].second, 1U);
  const auto refused = layer.applySettings({{"frame_filter", "(["}});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "BadValue");
  EXPECT_EQ(layer.settings().at("frame_filter"), "^a");
}

TEST_F(AxesPicture, DrawsNoMoreFramesThanAskedForAndSaysSo) {
  open(tree(), "map");
  auto& layer = add("tf", {{"max_frames", "2"}, {"stale_after", "0"}});
  (void)draw(6_s, fromAbove());
  EXPECT_EQ(layer.counts(), (scenegraph::LayerCounts{{"frames", 2}, {"unresolved", 0}, {"left_out", 2}}));
  EXPECT_EQ(layer.status().code, "TooManyFrames");
  EXPECT_THAT(layer.status().message, HasSubstr("first 2 of 4"));
  ASSERT_TRUE(layer.applySettings({{"max_frames", "4"}}));
  (void)draw(6_s, fromAbove());
  EXPECT_EQ(layer.counts(), (scenegraph::LayerCounts{{"frames", 4}, {"unresolved", 0}}));
  EXPECT_EQ(layer.status().code, "Ok");
}

TEST_F(AxesPicture, DimsAFrameThatNothingHasBeenHeardOfAndTellsItsAge) {
  open(tree(), "map");
  auto& layer = add("tf", {{"axis_length", "2"}, {"hidden_frames", "map,arm,late"}, {"parent_lines", "false"}});
  const auto reddest = [&](std::int64_t time_ns) { return pixel(draw(time_ns, fromAbove()), 165, 100)[0]; };
  const int fresh = reddest(5_s);
  const int stale = reddest(6_s);
  EXPECT_GT(fresh, stale + 60);
  EXPECT_EQ(layer.counts().back(), (std::pair<std::string, std::uint64_t>{"stale", 1}));
  EXPECT_EQ(reddest(5_s), fresh) << "back in time it is fresh again";
  ASSERT_TRUE(layer.applySettings({{"stale_after", "0"}}));
  EXPECT_EQ(reddest(6_s), fresh);
  ASSERT_TRUE(
      layer.applySettings({{"stale_after", "5"}, {"axes", "false"}, {"labels", "true"}, {"label_height", "8"}}));
  const int without_age = drawnPixels(draw(5_s, fromAbove(5.0)));
  EXPECT_GT(drawnPixels(draw(6_s, fromAbove(5.0))), 2 * without_age) << "(6.0 s old)";
}

TEST_F(AxesPicture, NamesAtOnePlaceAreWrittenBelowEachOther) {
  open(DatasetBuilder()
           .topic("/tf", ObjectType::FrameTransforms)
           .transform(0, "map", "odom")
           .transform(0, "odom", "footprint")
           .transform(0, "footprint", "base", translate(0.5, 0, 0))
           .build(),
       "map");
  add("tf", {{"axes", "false"}, {"parent_lines", "false"}, {"labels", "true"}});
  const auto picture = draw(1_s, fromAbove());
  // Three lines of names above the origin at pixel (100, 100); "base", 5 pixels beside them, has no room.
  const auto drawnRows = [&](int from_x, int to_x) {
    int rows = 0;
    for (int y = 0; y < 200; ++y) {
      bool is_drawn = false;
      for (int x = from_x; x < to_x; ++x) {
        is_drawn = is_drawn || pixel(picture, x, y)[0] > 60;
      }
      rows += is_drawn ? 1 : 0;
    }
    return rows;
  };
  EXPECT_GT(drawnRows(100, 199), 30) << "three lines";
  EXPECT_LT(drawnRows(100, 199), 60);
}

TEST_F(AxesPicture, WritesNamesOnlyWhenAsked) {
  open(tree(), "map");
  auto& layer = add("tf", {{"axes", "false"}, {"parent_lines", "false"}, {"labels", "true"}});
  const auto picture = draw(1_s, fromAbove());
  int beside_base = 0;
  for (int x = 150; x < 190; ++x) {
    for (int y = 82; y < 104; ++y) {
      beside_base += pixel(picture, x, y)[0] > 100 ? 1 : 0;
    }
  }
  EXPECT_GT(beside_base, 60);
  EXPECT_LT(beside_base, 500);
  ASSERT_TRUE(layer.applySettings({{"labels", "false"}}));
  EXPECT_EQ(drawnPixels(draw(1_s, fromAbove())), 0);
}

TEST_F(AxesPicture, WritesNamesInTheirColour) {
  open(tree(), "map");
  add("tf", {{"axes", "false"},
             {"parent_lines", "false"},
             {"labels", "true"},
             {"label_height", "60"},
             {"label_color", "#4080c0"}});
  const auto picture = draw(1_s, fromAbove());
  Bytes3 brightest{};
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    brightest[i % 3] = std::max(brightest[i % 3], static_cast<int>(picture.rgb[i]));
  }
  EXPECT_EQ(brightest, (Bytes3{0x40, 0x80, 0xc0}));
}

TEST_F(AxesPicture, ShowsFramesThatArriveLater) {
  const auto dataset = tree();
  open(dataset, "map");
  const auto& layer = add("tf", {{"stale_after", "0"}});
  (void)draw(6_s, fromAbove());
  EXPECT_EQ(layer.counts(), (scenegraph::LayerCounts{{"frames", 4}, {"unresolved", 0}}));
  EXPECT_EQ(layer.status(), scenegraph::Status{});
  ASSERT_TRUE(dataset->transforms()->insert({"arm", "tool", tf::TimePoint{6_s}, translate(1, 0, 0)}));
  (void)draw(6_s, fromAbove());
  EXPECT_EQ(layer.counts()[0].second, 5U);
}

class GridPicture : public ScenePictureTest {};

TEST_F(GridPicture, DrawsTenByTenCellsOfOneMetreByDefault) {
  open(tree(), "map");
  add("grid");
  scenegraph::CameraView view = fromAbove();
  view.vertical_extent_m = 12.0;
  const auto picture = draw(1_s, view, 240, 240);
  // Lines every 20 pixels from 20 to 220, none outside: each row between lines crosses eleven.
  int crossed = 0;
  for (int x = 0; x < 240; ++x) {
    crossed += pixel(picture, x, 110) != Bytes3{0, 0, 0} ? 1 : 0;
  }
  EXPECT_EQ(crossed, 11);
  EXPECT_EQ(pixel(picture, 10, 110), (Bytes3{0, 0, 0}));
  EXPECT_FALSE(scene_->boundsInFixed().valid());
}

TEST_F(GridPicture, TakesPlaneCountSizeAndColour) {
  open(tree(), "map");
  add("grid", {{"plane", "xz"}, {"cells", "2"}, {"cell_size", "4"}, {"color", "#ff0000"}});
  EXPECT_NEAR(drawnPixels(draw(1_s, fromAbove())), 80, 4) << "seen from above, one line 8 m long";
  scenegraph::CameraView front;
  front.eye_from_fixed = scenegraph::lookAt({0, -10, 0}, {0, 0, 0}, {0, 0, 1});
  front.is_orthographic = true;
  front.vertical_extent_m = 20.0;
  const auto picture = draw(1_s, front);
  EXPECT_NEAR(drawnPixels(picture), 6 * 80, 20);
  int red = 0;
  for (int y = 0; y < 200; ++y) {
    red += pixel(picture, 80, y) == Bytes3{255, 0, 0} ? 1 : 0;
  }
  EXPECT_EQ(red, 3);
}

}  // namespace
}  // namespace stillframe::test
