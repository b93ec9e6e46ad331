#include "scenegraph/passes/dither.h"

#include "scenegraph/export/picture_io.h"
#include "tests/scenegraph/passes/pass_scene.h"

namespace stillframe::scenegraph {
namespace {

float linearFromSrgb(double srgb) {
  return static_cast<float>(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
}

class DitherTest : public PassTest {
 protected:
  static PostChain ditherChain() {
    PostChain chain;
    appendDither({}, chain);
    return chain;
  }
};

TEST_F(DitherTest, LeavesEveryByteAsItIs) {
  std::vector<osg::Vec4> colors;
  for (int value = 0; value < 256; ++value) {
    const float light = linearFromSrgb(value / 255.0);
    colors.emplace_back(light, light, light, 1.0F);
  }
  root_->addChild(makeRow(colors));
  const BytePicture plain = toBytes(draw(lookAcross(256, 16), 256, 16, {}));
  EXPECT_EQ(plain.rgb[3 * 200], 200);
  EXPECT_EQ(toBytes(draw(lookAcross(256, 16), 256, 16, ditherChain())), plain);
}

TEST_F(DitherTest, TakesTheBandsOutOfAGradient) {
  // Two steps of bytes over the whole width: without dithering three bands.
  constexpr int kWidth = 128;
  const auto worst = [&](const BytePicture& picture) {
    double largest = 0.0;
    for (int left = 0; left + 16 <= kWidth; left += 16) {
      double sum = 0.0;
      for (int y = 0; y < picture.height; ++y) {
        for (int x = left; x < left + 16; ++x) {
          sum += picture.rgb[static_cast<std::size_t>(y * kWidth + x) * 3] - (100.0 + 2.0 * x / kWidth);
        }
      }
      largest = std::max(largest, std::abs(sum / (16.0 * picture.height)));
    }
    return largest;
  };
  const osg::Vec4 left(linearFromSrgb(100.0 / 255.0), linearFromSrgb(100.0 / 255.0), linearFromSrgb(100.0 / 255.0),
                       0.0F);
  const osg::Vec4 right(linearFromSrgb(102.0 / 255.0), linearFromSrgb(102.0 / 255.0), linearFromSrgb(102.0 / 255.0),
                        0.0F);
  root_->addChild(
      makeRawShape(GL_QUADS, {{0, -8, 0}, {kWidth, -8, 0}, {kWidth, 8, 0}, {0, 8, 0}}, {left, right, right, left}));
  const double plain = worst(toBytes(draw(lookAcross(kWidth, 16), kWidth, 16, {})));
  const double dithered = worst(toBytes(draw(lookAcross(kWidth, 16), kWidth, 16, ditherChain())));
  EXPECT_GT(plain, 0.3);
  EXPECT_LT(dithered, 0.1);
}

}  // namespace
}  // namespace stillframe::scenegraph
