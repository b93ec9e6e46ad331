#include "nodes/points/convert_cloud.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "nodes/points/channel.h"
#include "tests/nodes/cloud_builder.h"

namespace stillframe::test {
namespace {

using nodes::CloudErrorCode;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(ConvertCloud, KeepsFinitePointsInOrderAndCountsTheOthers) {
  const auto converted = convert(xyzCloud(
      {{1, 2, 3}, {kNan, 0, 0}, {4, 5, 6}, {0, kInf, 0}, {0, 0, -kInf}, {7, 8, 9}, {1e20F, 0, 0}, {-1, -2, -3}}));
  ASSERT_TRUE(converted);
  EXPECT_THAT(converted->positions, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, -1, -2, -3));
  EXPECT_EQ(converted->cloud.points, 4U);
  EXPECT_EQ(converted->cloud.not_finite, 3U);
  EXPECT_EQ(converted->cloud.out_of_reach, 1U);
  EXPECT_EQ(converted->cloud.box_min, glm::dvec3(-1, -2, -3));
  EXPECT_EQ(converted->cloud.box_max, glm::dvec3(7, 8, 9));
}

TEST(ConvertCloud, DropsNoneButTheBadPointWhereverItLies) {
  // Long enough for whole chunks of the vectorised copy, and a rest.
  std::vector<Xyz> points;
  for (int i = 0; i < 1203; ++i) {
    const auto value = static_cast<float>(i);
    points.push_back({value, -value, value / 2});
  }
  for (const std::size_t at : {0U, 1U, 7U, 8U, 510U, 511U, 512U, 513U, 1023U, 1024U, 1195U, 1202U}) {
    for (const float bad : {kNan, kInf, -kInf, 3e38F, -2e15F}) {
      for (float Xyz::* const axis : {&Xyz::x, &Xyz::y, &Xyz::z}) {
        std::vector<Xyz> spoilt = points;
        spoilt[at].*axis = bad;
        const auto converted = convert(xyzCloud(spoilt));
        ASSERT_TRUE(converted);
        ASSERT_EQ(converted->cloud.points, points.size() - 1);
        ASSERT_EQ(converted->cloud.not_finite, std::isfinite(bad) ? 0U : 1U);
        ASSERT_EQ(converted->cloud.out_of_reach, std::isfinite(bad) ? 1U : 0U);
        ASSERT_EQ(converted->cloud.box_max.x, at + 1 == points.size() ? 1201.0 : 1202.0);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
          const std::size_t kept = i < at ? i : i + 1;
          ASSERT_EQ(converted->positions[3 * i + 2] + static_cast<float>(converted->cloud.origin.z), points[kept].z);
        }
      }
    }
  }
}

TEST(ConvertCloud, GivesTheBoxesOfTheGroupsWhateverWasDroppedOrMoved) {
  constexpr std::size_t kPoints = 600'000;  // three parts, the last one short
  std::vector<Xyz> points(kPoints);
  std::mt19937 random(11);
  std::uniform_real_distribution<float> metres(-50.0F, 50.0F);
  std::ranges::generate(points, [&] { return Xyz{metres(random), metres(random), metres(random)}; });
  PointCloud whole = xyzCloud(points);
  PointCloud organised = whole;
  organised.width = 1000;
  organised.height = kPoints / 1000;
  organised.row_step = organised.width * organised.point_step;
  points[300'000].x = kNan;
  const PointCloud dropped = xyzCloud(points);
  std::ranges::for_each(points, [](Xyz& point) { point.y += 5e6F; });
  for (const PointCloud& cloud : {whole, organised, dropped, xyzCloud(points), xyzCloud({{1, 2, 3}}), xyzCloud({})}) {
    const auto converted = convert(cloud);
    ASSERT_TRUE(converted);
    const auto boxes = scenegraph::boxesOf(converted->positions);
    ASSERT_EQ(converted->cloud.boxes.size(), boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      EXPECT_EQ(converted->cloud.boxes[i].low, boxes[i].low) << i;
      EXPECT_EQ(converted->cloud.boxes[i].high, boxes[i].high) << i;
    }
  }
}

TEST(ConvertCloud, TakesZeroPointsWhateverTheFieldsSay) {
  PointCloud cloud;
  cloud.width = 0;
  cloud.height = 1;
  EXPECT_EQ(convert(cloud)->cloud.points, 0U);
  cloud.fields = {{"a", 1000, FieldType::Unknown}};
  cloud.height = 0;
  cloud.width = 5;
  EXPECT_EQ(convert(cloud)->cloud.points, 0U);
}

TEST(ConvertCloud, TakesACloudOfNothingButNan) {
  const auto converted = convert(xyzCloud({{kNan, kNan, kNan}, {kNan, kNan, kNan}}));
  ASSERT_TRUE(converted);
  EXPECT_EQ(converted->cloud.points, 0U);
  EXPECT_EQ(converted->cloud.not_finite, 2U);
  EXPECT_TRUE(converted->cloud.runs.empty());
}

TEST(ConvertCloud, NamesTheCoordinateThatIsMissing) {
  auto cloud = xyzCloud({{1, 2, 3}});
  cloud.fields[1].name = "why";
  const auto converted = convert(cloud);
  ASSERT_FALSE(converted);
  EXPECT_EQ(converted.error().code, CloudErrorCode::MissingCoordinates);
  EXPECT_THAT(converted.error().message, HasSubstr("'y'"));
  EXPECT_THAT(converted.error().message, HasSubstr("x, why, z"));
}

TEST(ConvertCloud, RefusesACoordinateOfUnknownType) {
  auto cloud = xyzCloud({{1, 2, 3}});
  cloud.fields[2].type = static_cast<FieldType>(9);
  EXPECT_EQ(convert(cloud).error().code, CloudErrorCode::UnsupportedCoordinates);
  cloud.fields[2].type = FieldType::Unknown;
  EXPECT_EQ(convert(cloud).error().code, CloudErrorCode::UnsupportedCoordinates);
}

/// Each case changes one number of a good cloud of 2 rows of 2 points.
struct BadSizes {
  const char* name;
  void (*spoil)(PointCloud&);
  const char* says;
};
class ConvertCloudBadSizes : public testing::TestWithParam<BadSizes> {};

TEST_P(ConvertCloudBadSizes, IsMalformedAndSaysTheNumbers) {
  auto cloud = xyzCloud({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}});
  cloud.width = 2;
  cloud.height = 2;
  cloud.row_step = 24;
  ASSERT_EQ(convert(cloud)->cloud.points, 4U);
  GetParam().spoil(cloud);
  const auto converted = convert(cloud);
  ASSERT_FALSE(converted);
  EXPECT_EQ(converted.error().code, CloudErrorCode::MalformedCloud);
  EXPECT_THAT(converted.error().message, HasSubstr(GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, ConvertCloudBadSizes,
    testing::Values(
        BadSizes{"short_data", [](PointCloud& c) { c.data.bytes = c.data.bytes.first(47); }, "do not fit 47 bytes"},
        BadSizes{"no_data", [](PointCloud& c) { c.data.bytes = {}; }, "do not fit 0 bytes"},
        BadSizes{"wide", [](PointCloud& c) { c.width = 0xffffffff; }, "rows overlap"},
        BadSizes{"wide_step",
                 [](PointCloud& c) {
                   c.width = c.point_step = c.row_step = 0xffffffff;
                   c.height = 1;
                 },
                 "do not fit 48 bytes"},
        BadSizes{"all_huge",
                 [](PointCloud& c) {
                   c.width = c.height = c.point_step = 0xffffffff;
                   c.row_step = 0;
                 },
                 "do not fit 48 bytes"},
        BadSizes{"high", [](PointCloud& c) { c.height = 0xffffffff; }, "do not fit 48 bytes"},
        BadSizes{"overlapping_rows", [](PointCloud& c) { c.row_step = 12; }, "rows overlap"},
        BadSizes{"row_step", [](PointCloud& c) { c.row_step = 25; }, "do not fit 48 bytes"},
        BadSizes{"zero_step", [](PointCloud& c) { c.point_step = 0; }, "point step is 0"},
        BadSizes{"small_step", [](PointCloud& c) { c.point_step = 11; }, "field 'z' ends at byte 12"},
        BadSizes{"offset", [](PointCloud& c) { c.fields[0].offset = 0xffffffff; }, "field 'x' ends at byte 4294967299"},
        BadSizes{"count", [](PointCloud& c) { c.fields[0].count = 0xffffffff; }, "field 'x' ends at byte"}),
    [](const auto& bad) { return std::string(bad.param.name); });

TEST(ConvertCloud, ReadsRowStepZeroAsPackedAndIgnoresItForOneRow) {
  auto cloud = xyzCloud({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}});
  cloud.row_step = 1;
  EXPECT_EQ(convert(cloud)->cloud.points, 4U);
  cloud.width = cloud.height = 2;
  cloud.row_step = 0;
  EXPECT_THAT(convert(cloud)->positions, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12));
}

struct XyzDouble {
  double x, y, z;
};

TEST(ConvertCloud, KeepsMillimetresOfUtmCoordinatesInDouble) {
  std::vector<XyzDouble> points;
  for (int i = 0; i < 100; ++i) {
    points.push_back({691'000.0 + 0.001 * i, 5'334'000.0 - 0.001 * i, 3.0});
  }
  const auto cloud = makeCloud<XyzDouble>(
      {{"x", 0, FieldType::Float64}, {"y", 8, FieldType::Float64}, {"z", 16, FieldType::Float64}}, points);
  const auto converted = convert(cloud);
  ASSERT_TRUE(converted);
  EXPECT_EQ(converted->cloud.origin.z, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(converted->cloud.origin.x + converted->positions[3 * i], points[i].x, 1e-6);
    EXPECT_NEAR(converted->cloud.origin.y + converted->positions[3 * i + 1], points[i].y, 1e-6);
  }
}

TEST(ConvertCloud, LosesNothingOfFarFloatsWhenItMovesTheOrigin) {
  std::vector<Xyz> points;
  for (int i = 0; i < 9; ++i) {
    points.push_back({6'378'000.0F + 0.5F * static_cast<float>(i), 12.25F, -2000.125F});
  }
  const auto converted = convert(xyzCloud(points));
  ASSERT_TRUE(converted);
  EXPECT_NE(converted->cloud.origin.x, 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_DOUBLE_EQ(converted->cloud.origin.x + converted->positions[3 * i], points[i].x);
    EXPECT_DOUBLE_EQ(converted->cloud.origin.z + converted->positions[3 * i + 2], points[i].z);
    EXPECT_LT(std::abs(converted->positions[3 * i]), 5.0F);
  }
}

/// Value of a field by shifts, so that it shares nothing with the code under test.
double referenceValue(const std::byte* at, FieldType type, bool is_bigendian) {
  const std::size_t bytes = scenegraph::byteSize(type);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    const std::size_t significance = is_bigendian ? bytes - 1 - i : i;
    bits |= std::to_integer<std::uint64_t>(at[i]) << (8 * significance);
  }
  switch (type) {
    case FieldType::Int8:
      return static_cast<double>(static_cast<std::int8_t>(bits));
    case FieldType::Int16:
      return static_cast<double>(static_cast<std::int16_t>(bits));
    case FieldType::Int32:
      return static_cast<double>(static_cast<std::int32_t>(bits));
    case FieldType::Float32:
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    case FieldType::Float64:
      return std::bit_cast<double>(bits);
    default:
      return static_cast<double>(bits);
  }
}

/// A cloud of random bytes: any types, overlapping fields, any order, padding, both byte orders.
PointCloud randomCloud(std::mt19937& random) {
  const auto pick = [&](std::uint32_t low, std::uint32_t high) {
    return std::uniform_int_distribution<std::uint32_t>(low, high)(random);
  };
  PointCloud cloud;
  cloud.width = pick(1, 23);
  cloud.height = pick(0, 2) == 0 ? pick(2, 5) : 1;
  cloud.point_step = pick(8, 40);
  cloud.row_step = cloud.width * cloud.point_step + (pick(0, 1) == 0 ? 0 : pick(1, 9));
  cloud.is_bigendian = pick(0, 1) == 1;
  const bool is_common = pick(0, 3) == 0 && cloud.point_step >= 16;
  const auto common_offset = pick(0, is_common ? cloud.point_step - 12 : 0);
  const auto type = static_cast<FieldType>(pick(1, 8));
  const bool is_uniform = pick(0, 1) == 0;
  std::uint32_t axis = 0;
  for (const char* name : {"x", "y", "z", "value"}) {
    PackedField field{name, 0, is_uniform ? type : static_cast<FieldType>(pick(1, 8)), pick(0, 1)};
    field.offset = pick(0, cloud.point_step - scenegraph::byteSize(field.type));
    if (is_common && axis < 3) {
      field.type = FieldType::Float32;
      field.offset = common_offset + 4 * axis;
    }
    ++axis;
    cloud.fields.push_back(field);
  }
  std::ranges::shuffle(cloud.fields, random);
  std::vector<std::byte> bytes(std::size_t{cloud.row_step} * (cloud.height - 1) +
                               std::size_t{cloud.width} * cloud.point_step);
  for (std::byte& byte : bytes) {
    byte = static_cast<std::byte>(pick(0, 255));
  }
  setData(cloud, std::move(bytes));
  return cloud;
}

const PackedField& fieldNamed(const PointCloud& cloud, std::string_view name) {
  return *std::ranges::find(cloud.fields, name, &PackedField::name);
}

TEST(ConvertCloud, AgreesWithAPlainReadingOfRandomLayouts) {
  std::mt19937 random(20261121);
  for (int round = 0; round < 4000; ++round) {
    SCOPED_TRACE(round);
    const PointCloud cloud = randomCloud(random);
    const auto converted = convert(cloud);
    ASSERT_TRUE(converted) << converted.error().message;
    std::vector<float> channel(converted->cloud.points);
    const PackedField& value_field = fieldNamed(cloud, "value");
    const auto values = nodes::convertChannel(cloud, converted->cloud,
                                              {value_field.name, value_field.offset, value_field.type}, channel);
    std::size_t kept = 0;
    std::size_t dropped = 0;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t i = 0; i < std::size_t{cloud.width} * cloud.height; ++i) {
      const std::byte* point =
          cloud.data.bytes.data() + (i / cloud.width) * cloud.row_step + (i % cloud.width) * cloud.point_step;
      glm::dvec3 p;
      for (int axis = 0; axis < 3; ++axis) {
        constexpr const char* kNames[] = {"x", "y", "z"};
        const PackedField& field = fieldNamed(cloud, kNames[axis]);
        p[axis] = referenceValue(point + field.offset, field.type, cloud.is_bigendian);
      }
      const double reach = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      if (std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z) || reach > nodes::ConvertedCloud::kReach) {
        ++dropped;
        continue;
      }
      ASSERT_LT(kept, converted->cloud.points);
      for (int axis = 0; axis < 3; ++axis) {
        const float expected = static_cast<float>(p[axis] - converted->cloud.origin[axis]);
        ASSERT_EQ(converted->positions[3 * kept + static_cast<std::size_t>(axis)], expected);
      }
      const double value = referenceValue(point + value_field.offset, value_field.type, cloud.is_bigendian);
      if (std::isnan(value)) {
        ASSERT_EQ(channel[kept], nodes::kMissingValue);
      } else {
        const double reached =
            std::clamp(value - values.offset, -double{nodes::kValueReach}, double{nodes::kValueReach});
        ASSERT_EQ(channel[kept], static_cast<float>(reached));
      }
      if (std::isfinite(value)) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
      ++kept;
    }
    ASSERT_EQ(kept, converted->cloud.points);
    ASSERT_EQ(dropped, converted->cloud.not_finite + converted->cloud.out_of_reach);
    if (values.finite > 0) {
      ASSERT_EQ(values.low, low);
      ASSERT_EQ(values.high, high);
    } else {
      ASSERT_GT(low, high);
    }
  }
}

TEST(ConvertCloud, FindsEveryNanAroundTheBlocksOfTheFastPath) {
  // Every subset of 11 points may be NaN: block, remainder and runs in all combinations.
  for (unsigned mask = 0; mask < (1U << 11); ++mask) {
    std::vector<Xyz> points;
    std::vector<float> expected;
    for (unsigned i = 0; i < 11; ++i) {
      const auto v = static_cast<float>(i);
      points.push_back({v, v + 0.25F, ((mask >> i) & 1U) != 0 ? kNan : v + 0.5F});
      if (((mask >> i) & 1U) == 0) {
        expected.insert(expected.end(), {v, v + 0.25F, v + 0.5F});
      }
    }
    const auto converted = convert(xyzCloud(points));
    ASSERT_TRUE(converted);
    ASSERT_EQ(converted->positions, expected) << mask;
    std::size_t in_runs = 0;
    for (const nodes::PointRun& run : converted->cloud.runs) {
      in_runs += run.count;
    }
    ASSERT_EQ(in_runs, converted->cloud.points);
  }
}

}  // namespace
}  // namespace stillframe::test
