#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <span>
#include <thread>
#include <vector>

#include "nodes/points/channel.h"
#include "scenegraph/raster/point_blocks.h"
#include "tests/nodes/cloud_builder.h"

namespace stillframe::test {
namespace {

/// Enough points for several parts; some are dropped, the first of them in the second part.
std::vector<Xyz> manyPoints() {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> anywhere(-50.0F, 50.0F);
  std::vector<Xyz> points(900'000);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {anywhere(random), anywhere(random), i > 300'000 && i % 7 == 0 ? kNan : anywhere(random)};
  }
  return points;
}

void expectSame(const Converted& a, const Converted& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.cloud.not_finite, b.cloud.not_finite);
  EXPECT_EQ(a.cloud.box_min, b.cloud.box_min);
  EXPECT_EQ(a.cloud.box_max, b.cloud.box_max);
  ASSERT_EQ(a.cloud.runs.size(), b.cloud.runs.size());
  for (std::size_t i = 0; i < a.cloud.runs.size(); ++i) {
    EXPECT_EQ(a.cloud.runs[i].offset, b.cloud.runs[i].offset);
    EXPECT_EQ(a.cloud.runs[i].count, b.cloud.runs[i].count);
  }
}

void expectBoxesOfPositions(const Converted& converted) {
  const auto boxes = scenegraph::boxesOf(converted.positions);
  ASSERT_EQ(converted.cloud.boxes.size(), boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_EQ(converted.cloud.boxes[i].low, boxes[i].low) << i;
    EXPECT_EQ(converted.cloud.boxes[i].high, boxes[i].high) << i;
  }
}

TEST(ConvertCloud, FindsTheBoxesOfGroupsWhereverPointsAreDropped) {
  auto points = manyPoints();
  expectBoxesOfPositions(*convert(xyzCloud(points)));
  std::erase_if(points, [](const Xyz& point) { return std::isnan(point.z); });
  expectBoxesOfPositions(*convert(xyzCloud(points)));
  points.resize(1023);
  expectBoxesOfPositions(*convert(xyzCloud(points)));
}

struct XyzValue {
  float x, y, z;
  double value;
};

/// With a value a point, some of them NaN or beyond what floats tell apart.
PointCloud cloudWithValues(double scale) {
  std::vector<XyzValue> points;
  for (const Xyz& p : manyPoints()) {
    points.push_back(
        {p.x, p.y, p.z, points.size() % 11 == 5 ? double{kNan} : scale * static_cast<double>(points.size())});
  }
  auto fields = kXyzFields;
  fields.push_back({"value", offsetof(XyzValue, value), FieldType::Float64});
  return makeCloud<XyzValue>(fields, points);
}

TEST(ConvertCloud, MakesAChannelAlongThatIsTheOneMadeAfterwards) {
  for (const double scale : {1.0, 1e6, -1.0}) {
    const PointCloud cloud = cloudWithValues(scale);
    const nodes::ChannelInfo info = nodes::listChannels(cloud).at(0);
    std::vector<float> along_values;
    nodes::ChannelAlong along(cloud, info, [&](std::size_t points) {
      along_values.assign(points, -7.0F);
      return along_values.data();
    });
    std::vector<float> positions;
    const auto room = [&](std::size_t floats) {
      positions.resize(floats);
      return positions.data();
    };
    const auto converted = nodes::convertCloud(cloud, room, &along);
    ASSERT_TRUE(converted);
    ASSERT_LT(converted->points, along_values.size());  // parts have moved
    const nodes::ChannelValues limits = along.finish(*converted);
    along_values.resize(converted->points);
    std::vector<float> after(converted->points);
    const nodes::ChannelValues expected = nodes::convertChannel(cloud, *converted, info, after);
    EXPECT_TRUE(along_values == after) << scale;
    EXPECT_EQ(limits.offset, expected.offset);
    EXPECT_EQ(limits.low, expected.low);
    EXPECT_EQ(limits.high, expected.high);
    EXPECT_EQ(limits.finite, expected.finite);
  }
}

TEST(ConvertArrivingCloud, BecomesTheSame) {
  const PointCloud whole = xyzCloud(manyPoints());
  const auto expected = convert(whole);
  ASSERT_TRUE(expected);
  constexpr std::size_t kPlace = 1000;  // in the block
  const auto source = whole.data.bytes;
  std::vector<std::byte> block(kPlace + source.size() + 1, std::byte{0xFF});
  const auto arrival = std::make_shared<scenegraph::Arrival>();
  PointCloud early = whole;
  early.data = {std::span(block).subspan(kPlace, source.size()), nullptr, arrival, kPlace};
  std::thread writer([&] {
    for (std::size_t at = 0; at < source.size(); at += 100'000) {
      const auto piece = source.subspan(at, std::min<std::size_t>(100'000, source.size() - at));
      std::ranges::copy(piece, block.begin() + static_cast<std::ptrdiff_t>(kPlace + at));
      arrival->advance(kPlace + at + piece.size());
    }
    arrival->advance(block.size());
    arrival->finish(true);
  });
  const auto converted = convert(early);
  writer.join();
  ASSERT_TRUE(converted);
  expectSame(*converted, *expected);
  expectBoxesOfPositions(*converted);
}

TEST(ConvertArrivingCloud, IsRefusedWhenItComesToNoGoodEnd) {
  PointCloud cloud = xyzCloud(manyPoints());
  const std::size_t size = cloud.data.bytes.size();
  for (const std::size_t came : {std::size_t{0}, size / 2, size}) {
    for (const std::uint32_t width : {cloud.width, 0U}) {  // without points too
      const auto arrival = std::make_shared<scenegraph::Arrival>();
      arrival->advance(came);
      arrival->finish(false);
      PointCloud bad = cloud;
      bad.width = width;
      bad.data.arrival = arrival;
      const auto converted = convert(bad);
      ASSERT_FALSE(converted) << came;
      EXPECT_EQ(converted.error().code, nodes::CloudErrorCode::MalformedCloud);
    }
  }
}

}  // namespace
}  // namespace stillframe::test
