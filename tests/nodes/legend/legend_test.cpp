#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nodes/legend/glyph_canvas.h"
#include "nodes/legend/legend_picture.h"
#include "nodes/registry.h"
#include "scenegraph/layer_cost.h"
#include "tests/support/builders.h"

namespace stillframe::nodes {
namespace {

using namespace tf::literals;
using scenegraph::ColorLegend;
using scenegraph::ObjectType;
using test::CloudBuilder;
using test::DatasetBuilder;

LegendEntry blueToRed(const char* layer = "/points") {
  return {layer, ColorLegend{.title = "z", .unit = "m", .low = 0.0, .high = 1.0, .colors = {{0, 0, 1}, {1, 0, 0}}}};
}

std::array<int, 4> pixel(const LegendPicture& picture, int x, int y) {
  const std::size_t i =
      4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x));
  return {picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2], picture.rgba[i + 3]};
}

/// Row of pixels in which both ends of the colours are seen.
int barRow(const LegendPicture& picture, int left, int right) {
  for (int y = 0; y < picture.height; ++y) {
    if (pixel(picture, left, y) == std::array{0, 0, 255, 255} &&
        pixel(picture, right, y) == std::array{255, 0, 0, 255}) {
      return y;
    }
  }
  return -1;
}

TEST(LegendPicture, HasTheColoursFromLowToHighBitForBit) {
  const LegendPicture picture = drawLegends(std::vector{blueToRed()}, 1.0, 1000);
  ASSERT_EQ(picture.width, 216);
  const int row = barRow(picture, 8, 207);
  ASSERT_GE(row, 0);
  const auto middle = pixel(picture, 107, row);
  EXPECT_NEAR(middle[0], 127, 2);
  EXPECT_NEAR(middle[2], 128, 2);
  EXPECT_EQ(pixel(picture, 0, 0)[3], 0) << "round corners";
}

TEST(LegendPicture, WritesNameValuesAndUnit) {
  const auto inked = [](const LegendPicture& picture) {
    int count = 0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
      count += picture.rgba[i] > 150 && picture.rgba[i + 1] > 150 && picture.rgba[i + 2] > 150 ? 1 : 0;
    }
    return count;
  };
  LegendEntry nameless = blueToRed("");
  nameless.legend.title = "";
  nameless.legend.unit = "";
  const int numbers = inked(drawLegends(std::vector{nameless}, 1.0, 1000));
  const int all = inked(drawLegends(std::vector{blueToRed("/lidar/points")}, 1.0, 1000));
  EXPECT_GT(numbers, 20);
  EXPECT_GT(all, numbers + 100);
}

TEST(LegendPicture, WritesCharactersOfChineseJapaneseAndKorean) {
  // What a font does not have it draws as one box, whatever the character is.
  const auto named = [](const char* name) { return drawLegends(std::vector{blueToRed(name)}, 1.0, 1000).rgba; };
  for (const auto& [one, other] :
       {std::pair{"激光", "点云"}, std::pair{"デプス", "センサ"}, std::pair{"거리", "센서"}}) {
    EXPECT_NE(named(one), named(other)) << one;
  }
  EXPECT_NE(named("облако"), named("лазер!"));
  GlyphCanvas canvas(10, 10);
  EXPECT_GT(canvas.textWidth("激光", 12.0), 1.8 * 12.0 * 0.9) << "as wide as they are high";
  EXPECT_LT(canvas.textWidth("激光", 12.0), 2.2 * 12.0);
}

TEST(LegendPicture, LeavesOutWhatHasNoRoomAndSaysSo) {
  const std::vector<LegendEntry> five(5, blueToRed());
  const int one = drawLegends(std::vector{blueToRed()}, 1.0, 1000).height;
  const LegendPicture all = drawLegends(five, 1.0, 10'000);
  EXPECT_GT(all.height, 4 * one);
  const LegendPicture some = drawLegends(five, 1.0, 3 * one);
  EXPECT_LE(some.height, 3 * one);
  EXPECT_GT(some.height, one);
  EXPECT_TRUE(drawLegends(five, 1.0, 20).isEmpty());
  EXPECT_TRUE(drawLegends({}, 1.0, 1000).isEmpty());
}

TEST(LegendPicture, ScalesWithTheDisplay) {
  EXPECT_EQ(drawLegends(std::vector{blueToRed()}, 2.0, 1000).width, 432);
  EXPECT_EQ(drawLegends(std::vector{blueToRed()}, 1.5, 1000).width, 324);
  EXPECT_TRUE(drawLegends(std::vector{blueToRed()}, 0.0, 1000).isEmpty());
  EXPECT_TRUE(drawLegends(std::vector{blueToRed()}, std::nan(""), 1000).isEmpty());
}

TEST(LegendPicture, LeavesMostOfAPictureFreeHoweverSmallItIs) {
  const std::vector<LegendEntry> many(8, blueToRed());
  for (const double scale : {1.0, 1.5, 2.0}) {
    for (const auto& [width, height] :
         {std::pair{320, 240}, {330, 900}, {580, 690}, {1000, 200}, {1280, 800}, {3840, 2160}}) {
      const double width_px = width * scale;
      const double height_px = height * scale;
      const LegendPicture picture =
          drawFittingLegends(many, scale, static_cast<int>(width_px), static_cast<int>(height_px));
      ASSERT_FALSE(picture.isEmpty()) << width << " x " << height;
      EXPECT_LE(picture.height, 0.4 * height_px);
      EXPECT_LE(picture.width, std::max(width_px / 3.0, 0.75 * 216.0 * scale) + 1.0);
      EXPECT_LE(picture.width * picture.height, width_px * height_px / 6.0 + picture.height);
    }
    EXPECT_TRUE(drawFittingLegends(many, scale, static_cast<int>(310 * scale), 1000).isEmpty());
  }
  EXPECT_EQ(drawFittingLegends(many, 1.0, 1280, 800).width, 216) << "its own size where there is room";
  EXPECT_EQ(drawFittingLegends(many, 0.75, 320, 240).width, 162) << "no text is smaller than can be read";
  EXPECT_TRUE(drawFittingLegends(many, std::nan(""), 320, 240).isEmpty());
}

TEST(LegendPicture, StandsWhateverTheRangeIs) {
  const double huge = std::numeric_limits<double>::max();
  for (const auto& [low, high] : {std::pair{-huge, huge},
                                  {1.0, 1.0},
                                  {std::nan(""), 1.0},
                                  {2.0, -2.0},
                                  {0.0, 5e-324},
                                  {-std::numeric_limits<double>::infinity(), 0.0}}) {
    LegendEntry entry = blueToRed("a name that is far too long for the card, with an end that tells it apart");
    entry.legend.low = low;
    entry.legend.high = high;
    const LegendPicture picture = drawLegends(std::vector{entry}, 1.0, 1000);
    EXPECT_GE(barRow(picture, 8, 207), 0);
  }
}

TEST(LegendPicture, WritesTheNumberOfARangeWithoutWidthOnce) {
  LegendEntry entry = blueToRed();
  const auto inkedFrom = [&entry](int left, int right) {
    const LegendPicture picture = drawLegends(std::vector{entry}, 1.0, 1000);
    const int bar = barRow(picture, 8, 207);
    int count = 0;
    for (int y = std::max(bar + 12, 0); bar >= 0 && y < picture.height; ++y) {
      for (int x = left; x < right; ++x) {
        count += pixel(picture, x, y)[1] > 120 ? 1 : 0;
      }
    }
    return count;
  };
  ASSERT_GT(inkedFrom(0, 70), 0);
  ASSERT_GT(inkedFrom(146, 216), 0);
  entry.legend.low = entry.legend.high = 0.25;
  EXPECT_EQ(inkedFrom(0, 70), 0);
  EXPECT_EQ(inkedFrom(146, 216), 0);
  EXPECT_GT(inkedFrom(70, 146), 0);
}

TEST(LegendNumber, TellsValuesOfTheRangeApart) {
  EXPECT_EQ(legendNumber(0.5, 0.0, 1.0), "0.5");
  EXPECT_EQ(legendNumber(500'000.25, 500'000.0, 500'000.5), "500000.25");
  EXPECT_EQ(legendNumber(-1e-17, -1.0, 1.0), "0") << "what is left of a sum";
  EXPECT_EQ(legendNumber(1.23456789e7, 0.0, 1.23456789e7), "1.23e+07");
  EXPECT_EQ(legendNumber(7.0, 7.0, 7.0), "7");
  EXPECT_EQ(legendNumber(std::nan(""), 0.0, 1.0), "nan");
}

class LegendEntriesTest : public testing::Test {
 protected:
  LegendEntriesTest() {
    builder.topic("/tf", ObjectType::FrameTransforms).transform(0_s, "map", "lidar", test::translate(0, 0, 10));
    CloudBuilder cloud("lidar");
    cloud.xyz().field("intensity", scenegraph::FieldType::Float32);
    for (int i = 0; i < 100; ++i) {
      cloud.point({0.0, 0.0, 0.01 * i, i < 90 ? 1.0 : 5.0});
    }
    builder.topic("/points", ObjectType::PointCloud).at(0_s, cloud.build());
    (void)builder.build();
    scene.addDefaultLayers();
    scene.update({1_s});
  }
  scenegraph::LayerSlot& points() { return *scene.findLayer("/points"); }
  void set(const scenegraph::SettingTexts& texts) {
    ASSERT_TRUE(points().layer->applySettings(texts));
    scene.update({1_s});
  }

  DatasetBuilder builder;
  std::unique_ptr<scenegraph::Executor> executor = scenegraph::makeSynchronousExecutor();
  scenegraph::Scene scene{builder.raw(), layerTypes(), *executor};
};

TEST_F(LegendEntriesTest, AreThoseOfWhatIsColouredByValue) {
  auto entries = legendEntries(scene);
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].layer, "/points");
  EXPECT_EQ(entries[0].legend.title, "intensity");
  EXPECT_EQ(entries[0].legend.low, 1.0);
  EXPECT_EQ(entries[0].legend.high, 5.0);
  set({{"color_field", "z"}, {"reverse_colormap", "true"}});
  const auto forth = entries[0].legend.colors;
  entries = legendEntries(scene);
  EXPECT_EQ(entries[0].legend.title, "z in map");
  EXPECT_EQ(entries[0].legend.unit, "m");
  EXPECT_NEAR(entries[0].legend.low, 10.0, 1e-6) << "in the fixed frame";
  EXPECT_NEAR(entries[0].legend.high, 10.99, 1e-6);
  EXPECT_EQ(entries[0].legend.colors.front(), forth.back());
  set({{"range_mode", "manual"}, {"range_min", "3"}, {"range_max", "-3"}});
  EXPECT_EQ(legendEntries(scene)[0].legend.low, 3.0);
  set({{"color_field", "flat"}});
  EXPECT_TRUE(legendEntries(scene).empty());
  set({{"color_field", "intensity"}});
  points().layer->setVisible(false);
  scene.update({1_s});
  EXPECT_TRUE(legendEntries(scene).empty());
  EXPECT_FALSE(points().layer->histogramWork());
}

TEST_F(LegendEntriesTest, HistogramsCountTheValuesBehindThem) {
  auto histogram = points().layer->histogramWork()();
  EXPECT_EQ(histogram.low, 1.0);
  EXPECT_EQ(histogram.high, 5.0);
  EXPECT_EQ(histogram.counts.front(), 90U);
  EXPECT_EQ(histogram.counts.back(), 10U);
  set({{"color_field", "z"}});
  const auto work = points().layer->histogramWork();
  scene.removeLayer("/points");
  histogram = work();
  EXPECT_NEAR(histogram.low, 10.0, 1e-5) << "in the fixed frame, and without the layer";
  EXPECT_NEAR(histogram.high, 10.99, 1e-5);
}

TEST_F(LegendEntriesTest, ALayerTellsWhatItCosts) {
  scenegraph::LayerCost cost = scenegraph::layerCost(points());
  EXPECT_EQ(cost.vertices, 100U);
  EXPECT_EQ(cost.draw_calls, 1U);
  ASSERT_TRUE(cost.decode_ms);
  EXPECT_GT(*cost.decode_ms, 0.0);
  EXPECT_THAT(scenegraph::costText(cost), testing::StartsWith("100 vertices in 1 draw call, decoded in "));
  EXPECT_EQ(scenegraph::costText({.vertices = 0, .draw_calls = 0, .decode_ms = 1746.2, .draw_ms = 999.4}),
            "0 vertices in 0 draw calls, decoded in 1.7 s, drawn in 999 ms");
  EXPECT_EQ(scenegraph::costText({.vertices = 1, .draw_calls = 1, .decode_ms = 0.0008, .draw_ms = 0.0123}),
            "1 vertex in 1 draw call, decoded in less than 0.01 ms, drawn in 0.0123 ms");
  EXPECT_FALSE(scenegraph::layerCost(*scene.findLayer("grid")).decode_ms) << "nothing was decoded for it";
  EXPECT_EQ(scenegraph::layerCost(*scene.findLayer("grid")).vertices, 44U);
  EXPECT_GT(scenegraph::layerCost(*scene.findLayer("tf")).draw_calls, 1U);
  points().layer->setVisible(false);
  cost = scenegraph::layerCost(points());
  EXPECT_EQ(cost.vertices, 0U);
  EXPECT_EQ(cost.draw_calls, 0U);
}

}  // namespace
}  // namespace stillframe::nodes
