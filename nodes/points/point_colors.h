#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "nodes/points/convert_cloud.h"
#include "scenegraph/objects/point_cloud.h"

namespace stillframe::nodes {

/// Where a cloud keeps a colour per point.
struct ColorSource {
  enum class Kind : std::uint8_t {
    RgbaBytes,  ///< bytes R, G, B in increasing address order at offsets[0]
    PclWord,    ///< 0xAARRGGBB in the cloud's byte order at offsets[0], whatever type it is declared as
    Separate,   ///< one field each, all of `type`
  };
  Kind kind = Kind::RgbaBytes;
  std::array<std::uint32_t, 3> offsets{};
  scenegraph::FieldType type = scenegraph::FieldType::Unknown;  ///< Separate only
};

/// The colour of a cloud, or nullopt: a 4-byte field `rgba` or `rgb` (FLOAT32 is always PCL's word, integers go by
/// PointCloud::color_packing; 3 or 4 UINT8 are bytes), else fields red, green, blue or r, g, b of one type.
[[nodiscard]] std::optional<ColorSource> findColors(const scenegraph::PointCloud& cloud);
/// Whether a field is part of that colour (its alpha too), so that no list offers it as a number.
[[nodiscard]] bool isColorField(const ColorSource& source, std::string_view name);

/// Writes R, G, B, 255 for each point of `converted`; alpha is ignored. `rgba` has 4 bytes a point. Any thread.
///
/// Separate integers of 8 bits are taken as they are, of 16 bits by their upper byte, of 32 bits clamped to 0..255;
/// floats are 0..1, or 0..255 when any of the cloud exceeds 1; NaN is 0.
void convertColors(const scenegraph::PointCloud& cloud, const ConvertedCloud& converted, const ColorSource& source,
                   std::span<std::uint8_t> rgba);

}  // namespace stillframe::nodes
