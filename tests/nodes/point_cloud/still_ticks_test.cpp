// What a tick leaves alone: counted in the graph itself, whoever might have touched it.
#include "tests/nodes/scene_picture.h"
#include "tools/bench/graph_writes.h"

namespace stillframe::test {
namespace {

using bench::GraphWrites;
using scenegraph::ObjectType;

constexpr int kLayers = 12;

class StillTicks : public ScenePictureTest {
 protected:
  /// Clouds in frames of their own, each with a message for all time; the first frame moves each second.
  void openClouds(const scenegraph::SettingTexts& settings) {
    DatasetBuilder builder;
    builder.topic("/tf", ObjectType::FrameTransforms);
    for (int i = 0; i < kLayers; ++i) {
      for (int second = 0; second < (i == 0 ? 5 : 1); ++second) {
        builder.transform(second * 1_s, "map", "frame" + std::to_string(i),
                          {.translation = {1.0 * i, 0.1 * second, 0.2 * second}});
      }
    }
    for (int i = 0; i < kLayers; ++i) {
      CloudBuilder cloud("frame" + std::to_string(i));
      cloud.xyz().field("intensity", scenegraph::FieldType::Float32);
      cloud.point({0, 0, 0, 1}).point({1, 0, 1, 2});
      builder.topic("/points" + std::to_string(i), ObjectType::PointCloud).at(0, cloud.build());
    }
    open(builder.build(), "map");
    for (int i = 0; i < kLayers; ++i) {
      add("/points" + std::to_string(i), settings);
    }
    scene_->update(tf::TimePoint{1_s});
    scene_->update(tf::TimePoint{1_s});
  }
};

TEST_F(StillTicks, WriteNothingWhereNothingMoved) {
  openClouds({{"color_field", "intensity"}});
  const GraphWrites before(scene_->root());
  EXPECT_GT(before.uniforms, 0U);
  scene_->update(tf::TimePoint{1_s + 1_ms});  // another time, and the same samples of everything
  const GraphWrites after(scene_->root());
  EXPECT_EQ(scene_->frames().lastTick().matrices_written, 0U);
  EXPECT_EQ(scene_->frames().lastTick().masks_changed, 0U);
  EXPECT_EQ(after.uniforms, before.uniforms);
  EXPECT_EQ(after.arrays, before.arrays);
  EXPECT_EQ(after.addresses, before.addresses);
}

TEST_F(StillTicks, WriteOneMatrixWhereOneFrameMoved) {
  openClouds({{"color_field", "intensity"}});
  const GraphWrites before(scene_->root());
  scene_->update(tf::TimePoint{2_s});
  const GraphWrites after(scene_->root());
  EXPECT_EQ(scene_->frames().lastTick().matrices_written, 1U);
  EXPECT_EQ(after.uniforms, before.uniforms);
  EXPECT_EQ(after.arrays, before.arrays);
}

TEST_F(StillTicks, WriteOneUniformWhereAnAxisGivesTheColour) {
  openClouds({{"color_field", "z"}, {"range_mode", "manual"}, {"range_min", "-5"}, {"range_max", "5"}});
  const GraphWrites before(scene_->root());
  scene_->update(tf::TimePoint{2_s});
  EXPECT_EQ(GraphWrites(scene_->root()).uniforms, before.uniforms + 1) << "the height of the one that moved";
}

}  // namespace
}  // namespace stillframe::test
