#include "nodes/points/point_colors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "nodes/points/channel.h"
#include "tests/nodes/cloud_builder.h"

namespace stillframe::test {
namespace {

using nodes::ColorSource;
using testing::ElementsAre;

struct Packed {
  float x, y, z;
  std::uint32_t color;
};

PointCloud packedCloud(const char* name, FieldType type, std::vector<std::uint32_t> colors) {
  std::vector<Packed> points;
  for (const std::uint32_t color : colors) {
    points.push_back({1, 2, 3, color});
  }
  return makeCloud<Packed>(
      {{"x", 0, FieldType::Float32}, {"y", 4, FieldType::Float32}, {"z", 8, FieldType::Float32}, {name, 12, type}},
      points);
}

std::vector<int> colorsOf(const PointCloud& cloud) {
  const auto source = nodes::findColors(cloud);
  const auto converted = convert(cloud);
  if (!source || !converted) {
    return {};
  }
  std::vector<std::uint8_t> rgba(4 * converted->cloud.points);
  nodes::convertColors(cloud, converted->cloud, *source, rgba);
  return {rgba.begin(), rgba.end()};
}

TEST(PointColors, ReadsCanonicalBytesInAddressOrder) {
  // Little-endian word 0x04030201 lies as bytes 1 2 3 4.
  EXPECT_THAT(colorsOf(packedCloud("rgba", FieldType::Uint32, {0x04030201})), ElementsAre(1, 2, 3, 255));
}

TEST(PointColors, ReadsPclWordsByBitsEvenWhenTheFloatIsNan) {
  ASSERT_TRUE(std::isnan(std::bit_cast<float>(0xffc08040U)));
  EXPECT_THAT(colorsOf(packedCloud("rgb", FieldType::Float32, {0xffc08040U, 0x00010203U})),
              ElementsAre(0xc0, 0x80, 0x40, 255, 1, 2, 3, 255));
}

TEST(PointColors, ReadsPclIntegersWhenTheCloudSaysSo) {
  auto cloud = packedCloud("rgba", FieldType::Uint32, {0xff102030U});
  cloud.color_packing = scenegraph::ColorPacking::PclWord;
  EXPECT_THAT(colorsOf(cloud), ElementsAre(0x10, 0x20, 0x30, 255));
}

TEST(PointColors, ReadsPclWordsOfABigEndianCloud) {
  const auto big = [](float v) { return std::bit_cast<float>(std::byteswap(std::bit_cast<std::uint32_t>(v))); };
  const std::vector<Packed> points = {{big(1), big(2), big(3), std::byteswap(0xff102030U)}};
  auto cloud = makeCloud<Packed>({{"x", 0, FieldType::Float32},
                                  {"y", 4, FieldType::Float32},
                                  {"z", 8, FieldType::Float32},
                                  {"rgb", 12, FieldType::Float32}},
                                 points);
  cloud.is_bigendian = true;
  EXPECT_THAT(colorsOf(cloud), ElementsAre(0x10, 0x20, 0x30, 255));
  // Canonical bytes have no byte order.
  cloud.fields[3].type = FieldType::Uint32;
  EXPECT_THAT(colorsOf(cloud), ElementsAre(0xff, 0x10, 0x20, 255));
}

struct Separate {
  float x, y, z, r, g, b, a;
};
const std::vector<PackedField> kSeparateFields = {{"x", 0, FieldType::Float32},  {"y", 4, FieldType::Float32},
                                                  {"z", 8, FieldType::Float32},  {"r", 12, FieldType::Float32},
                                                  {"g", 16, FieldType::Float32}, {"b", 20, FieldType::Float32},
                                                  {"a", 24, FieldType::Float32}};

TEST(PointColors, ScalesSeparateFloatsByTheirLargest) {
  constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(colorsOf(makeCloud<Separate>(kSeparateFields, std::vector<Separate>{{0, 0, 0, 0, 0.5F, 1, 0.1F}})),
              ElementsAre(0, 128, 255, 255));
  EXPECT_THAT(colorsOf(makeCloud<Separate>(kSeparateFields, std::vector<Separate>{{0, 0, 0, -3, 128, 1e9F, 0},
                                                                                  {0, 0, 0, kNoNumber, 1, 255, 0}})),
              ElementsAre(0, 128, 255, 255, 0, 1, 255, 255));
}

TEST(PointColors, ReadsSeparateBytesAndShorts) {
  struct Bytes {
    float x, y, z;
    std::uint8_t red, green, blue, pad;
  };
  EXPECT_THAT(colorsOf(makeCloud<Bytes>({{"blue", 14, FieldType::Uint8},
                                         {"x", 0, FieldType::Float32},
                                         {"y", 4, FieldType::Float32},
                                         {"z", 8, FieldType::Float32},
                                         {"red", 12, FieldType::Uint8},
                                         {"green", 13, FieldType::Uint8}},
                                        std::vector<Bytes>{{0, 0, 0, 200, 100, 50, 0}})),
              ElementsAre(200, 100, 50, 255));
  struct Shorts {
    float x, y, z;
    std::uint16_t r, g, b, pad;
  };
  EXPECT_THAT(colorsOf(makeCloud<Shorts>({{"x", 0, FieldType::Float32},
                                          {"y", 4, FieldType::Float32},
                                          {"z", 8, FieldType::Float32},
                                          {"r", 12, FieldType::Uint16},
                                          {"g", 14, FieldType::Uint16},
                                          {"b", 16, FieldType::Uint16}},
                                         std::vector<Shorts>{{0, 0, 0, 65535, 257, 0, 0}})),
              ElementsAre(255, 1, 0, 255));
}

TEST(PointColors, AreNotOfferedAsNumbers) {
  auto cloud = makeCloud<Separate>(kSeparateFields, std::vector<Separate>{{0, 0, 0, 0, 0, 0, 0}});
  EXPECT_TRUE(nodes::listChannels(cloud).empty());
  cloud.fields[3].name = "intensity";  // no red: green and blue are numbers then
  EXPECT_FALSE(nodes::findColors(cloud));
  std::vector<std::string> names;
  for (const auto& channel : nodes::listChannels(cloud)) {
    names.push_back(channel.name);
  }
  EXPECT_THAT(names, ElementsAre("intensity", "g", "b", "a"));
}

TEST(Channels, LeaveOutTimesAndNameEachValueOfAnArray) {
  PointCloud cloud;
  cloud.fields = {{"x", 0, FieldType::Float32},          {"timestamp", 4, FieldType::Float64},
                  {"Time", 4, FieldType::Float64},       {"t", 4, FieldType::Uint32},
                  {"offset_time", 4, FieldType::Uint32}, {"ring", 8, FieldType::Uint16},
                  {"normal", 10, FieldType::Float32, 3}, {"mystery", 0, FieldType::Unknown},
                  {"ring", 12, FieldType::Uint8},        {"delta_ns", 12, FieldType::Uint32}};
  std::vector<std::string> names;
  for (const auto& channel : nodes::listChannels(cloud)) {
    names.push_back(channel.name);
  }
  EXPECT_THAT(names, ElementsAre("ring", "normal[0]", "normal[1]", "normal[2]", "delta_ns"));
  EXPECT_EQ(nodes::listChannels(cloud)[2].offset, 14U);
}

TEST(Channels, KeepLargeIntegersApart) {
  auto cloud = packedCloud("stamp_low", FieldType::Uint32, {4'000'000'000U, 4'000'000'001U, 4'000'000'002U});
  const auto converted = convert(cloud);
  std::vector<float> values(3);
  const auto channel = nodes::convertChannel(cloud, converted->cloud, nodes::listChannels(cloud)[0], values);
  EXPECT_EQ(channel.low, 4e9);
  EXPECT_EQ(channel.high, 4e9 + 2);
  EXPECT_THAT(values, ElementsAre(-1, 0, 1));
  EXPECT_EQ(channel.offset, 4e9 + 1);
}

TEST(Channels, ReplaceWhatIsNotFinite) {
  const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v); };
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  const auto cloud =
      packedCloud("intensity", FieldType::Float32,
                  {bits(std::numeric_limits<float>::quiet_NaN()), bits(kEndless), bits(-kEndless), bits(2.0F)});
  const auto converted = convert(cloud);
  std::vector<float> values(4);
  const auto channel = nodes::convertChannel(cloud, converted->cloud, nodes::listChannels(cloud)[0], values);
  EXPECT_THAT(values, ElementsAre(nodes::kMissingValue, nodes::kValueReach, -nodes::kValueReach, 2.0F));
  EXPECT_EQ(channel.finite, 1U);
  EXPECT_EQ(channel.low, 2.0);
  EXPECT_EQ(channel.high, 2.0);
}

TEST(Channels, OfLargeCloudsWithHolesGoPointByPoint) {
  struct Point {
    double x, y, z;  // beyond kNearby: written again, relative to the origin
    std::uint32_t rgb;
    float intensity;
  };
  std::vector<Point> points(400'003);  // some pieces and a rest
  std::vector<Point> kept;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const bool is_hole = i % 4999 == 3 || (i > 131'000 && i < 131'200) || (i > 270'000 && i < 310'000 && i % 2 == 0);
    const double x = is_hole ? std::numeric_limits<double>::quiet_NaN() : 4e5 + 1e-3 * i;
    points[i] = {x, -5e6 + 2e-3 * i, 100.0, i * 37U, 1e-2F * static_cast<float>(i)};
    if (!is_hole) {
      kept.push_back(points[i]);
    }
  }
  const PointCloud cloud = makeCloud<Point>({{"x", 0, FieldType::Float64},
                                             {"y", 8, FieldType::Float64},
                                             {"z", 16, FieldType::Float64},
                                             {"rgb", 24, FieldType::Float32},  // as PCL packs it
                                             {"intensity", 28, FieldType::Float32}},
                                            points);
  const auto converted = convert(cloud);
  ASSERT_TRUE(converted);
  ASSERT_EQ(converted->cloud.points, kept.size());
  std::vector<float> values(kept.size());
  const auto channel = nodes::convertChannel(cloud, converted->cloud, nodes::listChannels(cloud)[0], values);
  std::vector<std::uint8_t> rgba(4 * kept.size());
  nodes::convertColors(cloud, converted->cloud, *nodes::findColors(cloud), rgba);
  EXPECT_EQ(channel.finite, kept.size());
  EXPECT_EQ(channel.low, kept.front().intensity);
  EXPECT_EQ(channel.high, kept.back().intensity);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    ASSERT_EQ(values[i], kept[i].intensity) << i;
    ASSERT_EQ(converted->positions[3 * i], static_cast<float>(kept[i].x - converted->cloud.origin.x)) << i;
    ASSERT_EQ(converted->positions[3 * i + 1], static_cast<float>(kept[i].y - converted->cloud.origin.y)) << i;
    const std::uint32_t word =
        std::uint32_t{rgba[4 * i]} << 16U | std::uint32_t{rgba[4 * i + 1]} << 8U | std::uint32_t{rgba[4 * i + 2]};
    ASSERT_EQ(word, kept[i].rgb & 0xFFFFFFU) << i;
    ASSERT_EQ(rgba[4 * i + 3], 255) << i;
  }
}

}  // namespace
}  // namespace stillframe::test
