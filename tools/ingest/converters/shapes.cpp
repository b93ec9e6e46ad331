#include "tools/ingest/converters/shapes.h"

#include <algorithm>
#include <array>
#include <limits>

namespace stillframe::ingest::converters {

Shape vectorShape() {
  Shape shape;
  shape.field<&glm::dvec3::x>("x").field<&glm::dvec3::y>("y").field<&glm::dvec3::z>("z");
  return shape;
}

Shape planarVectorShape() {
  Shape shape;
  shape.field<&glm::dvec2::x>("x").field<&glm::dvec2::y>("y");
  return shape;
}

Shape quaternionShape() {
  Shape shape;
  shape.field<&glm::dquat::x>("x").field<&glm::dquat::y>("y").field<&glm::dquat::z>("z").field<&glm::dquat::w>("w");
  return shape;
}

Shape poseShape() {
  Shape shape;
  shape.row<&tf::RigidTransform::translation>("position", vectorShape())
      .row<&tf::RigidTransform::rotation>("orientation", quaternionShape());
  return shape;
}

Shape colorShape() {
  using scenegraph::EntityColor;
  Shape shape;
  shape.field<&EntityColor::r>("r").field<&EntityColor::g>("g").field<&EntityColor::b>("b").field<&EntityColor::a>("a");
  return shape;
}

Shape packedFieldShape() {
  Shape shape;
  shape.field<&PackedFieldRow::name>("name").field<&PackedFieldRow::offset>("offset").field<&PackedFieldRow::type>(
      "type");
  return shape;
}

std::vector<scenegraph::PackedField> packedFields(const std::vector<PackedFieldRow>& rows) {
  using scenegraph::FieldType;
  static constexpr std::array kTypes = {FieldType::Unknown, FieldType::Uint8,   FieldType::Int8,
                                        FieldType::Uint16,  FieldType::Int16,   FieldType::Uint32,
                                        FieldType::Int32,   FieldType::Float32, FieldType::Float64};
  std::vector<scenegraph::PackedField> fields;
  fields.reserve(rows.size());
  for (const PackedFieldRow& row : rows) {
    fields.push_back(
        {std::string(row.name), row.offset, row.type < kTypes.size() ? kTypes[row.type] : FieldType::Unknown, 1});
  }
  return fields;
}

scenegraph::FieldType fieldType(std::uint32_t number) noexcept {
  const bool is_known = number <= static_cast<std::uint32_t>(scenegraph::FieldType::Float64);
  return is_known ? static_cast<scenegraph::FieldType>(number) : scenegraph::FieldType::Unknown;
}

std::uint32_t countOf(std::size_t bytes, std::uint32_t stride) noexcept {
  constexpr std::size_t kMax = std::numeric_limits<std::uint32_t>::max();
  return stride == 0 ? 0 : static_cast<std::uint32_t>(std::min(bytes / stride, kMax));
}

}  // namespace stillframe::ingest::converters
