#include <cmath>
#include <cstring>
#include <stdexcept>

#include "nodes/points/codecs/cloudini.h"
#include "nodes/points/codecs/draco.h"
#include "nodes/points/convert_cloud.h"
#include "tools/bench/codec_workloads.h"
#include "tools/bench/tf_bench_lines.h"
#include "tools/cli/bench_results.h"

namespace stillframe::cli {
namespace {

/// A cloud of `points` on a helix, x, y, z and intensity as a lidar driver sends them.
scenegraph::PointCloud makeCloud(std::uint32_t points, std::vector<std::byte>& data) {
  constexpr std::uint32_t kStep = 16;
  data.resize(std::size_t{points} * kStep);
  for (std::uint32_t i = 0; i < points; ++i) {
    const float angle = static_cast<float>(i) * 0.001F;
    const float values[4] = {20.0F * std::cos(angle), 20.0F * std::sin(angle), static_cast<float>(i % 1000) * 0.01F,
                             static_cast<float>(i % 256)};
    std::memcpy(data.data() + std::size_t{i} * kStep, values, sizeof values);
  }
  scenegraph::PointCloud cloud;
  cloud.frame_id = "lidar";
  cloud.width = points;
  cloud.point_step = kStep;
  cloud.row_step = points * kStep;
  using scenegraph::FieldType;
  cloud.fields = {{"x", 0, FieldType::Float32},
                  {"y", 4, FieldType::Float32},
                  {"z", 8, FieldType::Float32},
                  {"intensity", 12, FieldType::Float32}};
  cloud.data.bytes = data;
  return cloud;
}

}  // namespace

void benchClouds(std::vector<BenchResult>& results) {
  std::vector<std::byte> data;
  const scenegraph::PointCloud cloud = makeCloud(4'000'000, data);
  std::vector<std::byte> copy(data.size());
  const double megabytes = static_cast<double>(data.size()) * 1e-6;
  const double copied_s = bestSecondsOf(7, [&] { std::memcpy(copy.data(), data.data(), data.size()); });
  std::vector<float> positions(std::size_t{cloud.width} * 3);
  std::size_t written = 0;
  const double converted_s = bestSecondsOf(7, [&] {
    const auto converted = nodes::convertCloud(cloud, [&](std::size_t) { return positions.data(); });
    written = converted ? converted->points : 0;
  });
  if (written != cloud.width || copy.back() != data.back()) {
    throw std::logic_error("the benchmark's cloud was not converted");
  }
  results.push_back({"memcpy of a cloud of 4 M points", megabytes / copied_s, "MB/s"});
  results.push_back({"cloud of 4 M points, conversion", megabytes / converted_s, "MB/s"});
  results.push_back({"cloud conversion / memcpy", copied_s / converted_s, "", {}, 0.5});
}

void benchCodecs(std::vector<BenchResult>& results) {
  const bench::CodecWorkload workload = bench::makeCodecWorkload(500'000);
  std::vector<std::byte> copy(workload.points.size());
  const double megabytes = static_cast<double>(copy.size()) * 1e-6;
  const double copied_s =
      bestSecondsOf(7, [&] { std::memcpy(copy.data(), workload.points.data(), workload.points.size()); });
  bool is_decoded = true;
  const auto keep = [&](bool is_good) { is_decoded = is_decoded && is_good; };
  const double cloudini_s = bestSecondsOf(5, [&] { keep(nodes::decodeCloudini(workload.cloudini).has_value()); });
  const double draco_s = bestSecondsOf(5, [&] { keep(nodes::decodeDraco(workload.draco).has_value()); });
  const double bare_s = bestSecondsOf(5, [&] { keep(bench::decodeBareDraco(workload.draco)); });
  if (!is_decoded || copy.back() != workload.points.back()) {
    throw std::logic_error("the benchmark's clouds were not decoded");
  }
  results.push_back({"memcpy of 500 000 points, 9 MB", megabytes / copied_s, "MB/s"});
  results.push_back({"Cloudini decoding to 500 000 points, 9 MB", megabytes / cloudini_s, "MB/s"});
  results.push_back({"Cloudini decoding / memcpy", copied_s / cloudini_s, ""});
  results.push_back({"Draco decoding to 500 000 points, 9 MB", megabytes / draco_s, "MB/s"});
  results.push_back({"Draco decoding / bare library", bare_s / draco_s, "", {}, 0.8});
}

void benchTransforms(std::vector<BenchResult>& results) {
  constexpr double kSecondsPerCase = 0.3;
  for (const bench::BenchLine& line : bench::runTfBench(kSecondsPerCase)) {
    BenchResult result{line.name, line.value, line.unit};
    (line.lower_is_better ? result.at_most : result.at_least) = line.target;
    results.push_back(std::move(result));
  }
}

}  // namespace stillframe::cli
