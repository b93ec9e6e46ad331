#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "nodes/points/channel.h"
#include "nodes/points/convert_cloud.h"
#include "nodes/points/point_colors.h"
#include "scenegraph/objects/payload.h"

namespace stillframe::nodes {

/// The cells of a grid seen as the points of a cloud, so that values and colours are read by the conversions of clouds.
struct PackedCells {
  scenegraph::PointCloud records;  ///< fields and data only; "color" of grid_map is named "rgb"
  ConvertedCloud all;              ///< every cell, by the runs that the grid puts there
  std::vector<ChannelInfo> layers;
  std::optional<ColorSource> colors;
  std::optional<ChannelInfo> alpha;  ///< of the colours: a field of its own, or the last byte of `rgba`
};

/// Fields and data of a grid; `all` is empty. The bytes stay where they are.
[[nodiscard]] PackedCells readPackedCells(const std::vector<scenegraph::PackedField>& fields,
                                          const scenegraph::Payload& data);
/// What one cell needs, to the end of its last known field; nullopt beyond 32 bits.
[[nodiscard]] std::optional<std::uint64_t> recordBytes(const std::vector<scenegraph::PackedField>& fields);
/// Writes R, G, B, A for each of `cells.all`; A is 255 where there is no alpha.
void convertCellColors(const PackedCells& cells, std::span<std::uint8_t> rgba);

}  // namespace stillframe::nodes
