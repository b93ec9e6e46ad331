#include "nodes/points/codecs/draco.h"

#include <draco/compression/config/decoder_options.h>

#include <array>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nodes/points/codecs/draco_bounded.h"

namespace stillframe::nodes {
namespace {

using draco::GeometryAttribute;
using scenegraph::FieldType;
using std::unexpected;

unexpected<CodecError> fail(CodecErrorCode code, const std::string& message) {
  return unexpected(CodecError{code, message});
}

template <typename Decoder, typename Geometry>
draco::Status run(DracoBudget& budget, draco::DecoderBuffer& buffer, Geometry& geometry) {
  Decoder decoder(budget);
  return decoder.Decode(draco::DecoderOptions(), &buffer, &geometry);
}

CodecError explain(const draco::Status& status, const DracoBudget& budget, std::size_t bytes) {
  if (const auto& claim = budget.refused()) {
    const std::string what = claim->orientations > 0 ? std::to_string(claim->orientations) + " texture orientations of "
                                                     : std::to_string(claim->points) + " points and ";
    return {CodecErrorCode::ImplausibleSize, "the Draco stream claims " + what + std::to_string(claim->faces) +
                                                 " faces in " + std::to_string(bytes) + " bytes"};
  }
  const bool is_version = status.code() == draco::Status::UNSUPPORTED_VERSION ||
                          status.code() == draco::Status::UNKNOWN_VERSION ||
                          status.code() == draco::Status::UNSUPPORTED_FEATURE;
  return {is_version ? CodecErrorCode::UnsupportedVersion : CodecErrorCode::CorruptCloud,
          "libdraco does not decode the cloud of " + std::to_string(bytes) + " bytes" +
              (status.error_msg_string().empty() ? "" : ": " + status.error_msg_string())};
}

std::expected<std::unique_ptr<draco::PointCloud>, CodecError> decodeGeometry(std::span<const std::byte> blob) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(blob.data()), blob.size());
  draco::DracoHeader header;
  draco::DecoderBuffer ahead(buffer);
  if (!draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok()) {
    return fail(CodecErrorCode::MalformedHeader,
                std::to_string(blob.size()) + " bytes that do not begin with a Draco header");
  }
  DracoBudget budget(maxDecodedBytes(blob.size()));
  draco::Status status;
  std::unique_ptr<draco::PointCloud> cloud;
  if (header.encoder_type == draco::TRIANGULAR_MESH) {
    auto mesh = std::make_unique<draco::Mesh>();
    status = header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING
                 ? run<BoundedEdgebreakerMesh>(budget, buffer, *mesh)
                 : run<BoundedSequentialMesh>(budget, buffer, *mesh);
    cloud = std::move(mesh);
  } else if (header.encoder_type == draco::POINT_CLOUD) {
    cloud = std::make_unique<draco::PointCloud>();
    status = header.encoder_method == draco::POINT_CLOUD_KD_TREE_ENCODING
                 ? run<BoundedKdTreeCloud>(budget, buffer, *cloud)
                 : run<BoundedSequentialCloud>(budget, buffer, *cloud);
  } else {
    return fail(CodecErrorCode::MalformedHeader, "the Draco header names geometry of type " +
                                                     std::to_string(header.encoder_type) + ", which does not exist");
  }
  if (!status.ok()) {
    return unexpected(explain(status, budget, blob.size()));
  }
  return cloud;
}

FieldType fieldType(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return FieldType::Int8;
    case draco::DT_UINT8:
    case draco::DT_BOOL:
      return FieldType::Uint8;
    case draco::DT_INT16:
      return FieldType::Int16;
    case draco::DT_UINT16:
      return FieldType::Uint16;
    case draco::DT_INT32:
      return FieldType::Int32;
    case draco::DT_UINT32:
      return FieldType::Uint32;
    case draco::DT_FLOAT32:
      return FieldType::Float32;
    case draco::DT_FLOAT64:
    case draco::DT_INT64:
    case draco::DT_UINT64:
      return FieldType::Float64;
    default:
      return FieldType::Unknown;
  }
}

std::span<const char* const> componentNames(GeometryAttribute::Type type) {
  static constexpr std::array kPosition = {"x", "y", "z"};
  static constexpr std::array kColor = {"red", "green", "blue", "alpha"};
  static constexpr std::array kNormal = {"nx", "ny", "nz"};
  switch (type) {
    case GeometryAttribute::POSITION:
      return kPosition;
    case GeometryAttribute::COLOR:
      return kColor;
    case GeometryAttribute::NORMAL:
      return kNormal;
    default:
      return {};
  }
}

/// Appends the fields of attribute `id`, from the point's byte `offset` on.
void addFields(const draco::PointCloud& cloud, int id, std::uint32_t offset,
               std::vector<scenegraph::PackedField>& fields) {
  const draco::PointAttribute& attribute = *cloud.attribute(id);
  const FieldType type = fieldType(attribute.data_type());
  const std::uint32_t components = attribute.num_components();
  std::string name;
  if (const draco::AttributeMetadata* const metadata = cloud.GetAttributeMetadataByAttributeId(id)) {
    (void)metadata->GetEntryString("name", &name);
  }
  const auto parts = componentNames(attribute.attribute_type());
  if (components <= parts.size() && (components > 1 || name.empty())) {
    for (std::uint32_t i = 0; i < components; ++i) {
      fields.push_back({parts[i], offset + i * scenegraph::byteSize(type), type, 1});
    }
    return;
  }
  fields.push_back({name.empty() ? "generic_" + std::to_string(id) : name, offset, type, components});
}

/// Copies an attribute into the points; false when its mapping points outside its values.
template <typename Convert>
bool copyValues(const draco::PointAttribute& attribute, std::uint32_t points, std::size_t point_step, std::byte* target,
                const Convert& convert) {
  const auto values = static_cast<std::uint32_t>(attribute.size());
  const auto stride = static_cast<std::size_t>(attribute.byte_stride());
  const auto begin = static_cast<std::size_t>(attribute.byte_offset());
  if (values > 0 && begin + values * stride > attribute.buffer()->data_size()) {
    return false;
  }
  const std::uint8_t* const source = attribute.buffer()->data() + begin;
  for (std::uint32_t i = 0; i < points; ++i) {
    const std::uint32_t value = attribute.mapped_index(draco::PointIndex(i)).value();
    if (value >= values) {
      return false;
    }
    convert(source + value * stride, target);
    target += point_step;
  }
  return true;
}

template <typename Integer>
void toDoubles(const std::uint8_t* source, std::byte* target, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i) {
    Integer integer{};
    std::memcpy(&integer, source + i * sizeof(Integer), sizeof(Integer));
    const auto value = static_cast<double>(integer);
    std::memcpy(target + i * sizeof(double), &value, sizeof(double));
  }
}

bool copyAttribute(const draco::PointAttribute& attribute, std::uint32_t points, std::size_t point_step,
                   std::byte* target) {
  const std::uint32_t components = attribute.num_components();
  const auto copy = [&](const auto& convert) { return copyValues(attribute, points, point_step, target, convert); };
  switch (attribute.data_type()) {
    case draco::DT_INT64:
      return copy([&](const std::uint8_t* from, std::byte* to) { toDoubles<std::int64_t>(from, to, components); });
    case draco::DT_UINT64:
      return copy([&](const std::uint8_t* from, std::byte* to) { toDoubles<std::uint64_t>(from, to, components); });
    default:
      break;
  }
  const std::size_t size = std::size_t{components} * scenegraph::byteSize(fieldType(attribute.data_type()));
  switch (size) {
    case 12:
      return copy([](const std::uint8_t* from, std::byte* to) { std::memcpy(to, from, 12); });
    case 4:
      return copy([](const std::uint8_t* from, std::byte* to) { std::memcpy(to, from, 4); });
    default:
      return copy([&](const std::uint8_t* from, std::byte* to) { std::memcpy(to, from, size); });
  }
}

std::expected<scenegraph::PointCloud, CodecError> pack(const draco::PointCloud& source, std::size_t blob_bytes) {
  scenegraph::PointCloud cloud;
  std::vector<std::uint32_t> offsets;
  std::uint64_t point_step = 0;
  for (int id = 0; id < source.num_attributes(); ++id) {
    const draco::PointAttribute& attribute = *source.attribute(id);
    if (attribute.buffer() == nullptr || fieldType(attribute.data_type()) == FieldType::Unknown) {
      return fail(CodecErrorCode::CorruptCloud,
                  "attribute " + std::to_string(id) + " of the Draco cloud has no values");
    }
    offsets.push_back(static_cast<std::uint32_t>(point_step));
    addFields(source, id, offsets.back(), cloud.fields);
    point_step += std::uint64_t{attribute.num_components()} * scenegraph::byteSize(fieldType(attribute.data_type()));
  }
  const std::uint64_t bytes = point_step * source.num_points();
  if (bytes > maxDecodedBytes(blob_bytes) || point_step > UINT32_MAX) {
    return fail(CodecErrorCode::ImplausibleSize, "the Draco cloud of " + std::to_string(blob_bytes) + " bytes has " +
                                                     std::to_string(source.num_points()) + " points of " +
                                                     std::to_string(point_step) + " bytes");
  }
  cloud.width = source.num_points();
  cloud.point_step = static_cast<std::uint32_t>(point_step);
  cloud.row_step = static_cast<std::uint32_t>(bytes);
  auto points = std::make_shared<std::vector<std::byte>>(static_cast<std::size_t>(bytes));
  for (int id = 0; id < source.num_attributes() && cloud.width > 0; ++id) {
    if (!copyAttribute(*source.attribute(id), cloud.width, cloud.point_step,
                       points->data() + offsets[static_cast<std::size_t>(id)])) {
      return fail(CodecErrorCode::CorruptCloud,
                  "attribute " + std::to_string(id) + " of the Draco cloud has fewer values than its points name");
    }
  }
  cloud.is_dense = false;
  cloud.data = {*points, points};
  return cloud;
}

}  // namespace

std::expected<scenegraph::PointCloud, CodecError> decodeDraco(const scenegraph::Payload& blob) {
  try {
    const auto geometry = decodeGeometry(blob.bytes);
    if (!geometry) {
      return unexpected(geometry.error());
    }
    return pack(**geometry, blob.bytes.size());
  } catch (const std::exception& error) {  // libdraco's containers: no memory, a length beyond any
    return fail(CodecErrorCode::CorruptCloud,
                "libdraco gave up on " + std::to_string(blob.bytes.size()) + " bytes: " + error.what());
  }
}

}  // namespace stillframe::nodes
