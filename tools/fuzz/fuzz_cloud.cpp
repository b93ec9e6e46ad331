// Header fields of a cloud and its bytes from the fuzzer: conversion, channels and colours must stay inside the data,
// never make more points than bytes, and never write a value that is not finite.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "nodes/points/channel.h"
#include "nodes/points/convert_cloud.h"
#include "nodes/points/point_colors.h"
#include "nodes/points/value_range.h"

namespace {

using namespace stillframe;
using scenegraph::FieldType;

/// Takes numbers off the front of the input; zeros when it has run out.
struct Input {
  const std::uint8_t* at;
  std::size_t left;

  template <typename T>
  T take() {
    T value{};
    const std::size_t bytes = std::min(left, sizeof(value));
    std::memcpy(&value, at, bytes);
    at += bytes;
    left -= bytes;
    return value;
  }
  /// Mostly small, sometimes anything.
  std::uint32_t size() {
    const auto kind = take<std::uint8_t>();
    return kind < 230 ? kind % 48U : take<std::uint32_t>();
  }
};

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

scenegraph::PointCloud cloudFrom(Input& input) {
  constexpr const char* kNames[] = {"x", "y", "z", "rgb", "rgba", "r", "g", "b", "intensity", "t", "red", "x"};
  scenegraph::PointCloud cloud;
  cloud.width = input.size();
  cloud.height = input.size();
  cloud.point_step = input.size();
  cloud.row_step = input.take<std::uint8_t>() < 128 ? cloud.width * cloud.point_step : input.size();
  const auto flags = input.take<std::uint8_t>();
  cloud.is_bigendian = (flags & 1) != 0;
  cloud.color_packing = (flags & 2) != 0 ? scenegraph::ColorPacking::PclWord : scenegraph::ColorPacking::RgbaBytes;
  const unsigned fields = input.take<std::uint8_t>() % 10U;
  for (unsigned i = 0; i < fields; ++i) {
    const auto name = input.take<std::uint8_t>();
    const auto type = input.take<std::uint8_t>();
    cloud.fields.push_back({kNames[i < 3 && name < 200 ? i : name % std::size(kNames)], input.size(),
                            static_cast<FieldType>(type < 240 ? type % 9 : type), input.size()});
  }
  // A copy of exactly the size, so that one byte too many is caught.
  const auto bytes = std::make_shared<std::vector<std::byte>>(input.left);
  if (input.left > 0) {
    std::memcpy(bytes->data(), input.at, input.left);
  }
  cloud.data = {*bytes, bytes};
  return cloud;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input{data, size};
  const scenegraph::PointCloud cloud = cloudFrom(input);
  std::vector<float> positions;
  const auto converted = nodes::convertCloud(cloud, [&](std::size_t floats) {
    require(floats / 3 <= cloud.data.bytes.size());
    positions.resize(floats);
    return positions.data();
  });
  if (!converted) {
    return 0;
  }
  const std::size_t points = converted->points;
  require(3 * points <= positions.size());
  for (std::size_t i = 0; i < 3 * points; ++i) {
    require(std::isfinite(positions[i]));
  }
  positions.resize(3 * points);
  std::vector<float> values(points);
  for (const nodes::ChannelInfo& channel : nodes::listChannels(cloud)) {
    const auto limits = nodes::convertChannel(cloud, *converted, channel, values);
    for (const float value : values) {
      require(std::isfinite(value));
    }
    const auto range = nodes::percentileRange(values, limits.offset, 1.0, 99.0);
    for (const auto& map : {nodes::mapRange(range, limits.offset), nodes::mapRange({limits.low, limits.high})}) {
      require(std::isfinite(static_cast<float>(map.scale)) && std::isfinite(static_cast<float>(map.bias)));
    }
  }
  if (const auto source = nodes::findColors(cloud)) {
    std::vector<std::uint8_t> rgba(4 * points);
    nodes::convertColors(cloud, *converted, *source, rgba);
  }
  (void)nodes::percentileRangeOfAxis(positions, 0, converted->origin.x, 0.0, 100.0);
  return 0;
}
