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

  /// Nothing that a frame would take to the driver was written since `before`.
  void expectUntouchedSince(const GraphWrites& before) {
    const GraphWrites after(scene_->root());
    EXPECT_EQ(after.uniforms, before.uniforms);
    EXPECT_EQ(after.arrays, before.arrays);
    EXPECT_EQ(after.addresses, before.addresses);
  }
};

TEST_F(StillTicks, WriteNothingWhereNothingMoved) {
  openClouds({{"color_field", "intensity"}});
  const GraphWrites before(scene_->root());
  EXPECT_GT(before.uniforms, 0U);
  scene_->update(tf::TimePoint{1_s + 1_ms});  // another time, and the same samples of everything
  EXPECT_EQ(scene_->frames().lastTick().matrices_written, 0U);
  EXPECT_EQ(scene_->frames().lastTick().masks_changed, 0U);
  expectUntouchedSince(before);
}

TEST_F(StillTicks, WriteOneMatrixWhereOneFrameMoved) {
  openClouds({{"color_field", "intensity"}});
  const GraphWrites before(scene_->root());
  scene_->update(tf::TimePoint{2_s});
  EXPECT_EQ(scene_->frames().lastTick().matrices_written, 1U);
  expectUntouchedSince(before);
}

TEST_F(StillTicks, WriteOneUniformWhereAnAxisGivesTheColour) {
  openClouds({{"color_field", "z"}, {"range_mode", "manual"}, {"range_min", "-5"}, {"range_max", "5"}});
  const GraphWrites before(scene_->root());
  scene_->update(tf::TimePoint{2_s});
  EXPECT_EQ(GraphWrites(scene_->root()).uniforms, before.uniforms + 1) << "the height of the one that moved";
}

TEST_F(StillTicks, ShowingWhatWasMaskedOffIsNoWrite) {
  // The first frame is at the origin of its parent at 0 s and leaves it: the line between them comes and goes.
  openClouds({{"color_field", "intensity"}});
  add("tf");
  scene_->update(tf::TimePoint{1_s});
  scene_->update(tf::TimePoint{0});
  const GraphWrites before(scene_->root());
  scene_->update(tf::TimePoint{2_s});
  EXPECT_EQ(scene_->frames().lastTick().matrices_written, 1U);
  expectUntouchedSince(before);
}

TEST_F(StillTicks, AWriteBeneathAMaskedNodeCounts) {
  openClouds({{"color_field", "intensity"}});
  osg::ref_ptr<osg::Group> masked = new osg::Group;
  masked->getOrCreateStateSet()->addUniform(new osg::Uniform("u_test", 1.0F));
  masked->setNodeMask(0U);
  scene_->root().addChild(masked);
  scene_->root().addChild(masked);
  const GraphWrites before(scene_->root());
  masked->getStateSet()->getUniform("u_test")->set(2.0F);
  EXPECT_EQ(GraphWrites(scene_->root()).uniforms, before.uniforms + 1) << "once, wherever it hangs";
}

TEST_F(StillTicks, LinesLeadToTheParentAtEveryTime) {
  openClouds({{"color_field", "intensity"}});
  add("tf");
  for (const int second : {0, 3, 1, 1, 4}) {
    scene_->update(tf::TimePoint{second * 1_s});
    const osg::MatrixTransform* const frame = scene_->frames().node("frame0");
    const osg::Group* const tf =
        frame->getChild(0)->getName() == "tf" ? frame->getChild(0)->asGroup() : frame->getChild(1)->asGroup();
    const auto* const line = dynamic_cast<const osg::MatrixTransform*>(tf->getChild(1));
    ASSERT_NE(line, nullptr);
    const osg::Vec3d parent_in_frame = osg::Vec3d(1, 0, 0) * line->getMatrix();
    EXPECT_EQ(line->getNodeMask() != 0U, second > 0);
    if (second > 0) {
      EXPECT_LT((parent_in_frame - osg::Vec3d(0, -0.1 * second, -0.2 * second)).length(), 1e-12) << second;
    }
  }
}

}  // namespace
}  // namespace stillframe::test
