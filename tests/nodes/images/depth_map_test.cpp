#include "nodes/images/depth_map.h"

#include <gmock/gmock.h>

#include <bit>
#include <limits>

#include "nodes/images/color_image.h"
#include "tests/nodes/images/compressed_builder.h"

namespace stillframe::test {
namespace {

using nodes::decodeColor;
using nodes::decodeDepth;
using nodes::DepthMap;
using nodes::ImageFault;
using scenegraph::Image;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr float kHole = DepthMap::kHole;

TEST(DepthMap, ReadsMillimetresAndCountsHoles) {
  for (const char* encoding : {"16UC1", "mono16"}) {
    const auto map = decodeDepth(makeImage<std::uint16_t>("f", encoding, 2, {1, 0, 1500, 65535}));
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_THAT(map->metres, ElementsAre(0.001F, kHole, 1.5F, 65.535F));
    EXPECT_EQ(map->valid, 3U);
    EXPECT_EQ(map->nearest_m, 0.001F);
    EXPECT_EQ(map->farthest_m, 65.535F);
  }
}

TEST(DepthMap, ReadsMetresAndTakesNanInfinityAndNegativesForHoles) {
  using Limits = std::numeric_limits<float>;
  const auto map = decodeDepth(makeImage<float>(
      "f", "32FC1", 7, {0.25F, Limits::quiet_NaN(), Limits::infinity(), -1.0F, 0.0F, Limits::max(), 9.0F}));
  ASSERT_TRUE(map);
  EXPECT_THAT(map->metres, ElementsAre(0.25F, kHole, kHole, kHole, kHole, kHole, 9.0F));
  EXPECT_EQ(map->valid, 2U);
}

TEST(DepthMap, ReadsBothByteOrdersAndPaddedRows) {
  Image image = makeImage<std::uint16_t>("f", "16UC1", 3,
                                         {std::byteswap(std::uint16_t{1000}), std::byteswap(std::uint16_t{2}), 9,
                                          std::byteswap(std::uint16_t{3000}), std::byteswap(std::uint16_t{4}), 9});
  image.width = 2;
  image.is_bigendian = true;
  image.data.bytes = image.data.bytes.first(10);  // the last row's padding is not sent
  const auto map = decodeDepth(image);
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_THAT(map->metres, ElementsAre(1.0F, 0.002F, 3.0F, 0.004F));
}

TEST(DepthMap, ReadsCompressedDepthOfBothKinds) {
  const std::vector<std::uint16_t> values = {0, 0, 1000, 1003, 998, 0, 65535, 1, 0};
  for (const auto& body : {sample::writeGrayPng(3, values), sample::writeRvl(3, values)}) {
    const auto map = decodeDepth(compressedDepth(body));
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_EQ(map->width, 3U);
    EXPECT_EQ(map->height, 3U);
    EXPECT_THAT(map->metres, ElementsAre(kHole, kHole, 1.0F, 1.003F, 0.998F, kHole, 65.535F, 0.001F, kHole));
    // Depth is A / (value - B).
    const auto inverse = decodeDepth(compressedDepth(body, "32FC1", 2000.0F, 0.5F));
    ASSERT_TRUE(inverse);
    EXPECT_FLOAT_EQ(inverse->metres[2], 2000.0F / 999.5F);
    EXPECT_EQ(inverse->metres[0], kHole);
  }
}

TEST(DepthMap, RefusesWhatItsSizesDoNotHold) {
  const auto codeOf = [](Image image, auto change) {
    change(image);
    const auto map = decodeDepth(image);
    return map ? std::string("Ok") : std::string(toString(map.error().code));
  };
  const Image good = makeImage<std::uint16_t>("f", "16UC1", 2, {1, 2, 3, 4});
  EXPECT_EQ(codeOf(good, [](Image&) {}), "Ok");
  EXPECT_EQ(codeOf(good, [](Image& image) { image.data.bytes = image.data.bytes.first(7); }), "TruncatedImage");
  EXPECT_EQ(codeOf(good, [](Image& image) { image.row_step = 3; }), "BadImageSize");
  EXPECT_EQ(codeOf(good, [](Image& image) { image.width = 0; }), "BadImageSize");
  EXPECT_EQ(codeOf(good, [](Image& image) { image.height = 3; }), "TruncatedImage");
  EXPECT_EQ(codeOf(good, [](Image& image) { image.width = image.height = 0xFFFF'FFFF; }), "BadImageSize");
  EXPECT_EQ(codeOf(good, [](Image& image) { image.width = image.height = image.row_step = 0xFFFF'FFFF; }),
            "BadImageSize");
  EXPECT_EQ(codeOf(good,
                   [](Image& image) {
                     image.width = image.height = 0x8000'0000;
                     image.row_step = 0;
                   }),
            "ImageTooLarge");
  EXPECT_EQ(codeOf(good, [](Image& image) { image.encoding = "rgb8"; }), "NotDepth");
  EXPECT_EQ(codeOf(good, [](Image& image) { image.width = image.height = 0; }), "Ok");
}

TEST(DepthMap, RefusesCorruptCompressedDepth) {
  const std::vector<std::uint16_t> values(64, 1234);
  const auto codeOf = [](const Image& image) {
    const auto map = decodeDepth(image);
    return map ? std::string("Ok") : std::string(toString(map.error().code));
  };
  for (const auto& body : {sample::writeGrayPng(8, values), sample::writeRvl(8, values)}) {
    const Image whole = compressedDepth(body);
    ASSERT_EQ(codeOf(whole), "Ok");
    for (std::size_t size = 0; size + 1 < whole.data.bytes.size(); ++size) {
      Image cut = whole;
      cut.data.bytes = whole.data.bytes.first(size);
      // What a PNG has behind its last row may be missing.
      EXPECT_THAT(codeOf(cut), testing::AnyOf("CorruptImage", "Ok")) << size;
    }
  }
  // Sizes that lie, in the PNG's header and in that of RVL.
  auto huge = sample::writeRvl(8, values);
  std::memset(huge.data(), 0xFF, 8);
  EXPECT_EQ(codeOf(compressedDepth(huge)), "ImageTooLarge");
  std::memset(huge.data(), 0, 8);
  huge[1] = huge[5] = std::byte{0x20};  // 8192 x 8192
  EXPECT_EQ(codeOf(compressedDepth(huge)), "CorruptImage");
  auto wrong = sample::writeGrayPng(8, values);
  wrong[20] = std::byte{0x55};  // the height, whose checksum no longer fits
  EXPECT_EQ(codeOf(compressedDepth(wrong)), "CorruptImage");
  EXPECT_EQ(codeOf(compressedDepth(sample::writeRgbPng(2, std::vector<std::uint8_t>(12, 1)))), "CorruptImage");
  for (const float a : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_EQ(codeOf(compressedDepth(sample::writeGrayPng(8, values), "32FC1", a, 1.0F)), "CorruptImage");
  }
}

TEST(ColorImage, ReadsRawPngAndJpeg) {
  const std::vector<std::uint8_t> rgb(std::size_t{16} * 16 * 3, 100);
  Image image;
  image.encoding = "jpeg";
  setData(image, sample::writeJpeg(16, rgb));
  const auto jpeg = decodeColor(image);
  ASSERT_TRUE(jpeg) << jpeg.error().message;
  EXPECT_EQ(jpeg->width, 16U);
  EXPECT_NEAR(jpeg->rgba[0], 100, 2);
  EXPECT_EQ(jpeg->rgba[3], 255);
  image.data.bytes = image.data.bytes.first(image.data.bytes.size() / 2);
  EXPECT_FALSE(decodeColor(image));
  image.encoding = "png";
  setData(image, sample::writeRgbPng(1, {1, 2, 3, 4, 5, 6}));
  const auto png = decodeColor(image);
  ASSERT_TRUE(png) << png.error().message;
  EXPECT_THAT(png->rgba, ElementsAre(1, 2, 3, 255, 4, 5, 6, 255));
  const auto bgr = decodeColor(makeImage<std::uint8_t>("f", "bgra8", 1, {3, 2, 1, 9}, 4));
  ASSERT_TRUE(bgr);
  EXPECT_THAT(bgr->rgba, ElementsAre(1, 2, 3, 255));
}

}  // namespace
}  // namespace stillframe::test
