// The id pass beside the picture: it costs nothing before it is asked, changes nothing, and knows what is meant.
#include <gtest/gtest.h>

#include <cmath>
#include <osg/Geometry>

#include "nodes/mesh_drawing/mesh_arrays.h"
#include "nodes/primitives/triangle_mesh.h"
#include "scenegraph/pipeline/id_pass.h"
#include "scenegraph/pipeline/id_program.h"
#include "scenegraph/pipeline/triangle_boxes.h"
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

/// 180,000 triangles over 18 m x 18 m, row by row; waves of half a metre.
nodes::TriangleMesh makeWaves() {
  constexpr std::uint32_t kCells = 300;
  nodes::TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= kCells; ++i) {
    for (std::uint32_t j = 0; j <= kCells; ++j) {
      const float x = -9.0F + 18.0F * static_cast<float>(i) / kCells;
      const float y = -9.0F + 18.0F * static_cast<float>(j) / kCells;
      mesh.positions.emplace_back(x, y, 0.25F * std::sin(2.0F * x) * std::cos(3.0F * y));
      mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
    }
  }
  for (std::uint32_t i = 0; i < kCells; ++i) {
    for (std::uint32_t j = 0; j < kCells; ++j) {
      const std::uint32_t at = i * (kCells + 1) + j;
      for (const std::uint32_t corner : {0U, kCells + 1, kCells + 2, 0U, kCells + 2, 1U}) {
        mesh.triangles.push_back(at + corner);
      }
    }
  }
  return mesh;
}

TEST_F(PickPass, FindsTheTriangleOfALargeMeshByTheBoxesOfItsRuns) {
  openCloud({onePoint(50, 50)});
  const nodes::MeshArrays arrays(makeWaves());
  const nodes::MeshState state;
  const osg::ref_ptr<osg::Group> node = arrays.makeNode({.r = 1, .g = 1, .b = 1, .a = 1});
  node->setStateSet(state.stateSet());
  scene_->frames().acquire("map").addChild(node);
  osg::Geometry& geometry = *node->getChild(0)->asGeometry();
  const auto& positions = dynamic_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
  const auto boxes = scenegraph::triangleBoxesOf(geometry).second;
  ASSERT_EQ(boxes.size(), (180'000U + 511) / 512);
  const osg::ref_ptr<osg::Referenced> known = geometry.getPrimitiveSet(0)->getUserData();

  // From above a pixel shows 0.1 m: its middle lies within the triangle that is told, whatever there is around it.
  draw(1_s, fromAbove());
  Random random(11);
  for (int i = 0; i < 60; ++i) {
    const int x = 12 + static_cast<int>(random.index(176));
    const int y = 12 + static_cast<int>(random.index(176));
    const auto hits = renderer_->pick(x, y, 0);
    ASSERT_EQ(hits.size(), 1U) << x << " " << y;
    const auto corners = scenegraph::triangleOf(geometry, hits[0].primitive);
    ASSERT_TRUE(corners);
    const double at_x = -10.0 + 0.1 * (x + 0.5);
    const double at_y = 10.0 - 0.1 * (y + 0.5);
    int left = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const osg::Vec3& from = positions[(*corners)[k]];
      const osg::Vec3& to = positions[(*corners)[(k + 1) % 3]];
      left += (to.x() - from.x()) * (at_y - from.y()) - (to.y() - from.y()) * (at_x - from.x()) > -1e-4 ? 1 : 0;
    }
    EXPECT_EQ(left, 3) << x << " " << y << " triangle " << hits[0].primitive;
  }
  // At an angle it is what is found without them, at the edges and beside it too.
  draw(1_s, {.eye_from_fixed = scenegraph::lookAt({-14, -6, 5}, {0, 0, 0}, {0, 0, 1})});
  int found = 0;
  for (int i = 0; i < 60; ++i) {
    const int x = static_cast<int>(random.index(200));
    const int y = static_cast<int>(random.index(200));
    const auto near = renderer_->pick(x, y);
    geometry.getPrimitiveSet(0)->setUserData(nullptr);
    const auto all = renderer_->pick(x, y);
    geometry.getPrimitiveSet(0)->setUserData(known.get());
    ASSERT_EQ(near.size(), all.size()) << x << " " << y;
    for (std::size_t k = 0; k < near.size(); ++k) {
      EXPECT_EQ(near[k].primitive, all[k].primitive);
      EXPECT_EQ(near[k].vertex, all[k].vertex);
      EXPECT_EQ(near[k].off_px, all[k].off_px);
    }
    found += near.empty() ? 0 : 1;
  }
  EXPECT_GT(found, 15);
  EXPECT_LT(found, 60);
  scene_->frames().node("map")->removeChild(node);
  scene_->frames().release("map");
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
