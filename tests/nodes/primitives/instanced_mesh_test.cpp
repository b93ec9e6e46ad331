#include "nodes/primitives/instanced_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scenegraph/buffer_patches.h"
#include "tests/nodes/scene_picture.h"
#include "tests/support/plain_viewer.h"

namespace stillframe::test {
namespace {

using nodes::Instance;
using nodes::InstancedMesh;
using nodes::makeInstance;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr scenegraph::Color kRed{.r = 0.8F, .g = 0.2F, .b = 0.1F, .a = 1.0F};
constexpr scenegraph::Color kGreen{.r = 0.0F, .g = 1.0F, .b = 0.0F, .a = 1.0F};
constexpr scenegraph::Color kBlack{.r = 0.0F, .g = 0.0F, .b = 0.0F, .a = 1.0F};

TEST(MakeInstance, PacksColoursInEightBits) {
  const Instance instance =
      makeInstance({}, glm::dvec3(1), glm::dvec3(0), {.r = 2.0F, .g = NAN, .b = 0.5F, .a = 0.25F});
  EXPECT_EQ(instance.rgb, static_cast<float>(0xff0080));
  EXPECT_EQ(instance.alpha, 0.25F);
}

TEST(MakeInstance, IsExactBesideAnOriginFarAway) {
  const glm::dvec3 far(4.5e6, -2.1e6, 3.9e6);
  const Instance instance = makeInstance({.translation = far + glm::dvec3(0.125, 0, 0.25)}, {1, 2, 3}, far, kRed);
  EXPECT_EQ(instance.local_from_mesh, (std::array<float, 12>{1, 0, 0, 0.125, 0, 2, 0, 0, 0, 0, 3, 0.25}));
}

TEST(MakeInstance, HasNoExtentWhereNumbersMakeNoSense) {
  for (const glm::dvec3 scale : {glm::dvec3(kNan, 1, 1), glm::dvec3(1, 1e300, 1), glm::dvec3(1, 1, HUGE_VAL)}) {
    const Instance instance = makeInstance({}, scale, glm::dvec3(0), kRed);
    EXPECT_EQ(instance.local_from_mesh, (std::array<float, 12>{}));
    EXPECT_EQ(instance.alpha, 0.0F);
  }
}

class InstancedPicture : public ScenePictureTest {
 protected:
  /// From above, 10 pixels a metre of 200 x 200.
  scenegraph::BytePicture look(const InstancedMesh& mesh, const scenegraph::CameraView& view = fromAbove()) {
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(&mesh.node());
    return scenegraph::toBytes(render(*root, view, {.width = 200, .height = 200, .background = kBlack}));
  }
  static Instance at(double x, double y, const glm::dvec3& size, const scenegraph::Color& color) {
    return makeInstance({.translation = {x, y, 0}}, size, glm::dvec3(0), color);
  }
};

TEST_F(InstancedPicture, DrawsEachCopyAtItsPlaceInItsColour) {
  InstancedMesh boxes(nodes::boxMesh(), "boxes");
  EXPECT_EQ(boxes.node().getNodeMask(), 0U) << "nothing to draw";
  boxes.resize(3);
  boxes.set(0, std::array{at(-5, 5, {2, 2, 2}, kRed), at(5, 5, {4, 1, 1}, kGreen)});
  boxes.commit();
  const auto picture = look(boxes);
  EXPECT_EQ(pixel(picture, 50, 50), (Bytes3{204, 51, 26})) << "what faces the eye keeps its colour";
  EXPECT_EQ(pixel(picture, 150, 50), (Bytes3{0, 255, 0}));
  EXPECT_EQ(drawnPixels(picture), 20 * 20 + 40 * 10) << "the third copy was never set";
  EXPECT_EQ(boxes.box(), osg::BoundingBoxd(-6, 4, -1, 7, 6, 1));
}

TEST_F(InstancedPicture, DrawsTheChangedCopiesAfterACommit) {
  InstancedMesh boxes(nodes::boxMesh(), "boxes");
  boxes.resize(100);
  for (std::size_t i = 0; i < 100; ++i) {
    const auto x = static_cast<double>(i % 10) - 4.5;
    const auto y = static_cast<double>(i / 10) - 4.5;
    boxes.set(i, std::array{at(x, y, glm::dvec3(0.5), kRed)});
  }
  boxes.commit();
  EXPECT_EQ(drawnPixels(look(boxes)), 100 * 25);
  boxes.set(99, std::array{at(8, 8, glm::dvec3(1), kGreen)});
  boxes.commit();
  auto picture = look(boxes);
  EXPECT_EQ(pixel(picture, 180, 20), (Bytes3{0, 255, 0}));
  EXPECT_EQ(drawnPixels(picture), 99 * 25 + 100);
  EXPECT_EQ(boxes.box().xMax(), 8.5);
  boxes.resize(98);
  boxes.commit();
  EXPECT_EQ(drawnPixels(look(boxes)), 98 * 25);
  EXPECT_EQ(boxes.box().xMax(), 4.75);
  boxes.resize(0);
  boxes.commit();
  EXPECT_EQ(boxes.node().getNodeMask(), 0U);
}

TEST_F(InstancedPicture, UploadsOnlyWhatChanged) {
  const osg::ref_ptr<osg::Group> root = new osg::Group;
  scenegraph::BufferPatches::hangOn(*root);
  InstancedMesh boxes(nodes::boxMesh(), "boxes");
  root->addChild(&boxes.node());
  const auto show = [&] {
    return scenegraph::toBytes(render(*root, fromAbove(), {.width = 200, .height = 200, .background = kBlack}));
  };
  boxes.resize(10'000);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    boxes.set(i, std::array{at(-9, -9, glm::dvec3(1), kRed)});
  }
  boxes.commit();
  EXPECT_EQ(drawnPixels(show()), 100);
  EXPECT_EQ(scenegraph::BufferPatches::find(*root)->uploadedBytes(), 0U) << "at first all goes the ordinary way";
  for (const std::size_t i : {7U, 5000U, 9999U}) {
    boxes.set(i, std::array{at(static_cast<double>(i) / 1000.0 - 5.0, 5, glm::dvec3(0.5), kGreen)});
  }
  boxes.commit();
  EXPECT_EQ(drawnPixels(show()), 100 + 3 * 25);
  EXPECT_EQ(scenegraph::BufferPatches::find(*root)->uploadedBytes(), 3 * sizeof(Instance));
  EXPECT_EQ(drawnPixels(show()), 100 + 3 * 25);
  EXPECT_EQ(scenegraph::BufferPatches::find(*root)->uploadedBytes(), 0U);
  boxes.hide(0, 10'000);
  boxes.commit();
  EXPECT_EQ(drawnPixels(show()), 0);
}

TEST_F(InstancedPicture, TapersFrustumsAtEitherEnd) {
  InstancedMesh frustums(nodes::frustumMesh(0.5F, 0.5F, 64), "frustums");
  frustums.resize(2);
  const scenegraph::CameraView view{.eye_from_fixed = scenegraph::lookAt({0, -10, 0}, {0, 0, 0}, {0, 0, 1}),
                                    .is_orthographic = true,
                                    .vertical_extent_m = 20.0};
  Instance up = at(-5, 0, {8, 8, 8}, kRed);
  up.taper = 0.0F;
  Instance down = at(5, 0, {8, 8, 8}, kRed);
  down.taper = 1.5F;
  frustums.set(0, std::array{up, down});
  frustums.commit();
  const auto picture = look(frustums, view);
  const auto widthAt = [&](int y, int from, int to) {
    int width = 0;
    for (int x = from; x < to; ++x) {
      width += pixel(picture, x, y)[0] > 0 ? 1 : 0;
    }
    return width;
  };
  EXPECT_NEAR(widthAt(62, 0, 100), 2, 2) << "the tip of the cone";
  EXPECT_NEAR(widthAt(138, 0, 100), 79, 2);
  EXPECT_NEAR(widthAt(62, 100, 200), 79, 2);
  EXPECT_NEAR(widthAt(138, 100, 200), 41, 2) << "half as wide below";
}

TEST_F(InstancedPicture, LightsMirroredUnevenAndFlatCopiesAlike) {
  InstancedMesh spheres(nodes::sphereMesh(48), "spheres");
  spheres.resize(4);
  spheres.set(0, std::array{at(-5, 5, {6, 6, 6}, kGreen), at(5, 5, {-6, 6, 6}, kGreen), at(-5, -5, {6, 6, -6}, kGreen),
                            at(5, -5, {6, 6, 0}, kGreen)});
  spheres.commit();
  const auto picture = look(spheres);
  for (const auto& [dx, dy] : {std::pair{0, 0}, {15, 7}, {-20, 10}}) {
    const Bytes3 expected = pixel(picture, 50 + dx, 50 + dy);
    EXPECT_NEAR(pixel(picture, 150 + dx, 50 + dy)[1], expected[1], 2);
    EXPECT_NEAR(pixel(picture, 50 + dx, 150 + dy)[1], expected[1], 2);
    EXPECT_EQ(pixel(picture, 150 + dx, 150 + dy)[1], 255) << "a flat one faces the eye everywhere";
  }
  EXPECT_LT(pixel(picture, 70, 60)[1], 240) << "the round ones are shaded";
}

TEST_F(InstancedPicture, BlendsWhatIsTranslucent) {
  InstancedMesh boxes(nodes::boxMesh(), "boxes");
  boxes.resize(2);
  scenegraph::Color glass = kGreen;
  glass.a = 0.5F;
  scenegraph::Color nothing = kGreen;
  nothing.a = 0.0F;
  boxes.set(0, std::array{at(0, 0, {2, 2, 2}, glass), at(5, 0, {2, 2, 2}, nothing)});
  boxes.setBlended(true);
  boxes.commit();
  const auto picture = look(boxes);
  EXPECT_EQ(drawnPixels(picture), 400);
  EXPECT_NEAR(pixel(picture, 100, 100)[1], 188, 2) << "half of its light, once";
}

TEST_F(InstancedPicture, IsTheSameInAPlainViewerAtAnEarthSizedOffset) {
  const glm::dvec3 place(4.5e6, -2.1e6, 3.9e6);
  InstancedMesh spheres(nodes::sphereMesh(), "spheres");
  spheres.setOrigin(place);
  spheres.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 centre = place + glm::dvec3(3.0 * static_cast<double>(i) - 3.0, 0, 0.01);
    spheres.set(i, std::array{makeInstance({.translation = centre}, glm::dvec3(2.0), place, i == 1 ? kRed : kGreen)});
  }
  spheres.commit();
  const osg::ref_ptr<osg::Group> root = new osg::Group;
  root->addChild(&spheres.node());
  const scenegraph::CameraView view{.eye_from_fixed =
                                        scenegraph::lookAt(place + glm::dvec3(2, -8, 5), place, {0, 0, 1})};
  const auto ours = scenegraph::toBytes(render(*root, view, {.width = 200, .height = 200, .background = kBlack}));
  EXPECT_GT(drawnPixels(ours), 3000);
  const osg::ref_ptr<osg::Node> back = exportedAndRead(*root);
  ASSERT_TRUE(back.valid());
  const auto differs = difference(ours, drawPlainly(*back, view, 0.1, 100.0, 200, 200, kBlack));
  EXPECT_EQ(differs.beyond_one, 0U) << "largest " << differs.largest;
  EXPECT_NEAR(back->getBound().radius(), root->getBound().radius(), 1e-2);
  EXPECT_NEAR((back->getBound().center() - root->getBound().center()).length(), 0.0, 1e-2);
  EXPECT_NEAR(root->getBound().radius(), std::sqrt(16.0 + 1.0 + 1.0), 0.3);
}

}  // namespace
}  // namespace stillframe::test
