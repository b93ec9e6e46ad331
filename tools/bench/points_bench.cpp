// Cloud conversion against memcpy of the same bytes, in one run: the counter `of_memcpy` is memcpy's time divided by
// ours (target 0.5 or better for the common layouts).
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "nodes/points/channel.h"
#include "nodes/points/convert_cloud.h"
#include "nodes/points/point_colors.h"
#include "scenegraph/stopwatch.h"

namespace stillframe {
namespace {

using scenegraph::FieldType;
using scenegraph::PackedField;
using scenegraph::PointCloud;

enum class Layout : std::uint8_t { Float32, Float32WithNan, Float32BigEndian, Float64, Int16 };

/// Random points of `step` bytes: x, y, z first, then a FLOAT32 intensity where it fits, then padding.
PointCloud makeCloud(std::size_t points, std::uint32_t step, Layout layout) {
  PointCloud cloud;
  cloud.width = static_cast<std::uint32_t>(points);
  cloud.point_step = step;
  cloud.row_step = cloud.width * step;
  cloud.is_bigendian = layout == Layout::Float32BigEndian;
  const FieldType type = layout == Layout::Float64 ? FieldType::Float64
                         : layout == Layout::Int16 ? FieldType::Int16
                                                   : FieldType::Float32;
  const std::uint32_t size = scenegraph::byteSize(type);
  cloud.fields = {{"x", 0, type}, {"y", size, type}, {"z", 2 * size, type}};
  if (3 * size + 4 <= step) {
    cloud.fields.push_back({"intensity", 3 * size, FieldType::Float32});
  }
  auto bytes = std::make_shared<std::vector<std::byte>>(points * step);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> coordinate(-50.0F, 50.0F);
  for (std::size_t i = 0; i < points; ++i) {
    for (std::uint32_t k = 0; k < 4; ++k) {
      const float value = layout == Layout::Float32WithNan && random() % 256 == 0
                              ? std::numeric_limits<float>::quiet_NaN()
                              : coordinate(random);
      std::byte* const at = bytes->data() + i * step + std::size_t{k} * size;
      const auto put = [&](auto number) {
        if (std::size_t{k} * size + sizeof(number) <= step) {
          std::memcpy(at, &number, sizeof(number));
        }
      };
      if (layout == Layout::Float64) {
        put(static_cast<double>(value));
      } else if (layout == Layout::Int16) {
        put(static_cast<std::int16_t>(value));
      } else {
        put(cloud.is_bigendian ? std::bit_cast<float>(std::byteswap(std::bit_cast<std::uint32_t>(value))) : value);
      }
    }
  }
  cloud.data = {*bytes, bytes};
  return cloud;
}

using scenegraph::secondsSince;
using Clock = std::chrono::steady_clock;

void reportAgainstMemcpy(benchmark::State& state, const PointCloud& cloud, double ours, double copying) {
  const auto bytes = static_cast<double>(cloud.data.bytes.size());
  const auto rounds = static_cast<double>(state.iterations());
  state.counters["of_memcpy"] = copying / ours;
  state.counters["memcpy_GB/s"] = bytes * rounds / copying * 1e-9;
  state.counters["Mpoints/s"] = static_cast<double>(cloud.width) * rounds / ours * 1e-6;
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes * rounds));
}

void convertPositions(benchmark::State& state) {
  const PointCloud cloud = makeCloud(static_cast<std::size_t>(state.range(0)),
                                     static_cast<std::uint32_t>(state.range(1)), static_cast<Layout>(state.range(2)));
  std::vector<float> positions(3 * std::size_t{cloud.width});
  std::vector<std::byte> copy(cloud.data.bytes.size());
  double ours = 0.0;
  double copying = 0.0;
  for (auto _ : state) {
    const auto start = Clock::now();
    const auto converted = nodes::convertCloud(cloud, [&](std::size_t) { return positions.data(); });
    benchmark::DoNotOptimize(converted->points);
    benchmark::ClobberMemory();
    const double seconds = secondsSince(start);
    state.SetIterationTime(seconds);
    ours += seconds;
    const auto copy_start = Clock::now();
    std::memcpy(copy.data(), cloud.data.bytes.data(), copy.size());
    benchmark::DoNotOptimize(copy.data());
    benchmark::ClobberMemory();
    copying += secondsSince(copy_start);
  }
  reportAgainstMemcpy(state, cloud, ours, copying);
}

void convertIntensity(benchmark::State& state) {
  const PointCloud cloud =
      makeCloud(static_cast<std::size_t>(state.range(0)), static_cast<std::uint32_t>(state.range(1)), Layout::Float32);
  std::vector<float> positions(3 * std::size_t{cloud.width});
  const auto converted = nodes::convertCloud(cloud, [&](std::size_t) { return positions.data(); });
  std::vector<float> values(converted->points);
  const auto channel = nodes::listChannels(cloud).front();
  std::vector<std::byte> copy(cloud.data.bytes.size());
  double ours = 0.0;
  double copying = 0.0;
  for (auto _ : state) {
    const auto start = Clock::now();
    benchmark::DoNotOptimize(nodes::convertChannel(cloud, *converted, channel, values));
    benchmark::ClobberMemory();
    const double seconds = secondsSince(start);
    state.SetIterationTime(seconds);
    ours += seconds;
    const auto copy_start = Clock::now();
    std::memcpy(copy.data(), cloud.data.bytes.data(), copy.size());
    benchmark::DoNotOptimize(copy.data());
    benchmark::ClobberMemory();
    copying += secondsSince(copy_start);
  }
  reportAgainstMemcpy(state, cloud, ours, copying);
}

void layouts(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"points", "step", "layout"})->UseManualTime()->Unit(benchmark::kMicrosecond);
  for (const std::int64_t points : {60'000, 1'000'000}) {
    for (const std::int64_t step : {12, 16, 18, 20, 22, 24, 28, 32}) {
      benchmark->Args({points, step, static_cast<std::int64_t>(Layout::Float32)});
    }
    benchmark->Args({points, 16, static_cast<std::int64_t>(Layout::Float32WithNan)});
    benchmark->Args({points, 16, static_cast<std::int64_t>(Layout::Float32BigEndian)});
    benchmark->Args({points, 32, static_cast<std::int64_t>(Layout::Float64)});
    benchmark->Args({points, 8, static_cast<std::int64_t>(Layout::Int16)});
  }
}

BENCHMARK(convertPositions)->Apply(layouts);
BENCHMARK(convertIntensity)
    ->ArgNames({"points", "step"})
    ->ArgsProduct({{60'000, 1'000'000}, {16, 32}})
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace stillframe

BENCHMARK_MAIN();
