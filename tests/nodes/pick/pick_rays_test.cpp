// Voxels are picked by rays instead of being drawn again: both must answer alike, pixel for pixel.
#include <gtest/gtest.h>

#include <optional>
#include <osg/NodeVisitor>
#include <osg/Referenced>
#include <vector>

#include "scenegraph/pick/ray_target.h"
#include "tests/nodes/pick/pick_picture.h"
#include "tests/nodes/voxel_grid/voxel_builder.h"

namespace stillframe::nodes {
namespace {

using namespace tf::literals;
using scenegraph::FieldType;
using scenegraph::ObjectType;
using test::DatasetBuilder;
using test::VoxelBuilder;

/// Takes the rays from all drawables, so that the id pass draws them.
class RayRemover : public osg::NodeVisitor {
 public:
  RayRemover() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
  void apply(osg::Drawable& drawable) override {
    if (dynamic_cast<const scenegraph::RayTarget*>(drawable.getUserData()) != nullptr) {
      taken.emplace_back(&drawable, drawable.getUserData());
      drawable.setUserData(nullptr);
    }
  }
  void putBack() {
    for (const auto& [drawable, rays] : taken) {
      drawable->setUserData(rays);
    }
  }
  std::vector<std::pair<osg::ref_ptr<osg::Drawable>, osg::ref_ptr<osg::Referenced>>> taken;
};

class PickedRays : public test::PickTest {
 protected:
  static constexpr int kSide = 200;

  void show(scenegraph::VoxelGrid grid, const scenegraph::SettingTexts& settings = {}) {
    DatasetBuilder builder;
    builder.topic("/tf", ObjectType::FrameTransforms).transform(1_s, "map", "lidar", test::turn(0.4, -3.0, -2.0, -1.0));
    builder.topic("/voxels", ObjectType::VoxelGrid).at(1_s, std::move(grid));
    open(builder.build(), "map");
    add("/voxels", settings);
  }

  struct Answers {
    int same = 0;
    int other = 0;  ///< voxels
    int one_sided = 0;
  };
  /// What rays and the id pass say at random pixels, each without looking round.
  Answers compare(const scenegraph::CameraView& view) {
    draw(1_s, view, kSide, kSide);
    Answers answers;
    test::Random random(5);
    for (int i = 0; i < 60; ++i) {
      const int x = static_cast<int>(random.index(kSide));
      const int y = static_cast<int>(random.index(kSide));
      const auto by_ray = pickAt(x, y, 0);
      RayRemover remover;
      scene_->root().accept(remover);
      EXPECT_EQ(remover.taken.size(), 1U);
      const auto drawn = pickAt(x, y, 0);
      remover.putBack();
      if (by_ray.has_value() != drawn.has_value()) {
        ++answers.one_sided;
      } else if (by_ray) {
        ++(by_ray->picked.id == drawn->picked.id ? answers.same : answers.other);
      }
    }
    return answers;
  }
  void expectAlike(const scenegraph::CameraView& view, int least_hits) {
    const Answers answers = compare(view);
    EXPECT_GE(answers.same, least_hits);
    // The edge of a voxel may fall on the middle of a pixel; floats and doubles then differ.
    EXPECT_LE(answers.other, 1);
    EXPECT_LE(answers.one_sided, 1);
  }
  static scenegraph::CameraView from(const glm::dvec3& eye, const glm::dvec3& target) {
    return {.eye_from_fixed = scenegraph::lookAt(eye, target, {0, 0, 1}), .near_m = 0.01};
  }
};

/// Random rubble: about a fifth of the voxels is drawn.
VoxelBuilder rubble(std::uint32_t side) {
  return VoxelBuilder(side, side, side, 1)
      .frame("lidar")
      .cell({0.25, 0.3, 0.35})
      .field("cost", FieldType::Uint8, [](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        const std::uint32_t mixed = (x * 73'856'093U) ^ (y * 19'349'663U) ^ (z * 83'492'791U);
        return mixed % 5 == 0 ? 1.0 + mixed % 200 : 0.0;
      });
}

TEST_F(PickedRays, SayWhatThePictureShowsFromAnySide) {
  show(rubble(24).build());
  for (const glm::dvec3& eye : {glm::dvec3(12, 3, 9), glm::dvec3(-9, 8, -6), glm::dvec3(0, -14, 2)}) {
    expectAlike(from(eye, {0, 0, 2}), 14);
  }
}

TEST_F(PickedRays, SayWhatThePictureShowsFromWithin) {
  show(rubble(24).build());
  expectAlike(from({0.1, 0.2, 1.3}, {3, 2, 2}), 36);
  expectAlike(from({-1.03, 1.07, 2.21}, {-1.03, 1.07, -9}), 36);
}

TEST_F(PickedRays, SayWhatThePictureShowsWithoutPerspective) {
  show(rubble(24).build());
  expectAlike({.eye_from_fixed = scenegraph::lookAt({5, 4, 6}, {0, 0, 2}, {0, 0, 1}),
               .is_orthographic = true,
               .vertical_extent_m = 12.0},
              14);
}

TEST_F(PickedRays, HeedTheTestOfWhatIsDrawn) {
  show(rubble(24).build(), {{"draw_if", "range"}, {"draw_from", "150"}, {"draw_to", "170"}});
  expectAlike(from({12, 3, 9}, {0, 0, 2}), 7);
  ASSERT_TRUE(scene_->findLayer("/voxels")->layer->applySettings({{"draw_if", "all"}}));
  expectAlike(from({12, 3, 9}, {0, 0, 2}), 10);
}

TEST_F(PickedRays, OfASolidBlockMeetItsShell) {
  show(VoxelBuilder(40, 40, 40)
           .frame("lidar")
           .cell({0.1, 0.1, 0.1})
           .field("x", FieldType::Uint8, [](auto, auto, auto) { return 1.0; })
           .build());
  expectAlike(from({9, 2, 5}, {0, 0, 1}), 7);
  draw(1_s, from({-1, 0, 1}, {3, 0, 1}), kSide, kSide);
  EXPECT_FALSE(pickAt(100, 100, 0)) << "from within a block nothing of it is seen";
}

TEST_F(PickedRays, OfWhatHasNoOpacityMeetNothing) {
  show(rubble(12).build());
  draw(1_s, from({12, 3, 9}, {0, 0, 2}), kSide, kSide);
  std::optional<std::pair<int, int>> place;
  for (int y = 60; y < 140 && !place; ++y) {
    for (int x = 60; x < 140 && !place; ++x) {
      if (pickAt(x, y, 0)) {
        place = {x, y};
      }
    }
  }
  ASSERT_TRUE(place);
  ASSERT_TRUE(scene_->findLayer("/voxels")->layer->applySettings({{"opacity", "0"}}));
  draw(1_s, from({12, 3, 9}, {0, 0, 2}), kSide, kSide);
  EXPECT_FALSE(pickAt(place->first, place->second, 0)) << "what has no opacity is not seen";
}

}  // namespace
}  // namespace stillframe::nodes
