#include "tools/bench/codec_workloads.h"

#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/point_cloud/point_cloud_builder.h>

#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>

#include "tools/sample/cloudini_writer.h"

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
  const auto count = static_cast<std::uint32_t>(points.size() / kStep);
  draco::PointCloudBuilder builder;
  builder.Start(count);
  const std::array attributes = {builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32),
                                 builder.AddAttribute(draco::GeometryAttribute::GENERIC, 1, draco::DT_FLOAT32),
                                 builder.AddAttribute(draco::GeometryAttribute::GENERIC, 1, draco::DT_UINT16)};
  constexpr std::array<std::size_t, 3> kOffsets = {0, 12, 16};
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < attributes.size(); ++k) {
      builder.SetAttributeValueForPoint(attributes[k], draco::PointIndex(i),
                                        points.data() + std::size_t{i} * kStep + kOffsets[k]);
    }
  }
  const auto cloud = builder.Finalize(false);
  draco::ExpertEncoder encoder(*cloud);
  encoder.SetEncodingMethod(draco::POINT_CLOUD_SEQUENTIAL_ENCODING);
  encoder.SetAttributeQuantization(attributes[0], 14);
  encoder.SetAttributeQuantization(attributes[1], 14);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok()) {
    throw std::logic_error("libdraco does not encode the benchmark's cloud");
  }
  const auto bytes = std::as_bytes(std::span(buffer.data(), buffer.size()));
  return sample::toPayload({bytes.begin(), bytes.end()});
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
