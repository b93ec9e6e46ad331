#include "tools/bench/codec_workloads.h"

#include <draco/compression/decode.h>

#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include "tools/sample/cloudini_writer.h"
#include "tools/sample/draco_writer.h"

namespace stillframe::bench {
namespace {

constexpr std::uint32_t kStep = 18;

std::vector<std::byte> scan(std::uint32_t points) {
  constexpr std::uint32_t kRings = 32;
  const std::uint32_t columns = points / kRings + 1;
  std::vector<std::byte> bytes(std::size_t{points} * kStep);
  std::mt19937 random(1);
  std::normal_distribution<float> noise(0.0F, 0.008F);
  for (std::uint32_t i = 0; i < points; ++i) {
    const auto ring = static_cast<std::uint16_t>(i % kRings);
    const std::uint32_t column = i / kRings;
    const float azimuth = 6.2831853F * static_cast<float>(column) / static_cast<float>(columns);
    const float range = 12.0F + 6.0F * std::sin(3.0F * azimuth) + noise(random);
    const std::array<float, 4> values = {range * std::cos(azimuth), range * std::sin(azimuth),
                                         range * (static_cast<float>(ring) - 16.0F) * 0.02F,
                                         static_cast<float>(random() % 64)};
    std::memcpy(bytes.data() + std::size_t{i} * kStep, values.data(), sizeof values);
    std::memcpy(bytes.data() + std::size_t{i} * kStep + 16, &ring, sizeof ring);
  }
  return bytes;
}

scenegraph::Payload toCloudini(const std::vector<std::byte>& points) {
  using nodes::cloudini::ValueType;
  nodes::cloudini::Header header;
  header.version = 5;
  header.width = static_cast<std::uint32_t>(points.size() / kStep);
  header.point_step = kStep;
  header.fields = {{"x", 0, ValueType::Float32, 0.001F},
                   {"y", 4, ValueType::Float32, 0.001F},
                   {"z", 8, ValueType::Float32, 0.001F},
                   {"intensity", 12, ValueType::Float32, 0.001F},
                   {"ring", 16, ValueType::Uint16, {}}};
  return sample::toPayload(
      sample::writeCloudini(header, points, {.section_mode = sample::SectionMode::DifferenceRuns}));
}

scenegraph::Payload toDraco(const std::vector<std::byte>& points) {
  using scenegraph::FieldType;
  scenegraph::PointCloud cloud;
  cloud.width = static_cast<std::uint32_t>(points.size() / kStep);
  cloud.point_step = kStep;
  cloud.row_step = cloud.width * kStep;
  cloud.fields = {{"x", 0, FieldType::Float32},
                  {"y", 4, FieldType::Float32},
                  {"z", 8, FieldType::Float32},
                  {"intensity", 12, FieldType::Float32},
                  {"ring", 16, FieldType::Uint16}};
  cloud.data.bytes = points;
  return sample::toPayload(sample::writeDraco(cloud, 14));
}

}  // namespace

CodecWorkload makeCodecWorkload(std::uint32_t points) {
  CodecWorkload workload;
  workload.points = scan(points);
  workload.cloudini = toCloudini(workload.points);
  workload.draco = toDraco(workload.points);
  return workload;
}

bool decodeBareDraco(const scenegraph::Payload& blob) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(blob.bytes.data()), blob.bytes.size());
  return draco::Decoder().DecodePointCloudFromBuffer(&buffer).ok();
}

}  // namespace stillframe::bench
