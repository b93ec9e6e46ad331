#include "nodes/points/point_colors.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "nodes/points/point_pieces.h"
#include "nodes/points/read_value.h"

namespace stillframe::nodes {
namespace {

using scenegraph::ColorPacking;
using scenegraph::FieldType;
using scenegraph::PackedField;
using scenegraph::PointCloud;

bool equalIgnoringCase(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

const PackedField* findField(const PointCloud& cloud, std::string_view name) {
  const auto found =
      std::ranges::find_if(cloud.fields, [&](const PackedField& f) { return equalIgnoringCase(f.name, name); });
  return found == cloud.fields.end() ? nullptr : &*found;
}

std::optional<ColorSource> packedColors(const PointCloud& cloud, std::string_view name) {
  const PackedField* field = findField(cloud, name);
  if (field == nullptr) {
    return std::nullopt;
  }
  const bool is_single = field->count <= 1;
  if (is_single && field->type == FieldType::Float32) {
    return ColorSource{ColorSource::Kind::PclWord, {field->offset}, field->type};
  }
  if (is_single && (field->type == FieldType::Uint32 || field->type == FieldType::Int32)) {
    const auto kind =
        cloud.color_packing == ColorPacking::PclWord ? ColorSource::Kind::PclWord : ColorSource::Kind::RgbaBytes;
    return ColorSource{kind, {field->offset}, field->type};
  }
  if (field->type == FieldType::Uint8 && (field->count == 3 || field->count == 4)) {
    return ColorSource{ColorSource::Kind::RgbaBytes, {field->offset}, field->type};
  }
  return std::nullopt;
}

std::optional<ColorSource> separateColors(const PointCloud& cloud, std::array<std::string_view, 3> names) {
  ColorSource source{ColorSource::Kind::Separate, {}, FieldType::Unknown};
  for (std::size_t i = 0; i < 3; ++i) {
    const PackedField* field = findField(cloud, names[i]);
    if (field == nullptr || field->type == FieldType::Unknown || (i > 0 && field->type != source.type)) {
      return std::nullopt;
    }
    source.type = field->type;
    source.offsets[i] = field->offset;
  }
  return source;
}

template <typename Paint>
void paintPoints(const ConvertedCloud& converted, const std::byte* data, std::span<std::uint8_t> rgba,
                 const Paint& paint) {
  const auto paintSome = [&](std::size_t /*piece*/, std::size_t offset, std::size_t count, std::size_t first) {
    const std::byte* at = data + offset;
    std::uint8_t* out = rgba.data() + 4 * first;
    for (std::size_t i = 0; i < count; ++i, at += converted.point_step, out += 4) {
      paint(at, out);
      out[3] = 255;
    }
  };
  forPieces(converted, piecesOf(converted), paintSome);
}

void paintWords(const PointCloud& cloud, const ConvertedCloud& converted, std::uint32_t offset,
                std::span<std::uint8_t> rgba) {
  withFieldType(FieldType::Uint32, cloud.is_bigendian, [&]<typename T, bool kSwapped>() {
    paintPoints(converted, cloud.data.bytes.data(), rgba, [&](const std::byte* at, std::uint8_t* out) {
      const auto word = static_cast<std::uint32_t>(readValue<T, kSwapped>(at + offset));
      out[0] = static_cast<std::uint8_t>(word >> 16);
      out[1] = static_cast<std::uint8_t>(word >> 8);
      out[2] = static_cast<std::uint8_t>(word);
    });
  });
}

/// What a separate value is multiplied by to become 0..255.
double separateScale(const PointCloud& cloud, const ConvertedCloud& converted, const ColorSource& source) {
  if (source.type == FieldType::Uint16) {
    return 1.0 / 257.0;
  }
  if (source.type != FieldType::Float32 && source.type != FieldType::Float64) {
    return 1.0;
  }
  const ValueReader read = valueReader(source.type, cloud.is_bigendian);
  for (const PointRun& run : converted.runs) {
    const std::byte* at = cloud.data.bytes.data() + run.offset;
    for (std::size_t i = 0; i < run.count; ++i, at += converted.point_step) {
      for (const std::uint32_t offset : source.offsets) {
        const double value = read(at + offset);
        if (value > 1.0 && std::isfinite(value)) {
          return 1.0;
        }
      }
    }
  }
  return 255.0;
}

}  // namespace

std::optional<ColorSource> findColors(const PointCloud& cloud) {
  for (const std::string_view name : {"rgba", "rgb"}) {
    if (const auto packed = packedColors(cloud, name)) {
      return packed;
    }
  }
  if (const auto separate = separateColors(cloud, {"red", "green", "blue"})) {
    return separate;
  }
  return separateColors(cloud, {"r", "g", "b"});
}

bool isColorField(const ColorSource& source, std::string_view name) {
  const auto is_any = [&](std::initializer_list<std::string_view> names) {
    return std::ranges::any_of(names, [&](std::string_view n) { return equalIgnoringCase(n, name); });
  };
  if (is_any({"rgba", "rgb"})) {
    return true;
  }
  return source.kind == ColorSource::Kind::Separate && is_any({"red", "green", "blue", "alpha", "r", "g", "b", "a"});
}

void convertColors(const PointCloud& cloud, const ConvertedCloud& converted, const ColorSource& source,
                   std::span<std::uint8_t> rgba) {
  const std::byte* const data = cloud.data.bytes.data();
  const auto offsets = source.offsets;
  switch (source.kind) {
    case ColorSource::Kind::PclWord:
      return paintWords(cloud, converted, offsets[0], rgba);
    case ColorSource::Kind::RgbaBytes:
      return paintPoints(converted, data, rgba,
                         [&](const std::byte* at, std::uint8_t* out) { std::memcpy(out, at + offsets[0], 3); });
    case ColorSource::Kind::Separate:
      break;
  }
  if (source.type == FieldType::Int8 || source.type == FieldType::Uint8) {
    return paintPoints(converted, data, rgba, [&](const std::byte* at, std::uint8_t* out) {
      for (std::size_t i = 0; i < 3; ++i) {
        out[i] = std::to_integer<std::uint8_t>(at[offsets[i]]);
      }
    });
  }
  const ValueReader read = valueReader(source.type, cloud.is_bigendian);
  const double scale = separateScale(cloud, converted, source);
  paintPoints(converted, data, rgba, [&](const std::byte* at, std::uint8_t* out) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = read(at + offsets[i]) * scale;
      out[i] = value > 0.0 ? static_cast<std::uint8_t>(std::min(std::rint(value), 255.0)) : std::uint8_t{0};
    }
  });
}

}  // namespace stillframe::nodes
