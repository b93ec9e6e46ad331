#include "scenegraph/pipeline/transparency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <osg/MatrixTransform>
#include <random>
#include <vector>

#include "scenegraph/blending.h"
#include "tests/scenegraph/pipeline/shader_scene.h"
#include "tests/support/offscreen_test.h"

namespace stillframe::scenegraph {
namespace {

using Names = std::vector<std::string>;

float linearFromSrgb(float srgb) { return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F); }

osg::ref_ptr<osg::Geode> blended(const osg::ref_ptr<osg::Geode>& shape) {
  setBlended(*shape->getDrawable(0)->getOrCreateStateSet(), true);
  return shape;
}

/// A horizontal square around (x, y), seen from above.
struct Pane {
  float x = 0.0F;
  float y = 0.0F;
  float half = 1.0F;
  float z = 0.0F;
  osg::Vec4 color = {};

  [[nodiscard]] osg::ref_ptr<osg::Node> node() const {
    const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd::translate(x, y, 0.0));
    place->addChild(blended(makeQuad(half, half, z, color)));
    return place;
  }
};

std::vector<Pane> randomPanes(int count, unsigned seed, float least_alpha = 0.05F) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::vector<Pane> panes;
  for (int i = 0; i < count; ++i) {
    Pane pane{.x = 2.0F * unit(random) - 1.0F, .y = 2.0F * unit(random) - 1.0F, .half = 0.3F + unit(random)};
    pane.z = 0.02F * static_cast<float>(i);
    pane.color = {unit(random), unit(random), unit(random), least_alpha + (0.9F - least_alpha) * unit(random)};
    panes.push_back(pane);
  }
  std::ranges::shuffle(panes, random);
  return panes;
}

class TransparencyTest : public test::OffscreenTest {
 protected:
  /// From above, 2 x 2 metres, no perspective.
  Picture draw(const std::vector<osg::ref_ptr<osg::Node>>& nodes, int size = 48, const PostChain& post = {},
               const BlendLimits& blend = {}) {
    const osg::ref_ptr<osg::Group> root = new osg::Group;
    for (const auto& node : nodes) {
      root->addChild(node);
    }
    CameraView view{.eye_from_fixed = lookAt({0, 0, 10}, {0, 0, 0}, {0, 1, 0})};
    view.is_orthographic = true;
    view.vertical_extent_m = 2.0;
    return render(*root, view,
                  {.width = size, .height = size, .background = {0, 0, 0, 1}, .post = post, .blend = blend});
  }
  Picture draw(const std::vector<Pane>& panes, int size = 48, const BlendLimits& blend = {}) {
    std::vector<osg::ref_ptr<osg::Node>> nodes;
    for (const Pane& pane : panes) {
      nodes.push_back(pane.node());
    }
    return draw(nodes, size, {}, blend);
  }
};

float largestDifference(const Picture& a, const Picture& b) {
  float largest = 0.0F;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    largest = std::max(largest, std::abs(a.rgba[i] - b.rgba[i]));
  }
  return largest;
}

/// What painting from far to near gives at the middles of pixels; NaN where an edge may pass.
std::vector<float> painted(std::vector<Pane> panes, int size) {
  std::ranges::sort(panes, {}, &Pane::z);
  std::vector<float> rgb;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const float x = (static_cast<float>(column) + 0.5F) / static_cast<float>(size) * 2.0F - 1.0F;
      const float y = 1.0F - (static_cast<float>(row) + 0.5F) / static_cast<float>(size) * 2.0F;
      std::array<float, 3> light{};
      for (const Pane& pane : panes) {
        const float off = std::max(std::abs(x - pane.x), std::abs(y - pane.y)) - pane.half;
        if (std::abs(off) < 0.01F) {
          light.fill(std::nanf(""));
        } else if (off < 0.0F) {
          for (int i = 0; i < 3; ++i) {
            float& channel = light[static_cast<std::size_t>(i)];
            channel += (linearFromSrgb(pane.color[i]) - channel) * pane.color.w();
          }
        }
      }
      rgb.insert(rgb.end(), light.begin(), light.end());
    }
  }
  return rgb;
}

float largestError(const Picture& picture, const std::vector<float>& rgb) {
  float largest = 0.0F;
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const float error = std::abs(picture.rgba[i / 3 * 4 + i % 3] - rgb[i]);
    largest = std::isnan(rgb[i]) ? largest : std::max(largest, error);
  }
  return largest;
}

TEST_F(TransparencyTest, SceneWithoutBlendedThingsHasNoSuchPass) {
  draw({makeQuad(1, 1, 0, {1, 0, 0, 1})});
  EXPECT_EQ(renderer_->lastFrame().passes, (Names{"scene"}));
  draw({blended(makeQuad(1, 1, 0, {1, 0, 0, 0.5}))});
  EXPECT_EQ(renderer_->lastFrame().passes, (Names{"scene", "transparency"}));
}

TEST_F(TransparencyTest, PanesInAnyOrderComeOutAsPaintedFromFarToNear) {
  for (const int count : {1, 2, 7, 16, 17, 40}) {
    const std::vector<Pane> panes = randomPanes(count, static_cast<unsigned>(count));
    EXPECT_LT(largestError(draw(panes), painted(panes, 48)), 2e-3F) << count << " panes";
  }
}

TEST_F(TransparencyTest, OrderOfLayersChangesNoBitOfAnyPixel) {
  std::vector<Pane> panes = randomPanes(30, 5);
  // Some lie in one plane with others, one twice in the same place.
  for (std::size_t i = 0; i < 8; ++i) {
    panes[i].z = 0.1F;
  }
  panes.push_back(panes.front());
  const Picture first = draw(panes);
  std::mt19937 random(1);
  for (int i = 0; i < 8; ++i) {
    std::ranges::shuffle(panes, random);
    const Picture other = draw(panes);
    EXPECT_TRUE(first.rgba == other.rgba) << largestDifference(first, other);
    EXPECT_TRUE(first.depth_m == other.depth_m);
  }
}

TEST_F(TransparencyTest, PanesThroughEachOtherShowTheNearerOneOnEitherSide) {
  const osg::Vec4 red(1, 0, 0, 0.5);
  const osg::Vec4 blue(0, 0, 1, 0.5);
  const auto falling = [](float left, float right, const osg::Vec4& color) {
    return blended(
        makeShape(GL_TRIANGLE_STRIP, {{-1, -1, left}, {1, -1, right}, {-1, 1, left}, {1, 1, right}}, {color}));
  };
  const Picture picture = draw({falling(1, 0, red), falling(0, 1, blue)});
  const Picture swapped = draw({falling(0, 1, blue), falling(1, 0, red)});
  EXPECT_TRUE(picture.rgba == swapped.rgba);
  const auto pixel = [&](std::size_t column) { return &picture.rgba[(24 * 48 + column) * 4]; };
  EXPECT_NEAR(pixel(4)[0], 0.5F, 1e-3F);
  EXPECT_NEAR(pixel(4)[2], 0.25F, 1e-3F);
  EXPECT_NEAR(pixel(43)[0], 0.25F, 1e-3F);
  EXPECT_NEAR(pixel(43)[2], 0.5F, 1e-3F);
}

TEST_F(TransparencyTest, OpaqueThingsHideWhatLiesBehindThemAndShowThroughWhatLiesBefore) {
  const Picture picture = draw({blended(makeQuad(1, 1, 2, {0, 1, 0, 0.25})), makeQuad(1, 1, 1, {1, 1, 1, 1}),
                                blended(makeQuad(1, 1, 0, {1, 0, 0, 0.9F}))});
  EXPECT_NEAR(picture.rgba[0], 0.75F, 1e-3F);
  EXPECT_NEAR(picture.rgba[1], 1.0F, 1e-3F);
  EXPECT_EQ(picture.rgba[3], 1.0F);
  EXPECT_NEAR(picture.depth_m[0], 8.0F, 1e-3F);  // of the nearest
}

TEST_F(TransparencyTest, FragmentsBeyondThoseInOrderCountByTheirMeanWhateverTheirOrder) {
  std::vector<Pane> panes = randomPanes(120, 9, 0.001F);
  for (Pane& pane : panes) {
    pane.half = 3.0F;
    pane.color.w() = 0.01F;
  }
  const Picture first = draw(panes, 16);
  std::ranges::shuffle(panes, std::mt19937(2));
  EXPECT_LT(largestDifference(first, draw(panes, 16)), 1e-3F);
  EXPECT_LT(largestError(first, painted(panes, 16)), 0.02F);
  // Nothing in order: the mean of all, which hides as much.
  const Picture weighted = draw(panes, 16, {.most_sorted = 0});
  EXPECT_LT(largestError(weighted, painted(panes, 16)), 0.06F);
  EXPECT_GT(largestDifference(first, weighted), 1e-3F);
}

TEST_F(TransparencyTest, ListsGrowWithTheirFragmentsWithinTheFrame) {
  std::vector<Pane> panes = randomPanes(20, 3);  // 256 x 256 x 20: five times what lists begin with
  for (Pane& pane : panes) {
    pane.half = 3.0F;
  }
  EXPECT_LT(largestError(draw(panes, 256), painted(panes, 256)), 2e-3F);
}

TEST_F(TransparencyTest, FragmentsBeyondTheMemoryForThemAreDrawnInBandsBitForBit) {
  std::vector<Pane> panes = randomPanes(20, 3);
  panes.resize(14);
  panes.push_back(
      {.y = -0.7F, .half = 0.2F, .z = -1.0F, .color = {1, 1, 1, 0.3F}});  // rows differ in how much they have
  const Picture whole = draw(panes, 96);
  EXPECT_EQ(renderer_->lastFrame().blended_bands, 1);
  int bands = 1;
  for (const std::uint32_t room : {1U << 15U, 1U << 13U, 1U << 11U}) {
    const Picture banded = draw(panes, 96, {.most_fragments = room});
    EXPECT_GT(renderer_->lastFrame().blended_bands, bands) << room;
    bands = renderer_->lastFrame().blended_bands;
    EXPECT_TRUE(whole.rgba == banded.rgba) << room << " off by " << largestDifference(whole, banded);
    EXPECT_TRUE(whole.depth_m == banded.depth_m) << room;
  }
  EXPECT_LT(largestError(whole, painted(panes, 96)), 2e-3F);
}

TEST_F(TransparencyTest, ARowWithMoreThanThereIsRoomForLeavesOutWhatIsTooMuchAndNothingElse) {
  std::vector<Pane> panes(40, {.half = 3.0F, .color = {0, 1, 0, 0.5F}});  // 96 x 40 in a row, room for 2048
  for (std::size_t i = 0; i < panes.size(); ++i) {
    panes[i].z = 0.02F * static_cast<float>(i);
  }
  const Picture picture = draw(panes, 96, {.most_fragments = 1});
  EXPECT_TRUE(std::ranges::all_of(picture.rgba, [](float value) { return value >= 0.0F && value <= 1.0F; }));
}

TEST_F(TransparencyTest, SamplesOfAPixelAreEachPutInOrder) {
  const std::vector<Pane> panes{{.x = -1.0F, .half = 0.99F, .color = {1, 1, 1, 0.5F}},
                                {.half = 2.0F, .z = 1.0F, .color = {1, 0, 0, 0.5F}}};
  PostChain four;
  four.msaa_samples = 4;
  const Picture picture = draw({panes[0].node(), panes[1].node()}, 48, four);
  if (renderer_->lastFrame().samples < 4) {
    return;  // the driver has none
  }
  const auto green = [&](std::size_t column) { return picture.rgba[(24 * 48 + column) * 4 + 1]; };
  EXPECT_NEAR(green(20), 0.25F, 1e-3F);
  EXPECT_NEAR(green(30), 0.0F, 1e-3F);
  EXPECT_GT(green(23), 0.01F);  // the edge passes through this pixel
  EXPECT_LT(green(23), 0.24F);
}

TEST_F(TransparencyTest, AlphaOutOfRangeAndNotANumberLeaveThePictureFinite) {
  const float nan = std::nanf("");
  const Picture picture = draw({blended(makeQuad(1, 1, 0, {1, 0, 0, nan})), blended(makeQuad(1, 1, 1, {0, 1, 0, -1})),
                                blended(makeQuad(1, 1, 2, {0, 0, 1, 0.5})), blended(makeQuad(1, 1, -1, {1, 1, 1, 7}))});
  EXPECT_TRUE(std::ranges::all_of(picture.rgba, [](float value) { return std::isfinite(value); }));
  EXPECT_NEAR(picture.rgba[2], 1.0F, 1e-2F);
}

}  // namespace
}  // namespace stillframe::scenegraph
