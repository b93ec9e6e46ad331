#include "nodes/points/packed_cells.h"

#include <algorithm>

#include "nodes/points/read_value.h"

namespace stillframe::nodes {

using scenegraph::FieldType;
using scenegraph::PackedField;

std::optional<std::uint64_t> recordBytes(const std::vector<PackedField>& fields) {
  std::uint64_t bytes = 0;
  for (const PackedField& field : fields) {
    const std::uint64_t size = scenegraph::byteSize(field.type);
    const std::uint64_t values = std::clamp<std::uint64_t>(field.count, 1, kMaxChannelValues);
    bytes = size == 0 ? bytes : std::max(bytes, field.offset + size * values);
  }
  return bytes >> 32 == 0 ? std::optional(bytes) : std::nullopt;
}

PackedCells readPackedCells(const std::vector<PackedField>& fields, const scenegraph::Payload& data) {
  PackedCells cells;
  cells.records.fields = fields;
  cells.records.data = data;
  cells.records.is_bigendian = false;
  for (PackedField& field : cells.records.fields) {
    if (field.name == "color" && field.type == FieldType::Float32) {
      field.name = "rgb";
    }
  }
  cells.colors = findColors(cells.records);
  for (const PackedField& field : cells.records.fields) {
    const std::uint32_t bytes = scenegraph::byteSize(field.type);
    if (bytes == 0 || std::ranges::find(cells.layers, field.name, &ChannelInfo::name) != cells.layers.end()) {
      continue;
    }
    if (cells.colors && isColorField(*cells.colors, field.name)) {
      if (field.name == "alpha" || field.name == "a") {
        cells.alpha = ChannelInfo{field.name, field.offset, field.type};
      }
      continue;
    }
    for (std::uint32_t i = 0; i < std::clamp(field.count, 1U, kMaxChannelValues); ++i) {
      cells.layers.push_back({field.count > 1 ? field.name + "[" + std::to_string(i) + "]" : field.name,
                              field.offset + i * bytes, field.type});
    }
  }
  if (cells.colors && cells.colors->kind == ColorSource::Kind::RgbaBytes) {
    for (const PackedField& field : cells.records.fields) {
      if (field.name == "rgba" && field.offset == cells.colors->offsets[0] &&
          byteSize(field.type) * std::max(field.count, 1U) >= 4) {
        cells.alpha = ChannelInfo{"alpha", field.offset + 3, FieldType::Uint8};
      }
    }
  }
  return cells;
}

void convertCellColors(const PackedCells& cells, std::span<std::uint8_t> rgba) {
  if (!cells.colors || cells.all.points == 0) {
    return;
  }
  convertColors(cells.records, cells.all, *cells.colors, rgba);
  if (!cells.alpha) {
    return;
  }
  const ValueReader read = valueReader(cells.alpha->type, false);
  const bool is_float = cells.alpha->type == FieldType::Float32 || cells.alpha->type == FieldType::Float64;
  const double scale = is_float ? 255.0 : cells.alpha->type == FieldType::Uint16 ? 1.0 / 257.0 : 1.0;
  std::uint8_t* out = rgba.data() + 3;
  for (const PointRun& run : cells.all.runs) {
    const std::byte* at = cells.records.data.bytes.data() + run.offset + cells.alpha->offset;
    for (std::size_t i = 0; i < run.count; ++i, at += cells.all.point_step, out += 4) {
      const double value = read(at) * scale;
      *out = static_cast<std::uint8_t>(value >= 0.0 ? std::min(value + 0.5, 255.0) : 0.0);  // NaN is 0
    }
  }
}

}  // namespace stillframe::nodes
