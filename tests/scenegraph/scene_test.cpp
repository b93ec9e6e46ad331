#include "scenegraph/scene.h"

#include <gtest/gtest.h>

#include "tests/scenegraph/fake_layer.h"
#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

using test::CloudBuilder;
using test::DatasetBuilder;
using test::TfBuilder;
using test::translate;
using namespace tf::literals;

class SceneTest : public testing::Test {
 protected:
  SceneTest() {
    builder.topic("/tf", ObjectType::FrameTransforms).transform(0_s, "map", "lidar", translate(1, 0, 0));
    builder.topic("/points", ObjectType::PointCloud).at(0_s, CloudBuilder("lidar").xyz().point({1, 2, 3}).build());
    builder.topic("/log", ObjectType::None);
    (void)builder.build();
  }
  DatasetBuilder builder;
  std::unique_ptr<Executor> executor = makeSynchronousExecutor();
  Scene scene{builder.raw(), test::fakeTypes(), *executor};
};

TEST_F(SceneTest, SaysWhetherThePictureMayHaveChanged) {
  scene.addDefaultLayers();
  EXPECT_TRUE(scene.update({1_s}));
  EXPECT_FALSE(scene.update({1_s}));
  EXPECT_TRUE(scene.update({2_s}));
  ASSERT_TRUE(scene.findLayer("/points")->layer->applySettings({{"size", "3"}}));
  EXPECT_TRUE(scene.update({2_s}));
  EXPECT_FALSE(scene.update({2_s}));
  scene.findLayer("/points")->layer->setVisible(false);
  EXPECT_TRUE(scene.update({2_s}));
  scene.setFixedFrame("lidar");
  EXPECT_TRUE(scene.update({2_s}));
  EXPECT_FALSE(scene.update({2_s}));
  (void)builder.topic("/tf", ObjectType::FrameTransforms).transform(1_s, "map", "lidar", translate(2, 0, 0)).build();
  EXPECT_TRUE(scene.update({2_s}));
  scene.removeLayer("/points");
  EXPECT_TRUE(scene.update({2_s}));
  EXPECT_FALSE(scene.update({2_s}));
}

TEST_F(SceneTest, BringsLayersToATickOnlyWhereSomethingIsNew) {
  scene.addDefaultLayers();
  scene.update({1_s});
  const std::uint64_t ticks = scene.ticks();
  EXPECT_FALSE(scene.update({1_s}));
  EXPECT_EQ(scene.ticks(), ticks);
  const std::uint64_t settings = scene.settingsRevision();
  Layer& layer = *scene.findLayer("/points")->layer;
  ASSERT_TRUE(layer.applySettings(layer.settings()));
  EXPECT_FALSE(scene.update({1_s})) << "the same settings again";
  EXPECT_EQ(scene.ticks(), ticks + 1);
  EXPECT_EQ(scene.settingsRevision(), settings);
  ASSERT_FALSE(layer.applySettings({{"no such setting", "1"}}));
  scene.update({1_s});
  EXPECT_EQ(scene.ticks(), ticks + 1) << "what is refused changes nothing";
  layer.setVisible(false);
  layer.setVisible(true);
  scene.update({1_s});
  EXPECT_EQ(scene.ticks(), ticks + 2) << "it has to show what it was made to drop";
  EXPECT_TRUE(scene.boundsInFixed().valid());
}

TEST_F(SceneTest, AnUpdateAfterBackgroundWorkShowsItsResult) {
  const auto pool = makeThreadPoolExecutor(1);
  std::atomic<int> requests = 0;
  Scene in_background(builder.raw(), test::fakeTypes(), *pool, [&] { ++requests; });
  in_background.addDefaultLayers();
  in_background.update({1_s});
  pool->drain();
  EXPECT_EQ(requests, 1);
  EXPECT_TRUE(in_background.update({1_s}));
  EXPECT_FALSE(in_background.isPending());
  EXPECT_TRUE(in_background.boundsInFixed().valid());
  EXPECT_FALSE(in_background.update({1_s}));
}

TEST_F(SceneTest, AddsALayerOncePerTopicAndForNewTopicsLater) {
  scene.addDefaultLayers();
  EXPECT_EQ(scene.layers().size(), 1U);
  const auto again = scene.addLayer("/points");
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, scene.findLayer("/points"));
  builder.topic("/more", ObjectType::PointCloud);
  scene.addDefaultLayers();
  EXPECT_EQ(scene.layers().size(), 2U);
  scene.removeLayer("/points");
  EXPECT_EQ(scene.findLayer("/points"), nullptr);
  scene.removeLayer("/points");
}

TEST(SceneWithoutTransforms, ShowsTheDataInItsOwnFrameOnEveryPath) {
  DatasetBuilder builder;
  builder.topic("/points", ObjectType::PointCloud)
      .at(1_s, CloudBuilder("lidar").xyz().point({1, 2, 3}).build())
      .at(2_s, CloudBuilder("radar").xyz().point({4, 5, 6}).build());
  (void)builder.build();
  const auto executor = makeSynchronousExecutor();
  Scene scene(builder.raw(), test::fakeTypes(), *executor);
  scene.addDefaultLayers();
  for (const auto& [time, frame] : {std::pair{1_s, "lidar"}, std::pair{2_s, "radar"}, std::pair{1_s, "lidar"}}) {
    scene.update({time});
    EXPECT_EQ(scene.fixedFrame(), frame);
    EXPECT_EQ(scene.layers().front()->layer->status(), Status{});
    EXPECT_TRUE(scene.boundsInFixed().valid());
  }
  scene.update({0_s});
  EXPECT_EQ(scene.fixedFrame(), "");
}

TEST_F(SceneTest, RefusesUnknownAndUnsupportedTopicsByName) {
  const auto unknown = scene.addLayer("/point");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, "UnknownTopic");
  EXPECT_TRUE(unknown.error().message.contains("'/points'")) << unknown.error().message;
  EXPECT_EQ(scene.addLayer("/log").error().code, "UnsupportedTopic");
  EXPECT_EQ(scene.addLayer("/tf").error().code, "UnsupportedTopic");
}

TEST_F(SceneTest, TheFixedFrameIsChosenByItselfUntilSomebodyDoes) {
  EXPECT_EQ(scene.fixedFrame(), "map");
  EXPECT_FALSE(scene.isFixedFrameExplicit());
  scene.setFixedFrame("/lidar");
  EXPECT_EQ(scene.fixedFrame(), "lidar");
  EXPECT_TRUE(scene.isFixedFrameExplicit());
  scene.setFixedFrame(std::nullopt);
  EXPECT_EQ(scene.fixedFrame(), "map");
  scene.setFixedFrame("/");
  EXPECT_FALSE(scene.isFixedFrameExplicit());
}

TEST_F(SceneTest, BoundsFollowTheFixedFrame) {
  scene.addDefaultLayers();
  scene.update({1_s});
  EXPECT_DOUBLE_EQ(scene.boundsInFixed().xMin(), 2.0);
  scene.setFixedFrame("lidar");
  scene.update({1_s});
  EXPECT_DOUBLE_EQ(scene.boundsInFixed().xMin(), 1.0);
  scene.findLayer("/points")->layer->setVisible(false);
  scene.update({1_s});
  EXPECT_FALSE(scene.boundsInFixed().valid());
}

TEST(AutomaticFixedFrame, PrefersTheUsualNamesThenTheLargestTree) {
  EXPECT_EQ(automaticFixedFrame(tf::TransformBuffer{}), "");
  EXPECT_EQ(automaticFixedFrame(*TfBuilder().edge("odom", "a").at(0, {}).edge("map", "odom").at(0, {}).build()), "map");
  EXPECT_EQ(automaticFixedFrame(*TfBuilder().edge("x", "base_link").at(0, {}).build()), "base_link");
  EXPECT_EQ(
      automaticFixedFrame(
          *TfBuilder().edge("small", "s1").at(0, {}).edge("large", "l1").at(0, {}).edge("l1", "l2").at(0, {}).build()),
      "large");
  EXPECT_EQ(automaticFixedFrame(*TfBuilder().edge("first", "a").at(0, {}).edge("second", "b").at(0, {}).build()),
            "first");
}

}  // namespace
}  // namespace stillframe::scenegraph
