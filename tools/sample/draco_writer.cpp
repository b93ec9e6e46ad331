#include "tools/sample/draco_writer.h"

#include <draco/compression/expert_encode.h>
#include <draco/point_cloud/point_cloud_builder.h>

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>

namespace stillframe::sample {
namespace {

draco::DataType dataType(scenegraph::FieldType type) {
  using scenegraph::FieldType;
  switch (type) {
    case FieldType::Uint8:
      return draco::DT_UINT8;
    case FieldType::Uint16:
      return draco::DT_UINT16;
    case FieldType::Uint32:
      return draco::DT_UINT32;
    case FieldType::Float32:
      return draco::DT_FLOAT32;
    default:
      throw std::logic_error("a type that the Draco writer does not know");
  }
}

}  // namespace

std::vector<std::byte> writeDraco(const scenegraph::PointCloud& cloud, int position_bits) {
  const std::uint32_t points = cloud.width * cloud.height;
  draco::PointCloudBuilder builder;
  builder.Start(points);
  const auto fill = [&](int attribute, std::size_t offset) {
    for (std::uint32_t i = 0; i < points; ++i) {
      builder.SetAttributeValueForPoint(attribute, draco::PointIndex(i),
                                        cloud.data.bytes.data() + std::size_t{i} * cloud.point_step + offset);
    }
  };
  const auto& fields = cloud.fields;
  if (fields.size() < 3 || fields[0].name != "x" || fields[2].offset != fields[0].offset + 8) {
    throw std::logic_error("the Draco writer wants x, y and z first");
  }
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  fill(position, fields[0].offset);
  std::vector<int> attributes;
  for (const auto& field : std::span(fields).subspan(3)) {
    attributes.push_back(builder.AddAttribute(draco::GeometryAttribute::GENERIC, 1, dataType(field.type)));
    fill(attributes.back(), field.offset);
  }
  const auto encoded = builder.Finalize(false);
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    auto metadata = std::make_unique<draco::AttributeMetadata>();
    metadata->AddEntryString("name", fields[i + 3].name);
    encoded->AddAttributeMetadata(attributes[i], std::move(metadata));
  }
  draco::ExpertEncoder encoder(*encoded);
  encoder.SetEncodingMethod(draco::POINT_CLOUD_SEQUENTIAL_ENCODING);
  encoder.SetAttributeQuantization(position, position_bits);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeToBuffer(&buffer).ok()) {
    throw std::logic_error("libdraco does not encode the cloud");
  }
  const auto bytes = std::as_bytes(std::span(buffer.data(), buffer.size()));
  return {bytes.begin(), bytes.end()};
}

}  // namespace stillframe::sample
