#include "scenegraph/layer_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenegraph/fake_layer.h"
#include "tests/support/builders.h"

namespace stillframe::scenegraph {
namespace {

using test::CloudBuilder;
using test::DatasetBuilder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using namespace tf::literals;

class LayerListTest : public testing::Test {
 protected:
  LayerListTest() {
    for (const char* topic : {"/a", "/b", "/c"}) {
      builder.topic(topic, ObjectType::PointCloud).at(0_s, CloudBuilder("map").xyz().point({1, 2, 3}).build());
    }
    (void)builder.build();
    scene.addDefaultLayers();
  }
  [[nodiscard]] static std::vector<std::string> ids(const Scene& of) {
    std::vector<std::string> ids;
    std::ranges::transform(of.layers(), std::back_inserter(ids), [](const auto& slot) { return slot->id; });
    return ids;
  }
  [[nodiscard]] static std::string size(Scene& of, const char* id) {
    return of.findLayer(id)->layer->settings().at("size");
  }

  DatasetBuilder builder;
  std::unique_ptr<Executor> executor = makeSynchronousExecutor();
  Scene scene{builder.raw(), test::fakeTypes(), *executor};
};

TEST_F(LayerListTest, ADuplicateHasTheNextNumberAndTheSameSettings) {
  ASSERT_TRUE(scene.findLayer("/a")->layer->applySettings({{"size", "3"}}));
  scene.findLayer("/a")->layer->setVisible(false);
  EXPECT_EQ(scene.duplicateLayer(*scene.findLayer("/a")).id, "/a#2");
  EXPECT_EQ(scene.duplicateLayer(*scene.findLayer("/a#2")).id, "/a#3");
  EXPECT_THAT(ids(scene), ElementsAre("/a", "/a#2", "/a#3", "/b", "/c"));
  EXPECT_EQ(scene.findLayer("/a#3")->topic, "/a");
  EXPECT_EQ(scene.findLayer("/a#3")->title, "/a#3");
  EXPECT_EQ(size(scene, "/a#3"), "3");
  EXPECT_FALSE(scene.findLayer("/a#3")->layer->isVisible());
  ASSERT_TRUE(scene.findLayer("/a")->layer->applySettings({{"size", "5"}}));
  EXPECT_EQ(size(scene, "/a#3"), "3") << "each has settings of its own";
  scene.removeLayer("/a#2");
  EXPECT_EQ(scene.duplicateLayer(*scene.findLayer("/a")).id, "/a#2") << "the first free number";
}

TEST_F(LayerListTest, TheNumberedIdOfATopicMakesTheDuplicate) {
  const auto made = scene.addLayer("/b#7");
  ASSERT_TRUE(made);
  EXPECT_EQ((*made)->topic, "/b");
  EXPECT_EQ(*scene.addLayer("/b#7"), *made);
  for (const char* id : {"/b#1", "/b#0", "/b#02", "/b#", "/b#x", "/b#-2", "/b#99999999999999999999", "/none#2"}) {
    EXPECT_FALSE(scene.addLayer(id)) << id;
  }
  EXPECT_THAT(scene.addLayer("/d#2").error().message, HasSubstr("'/d'"));
}

TEST_F(LayerListTest, ATopicWhoseNameLooksLikeADuplicateIsItself) {
  builder.topic("/a#2", ObjectType::PointCloud).at(0_s, CloudBuilder("map").xyz().point({1, 2, 3}).build());
  (void)builder.build();
  EXPECT_EQ((*scene.addLayer("/a#2"))->topic, "/a#2");
  EXPECT_EQ(scene.duplicateLayer(*scene.findLayer("/a")).id, "/a#3");
}

TEST_F(LayerListTest, ADuplicateIsDrawnAndDecodedOnce) {
  scene.duplicateLayer(*scene.findLayer("/a"));
  scene.removeLayer("/b");
  scene.removeLayer("/c");
  scene.update({1_s});
  const auto& cache = scene.dataset().cache();
  EXPECT_EQ(scene.findLayer("/a")->layer->counts(), scene.findLayer("/a#2")->layer->counts());
  EXPECT_EQ(cache.misses(), 1U);
  EXPECT_EQ(cache.hits(), 1U);
}

TEST_F(LayerListTest, WhatWasRemovedComesBackOnlyByHand) {
  scene.removeLayer("/b");
  scene.addDefaultLayers();
  EXPECT_THAT(ids(scene), ElementsAre("/a", "/c"));
  ASSERT_TRUE(scene.addLayer("/b"));
  EXPECT_THAT(scene.removedTopics(), IsEmpty());
  scene.duplicateLayer(*scene.findLayer("/b"));
  scene.removeLayer("/b#2");
  EXPECT_THAT(scene.removedTopics(), IsEmpty()) << "a duplicate is not added by itself anyway";
}

TEST_F(LayerListTest, ArrangedLayersComeFirstInTheirOrder) {
  scene.update({1_s});
  EXPECT_FALSE(scene.update({1_s}));
  scene.arrangeLayers(std::vector<std::string>{"/c", "/unknown", "/a"});
  EXPECT_THAT(ids(scene), ElementsAre("/c", "/a", "/b"));
  EXPECT_TRUE(scene.update({1_s})) << "the order is seen where layers lie on one plane";
  EXPECT_FALSE(scene.update({1_s}));
  scene.arrangeLayers(std::vector<std::string>{"/c", "/a"});
  EXPECT_FALSE(scene.update({1_s}));
}

TEST_F(LayerListTest, AListMakesAnotherSceneTheSame) {
  scene.duplicateLayer(*scene.findLayer("/c")).title = "Thick";
  ASSERT_TRUE(scene.findLayer("/c#2")->layer->applySettings({{"size", "9"}}));
  scene.findLayer("/c")->layer->setVisible(false);
  scene.removeLayer("/b");
  scene.arrangeLayers(std::vector<std::string>{"/c#2"});
  const LayerList list = layerList(scene);

  Scene other(builder.raw(), test::fakeTypes(), *executor);
  other.addDefaultLayers();
  EXPECT_THAT(applyLayerList(list, other).waiting, IsEmpty());
  other.addDefaultLayers();
  EXPECT_EQ(layerList(other), list);
  EXPECT_THAT(ids(other), ElementsAre("/c#2", "/a", "/c"));
  EXPECT_EQ(other.findLayer("/c#2")->title, "Thick");
}

TEST_F(LayerListTest, AppliesWhatItCanAndSaysWhatNot) {
  const LayerList list{{{.id = "/gone", .title = "", .is_visible = true, .settings = {}},
                        {.id = "/b", .title = "", .is_visible = true, .settings = {{"size", "4"}, {"colour", "x"}}}},
                       {}};
  const AppliedLayers applied = applyLayerList(list, scene);
  ASSERT_EQ(applied.absent.size(), 1U);
  EXPECT_EQ(applied.absent[0].code, "UnknownTopic");
  ASSERT_EQ(applied.refused.size(), 1U);
  EXPECT_EQ(applied.refused[0].code, "UnknownSetting");
  EXPECT_THAT(applied.refused[0].message, HasSubstr("'/b'"));
  const LayerList again = layerList(scene, applied.waiting);
  EXPECT_EQ(again.layers.back(), list.layers[0]) << "what found no place is saved again";
  EXPECT_EQ(again.layers.front().settings.at("colour"), "x");
  EXPECT_EQ(again.layers.front().settings.at("size"), "4");
  EXPECT_EQ(size(scene, "/b"), "4");
  EXPECT_THAT(ids(scene), ElementsAre("/b", "/a", "/c")) << "what the list does not name stays";
}

TEST_F(LayerListTest, EveryLayerHasATitleAndCanBeHiddenByText) {
  LayerSlot& slot = *scene.findLayer("/a");
  ASSERT_TRUE(applyLayerSettings({{"title", "Lidar"}, {"visible", "off"}, {"size", "2"}}, slot));
  EXPECT_EQ(slot.title, "Lidar");
  EXPECT_FALSE(slot.layer->isVisible());
  EXPECT_EQ(size(scene, "/a"), "2");
  ASSERT_TRUE(applyLayerSettings({{"title", ""}}, slot));
  EXPECT_EQ(slot.title, "/a");
  EXPECT_FALSE(slot.layer->isVisible()) << "what is not named stays";
  EXPECT_EQ(applyLayerSettings({{"visible", "perhaps"}}, slot).error().code, "BadValue");
  EXPECT_FALSE(applyLayerSettings({{"title", "B"}, {"visible", "on"}, {"size", "x"}}, slot));
  EXPECT_EQ(slot.title, "/a");
  EXPECT_FALSE(slot.layer->isVisible()) << "on error nothing is changed";
}

}  // namespace
}  // namespace stillframe::scenegraph
