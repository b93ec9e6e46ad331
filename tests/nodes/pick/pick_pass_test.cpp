// The id pass beside the picture: it costs nothing before it is asked, changes nothing, and knows what is meant.
#include <gtest/gtest.h>

#include "scenegraph/pipeline/id_pass.h"
#include "scenegraph/pipeline/id_program.h"
#include "tests/nodes/pick/pick_picture.h"

namespace stillframe::test {
namespace {

using scenegraph::FieldType;
using scenegraph::IdDrawable;
using scenegraph::IdSample;
using scenegraph::ObjectType;
using scenegraph::PickError;

scenegraph::PointCloud onePoint(double x, double y) { return CloudBuilder("lidar").xyz().point({x, y, 0}).build(); }

class PickPass : public PickTest {
 protected:
  void openCloud(std::vector<scenegraph::PointCloud> clouds) {
    DatasetBuilder builder;
    builder.topic("/tf", ObjectType::FrameTransforms).transform(0, "map", "lidar");
    builder.topic("/points", ObjectType::PointCloud);
    std::int64_t second = 0;
    for (auto& cloud : clouds) {
      builder.at(++second * 1_s, std::move(cloud));
    }
    open(builder.build(), "map");
  }
};

TEST_F(PickPass, SaysSoWhereThereIsNothing) {
  openCloud({onePoint(0, 0)});
  add("/points");
  EXPECT_TRUE(renderer_->pick(100, 100).empty()) << "before the first picture";
  draw(1_s, fromAbove());
  EXPECT_EQ(pickAt(20, 20).error(), PickError::NothingThere);
  EXPECT_EQ(pickAt(100 + 12, 100).error(), PickError::NothingThere) << "beyond reach";
  EXPECT_TRUE(pickAt(100 + 7, 100));
  for (const auto& [x, y] : {std::pair{-1, 100}, {100, -1}, {200, 100}, {100, 200}, {-2000000000, 2000000000}}) {
    EXPECT_TRUE(renderer_->pick(x, y).empty());
  }
}

TEST_F(PickPass, PicksAtTheEdgesOfThePicture) {
  openCloud({onePoint(-9.95, 9.95)});
  add("/points");
  draw(1_s, fromAbove());
  EXPECT_TRUE(pickAt(0, 0));
  EXPECT_TRUE(pickAt(3, 0));
  EXPECT_FALSE(pickAt(199, 199));
}

TEST_F(PickPass, LeavesTheReferenceGridOutAndSeesWhatLiesBehindIt) {
  openCloud({onePoint(0, 0)});
  add("grid");
  draw(1_s, fromAbove());
  EXPECT_EQ(pickAt(100, 100).error(), PickError::NothingThere);
  add("/points");
  draw(1_s, fromAbove());
  EXPECT_EQ(pickAt(100, 100)->topic, "/points");
}

TEST_F(PickPass, ChangesNothingInThePicture) {
  openCloud({onePoint(0, 0)});
  add("/points", {{"point_size", "20"}});
  add("grid");
  const auto before = draw(1_s, fromAbove());
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(pickAt(98, 102));
    EXPECT_EQ(draw(1_s, fromAbove()).rgb, before.rgb);
  }
}

TEST_F(PickPass, SeesTheGraphAsItIsNow) {
  openCloud({onePoint(0, 0), onePoint(4, 0)});
  add("/points");
  draw(1_s, fromAbove());
  const auto stale = renderer_->pick(100, 100);
  EXPECT_EQ(stale.size(), 1U);
  scene_->update(tf::TimePoint{2_s});  // by a tick, without a frame
  EXPECT_FALSE(pickAt(100, 100));
  EXPECT_TRUE(pickAt(140, 100));
  scene_->findLayer("/points")->layer->setVisible(false);
  EXPECT_FALSE(pickAt(140, 100));
  scene_->findLayer("/points")->layer->setVisible(true);
  scene_->update(tf::TimePoint{2_s});
  EXPECT_TRUE(pickAt(140, 100));
  const auto hits = renderer_->pick(140, 100);
  scene_->removeLayer("/points");
  EXPECT_EQ(scenegraph::describeHits(*scene_, hits).error(), PickError::Undescribed)
      << "hits of a layer that is gone are nobody's";
  EXPECT_TRUE(renderer_->pick(140, 100).empty());
}

TEST_F(PickPass, DoesNotPickWhatIsBehindASurfaceButWhatLiesOnIt) {
  const std::vector<IdDrawable> drawables{{.path = {}, .eye_from_local = {}, .is_thin = true},
                                          {.path = {}, .eye_from_local = {}, .is_thin = false}};
  const auto sample = [](int dx, std::uint32_t drawable, float depth) {
    return IdSample{.dx = dx, .dy = 0, .drawable = drawable, .depth = depth};
  };
  // A point on a floor that rises away from the eye, another one behind its far edge.
  auto order = scenegraph::inOrderOfMeaning(
      {sample(0, 1, 0.5F), sample(1, 1, 0.4F), sample(3, 0, 0.45F), sample(2, 0, 0.3F)}, drawables);
  EXPECT_EQ(order.front().dx, 3);
  EXPECT_EQ(order[1].dx, 0);
  order = scenegraph::inOrderOfMeaning({sample(0, 1, 0.5F), sample(2, 0, 0.3F)}, drawables);
  EXPECT_EQ(order.front().dx, 0);
  // Nothing under the cursor: what is nearest.
  order = scenegraph::inOrderOfMeaning({sample(4, 1, 0.5F), sample(-3, 0, 0.3F)}, drawables);
  EXPECT_EQ(order.front().dx, -3);
  EXPECT_TRUE(scenegraph::inOrderOfMeaning({}, drawables).empty());
}

TEST(IdProgram, ReplacesWordsThatStandAlone) {
  EXPECT_EQ(scenegraph::replaceWord("void main() { remain(); main_(); }", "main", "sf"),
            "void sf() { remain(); main_(); }");
  EXPECT_EQ(scenegraph::replaceWord("", "main", "sf"), "");
}

}  // namespace
}  // namespace stillframe::test
