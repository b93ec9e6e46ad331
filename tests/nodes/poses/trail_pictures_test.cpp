#include <gmock/gmock.h>

#include "tests/nodes/poses/poses_picture.h"

namespace stillframe::test {
namespace {

using scenegraph::ObjectType;
using scenegraph::PosesKind;
using scenegraph::SettingTexts;
using testing::HasSubstr;

/// 20 poses, one a second from 1 s on: the sixth cannot be decoded, the last five are in another frame.
std::shared_ptr<scenegraph::Dataset> drive() {
  DatasetBuilder builder;
  builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "base").transform(0, "map", "other");
  builder.topic("/odom", ObjectType::PosesInFrame);
  for (int i = 0; i < 20; ++i) {
    if (i == 5) {
      builder.failsAt((1 + i) * 1_s, "BadChunk");
    } else {
      builder.at((1 + i) * 1_s, posesOf(PosesKind::Single, {translate(-9 + i, i % 3, 0)}, i < 15 ? "map" : "/other"));
    }
  }
  return builder.build();
}

TEST_F(PosesPicture, TrailsThePosesBeforeByNumberOrTime) {
  open(drive(), "map");
  layer_ = &add("/odom", {{"trail", "poses"}, {"trail_poses", "4"}, {"shape", "none"}});
  draw(4_s + 1, fromAbove());
  EXPECT_EQ(count("trail"), 4U);
  EXPECT_EQ(count("segments"), 3U);
  EXPECT_EQ(layer_->status(), scenegraph::Status{});
  draw(8_s, fromAbove());
  EXPECT_EQ(count("trail"), 3U);
  EXPECT_EQ(layer_->status().code, "TrailUndecodable");
  ASSERT_TRUE(layer_->applySettings({{"trail", "seconds"}, {"trail_seconds", "1.5"}}));
  draw(4_s + 500'000'000, fromAbove());
  EXPECT_EQ(count("trail"), 2U) << "of the pose shown, not of the tick";
  ASSERT_TRUE(layer_->applySettings({{"trail_seconds", "1e9"}}));
  draw(10_s, fromAbove());
  EXPECT_EQ(count("trail"), 9U);
  ASSERT_TRUE(layer_->applySettings({{"trail", "all"}, {"trail_shapes", "true"}, {"shape", "arrows"}}));
  draw(20_s, fromAbove());
  EXPECT_EQ(count("trail"), 5U);
  EXPECT_EQ(count("shapes"), 5U);
  EXPECT_EQ(layer_->status().code, "TrailInOtherFrames");
  EXPECT_THAT(layer_->status().message, HasSubstr("14 poses"));
}

TEST_F(PosesPicture, TrailsDoNotDependOnThePath) {
  const SettingTexts settings{
      {"trail", "poses"}, {"trail_poses", "6"}, {"trail_shapes", "true"}, {"color_field", "time"}};
  const auto dataset = drive();
  open(dataset, "map");
  layer_ = &add("/odom", settings);
  Random random(11);
  for (int i = 0; i < 12; ++i) {
    const auto time = static_cast<std::int64_t>(random.number(0, 21) * 1e9);
    const auto walked = draw(time, fromAbove());
    const auto counts = layer_->counts();
    const auto status = layer_->status();
    auto walked_scene = std::move(scene_);
    open(drive(), "map");
    const auto& fresh = add("/odom", settings);
    EXPECT_EQ(draw(time, fromAbove()).rgb, walked.rgb) << time;
    EXPECT_EQ(fresh.counts(), counts) << time;
    EXPECT_EQ(fresh.status(), status) << time;
    scene_ = std::move(walked_scene);
    dataset_ = dataset;
  }
}

}  // namespace
}  // namespace stillframe::test
