#include "tools/cli/layer_argument.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stillframe::cli {
namespace {

using testing::HasSubstr;
using Settings = scenegraph::SettingTexts;

TEST(LayerArgument, TakesLinksOfARobotAsKeys) {
  const auto layer = parseLayer("/a/robot_description:opacity=0.5,link.left-arm/tip.visible=false");
  ASSERT_TRUE(layer);
  EXPECT_EQ(layer->id, "/a/robot_description");
  EXPECT_EQ(layer->settings.at("link.left-arm/tip.visible"), "false");
}

TEST(LayerArgument, TakesATopicAlone) {
  const auto layer = parseLayer("/lidar/points");
  ASSERT_TRUE(layer);
  EXPECT_EQ(layer->id, "/lidar/points");
  EXPECT_TRUE(layer->settings.empty());
}

TEST(LayerArgument, TakesSettings) {
  const auto layer = parseLayer("/lidar/points:color=intensity,point_size=3");
  ASSERT_TRUE(layer);
  EXPECT_EQ(layer->id, "/lidar/points");
  EXPECT_EQ(layer->settings, (Settings{{"color", "intensity"}, {"point_size", "3"}}));
}

TEST(LayerArgument, KeepsColonsOfTheTopicAndOfValues) {
  EXPECT_EQ(parseLayer("a:b::c")->id, "a:b::c");
  const auto layer = parseLayer("ns:/points:2:color=a:b=c");
  ASSERT_TRUE(layer);
  EXPECT_EQ(layer->id, "ns:/points:2");
  EXPECT_EQ(layer->settings, (Settings{{"color", "a:b=c"}}));
}

TEST(LayerArgument, TakesQuotedValues) {
  const auto layer = parseLayer(R"(tf:color="a, \"b\"",other='x,y\',empty=,last=1)");
  ASSERT_TRUE(layer);
  EXPECT_EQ(layer->settings, (Settings{{"color", "a, \"b\""}, {"other", "x,y\\"}, {"empty", ""}, {"last", "1"}}));
}

TEST(LayerArgument, RefusesWhatItCannotRead) {
  EXPECT_THAT(parseLayer("").error().message, HasSubstr("no topic"));
  EXPECT_THAT(parseLayer(":a=b").error().message, HasSubstr("no topic"));
  EXPECT_THAT(parseLayer("t:a=1,b").error().message, HasSubstr("'b' is not key=value"));
  EXPECT_THAT(parseLayer("t:a=1,").error().message, HasSubstr("is not key=value"));
  EXPECT_THAT(parseLayer("t:a='1").error().message, HasSubstr("quote"));
  EXPECT_THAT(parseLayer("t:a=1,a=2").error().message, HasSubstr("twice"));
}

}  // namespace
}  // namespace stillframe::cli
