#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/objects/laser_scan.h"
#include "tools/sample/ros2_messages.h"

namespace stillframe::sample {

[[nodiscard]] Ros2Type laserScanType();
[[nodiscard]] Ros2Type gridMapType();

/// One layer of a grid map: rows x columns values as grid_map stores them, column by column, row 0 at the greatest x
/// and column 0 at the greatest y.
struct MapLayerValues {
  std::string name;
  std::vector<float> values;
};
struct MapMessage {
  std::int64_t stamp_ns = 0;
  std::string frame_id;
  double resolution_m = 0.0;
  std::uint32_t rows = 0;     ///< along x
  std::uint32_t columns = 0;  ///< along y
  std::vector<MapLayerValues> layers;
};

/// Little-endian CDR with its encapsulation header. The map's centre is the origin of its frame.
[[nodiscard]] std::vector<std::byte> serializeLaserScan(const scenegraph::LaserScan& scan);
[[nodiscard]] std::vector<std::byte> serializeGridMap(const MapMessage& map);

}  // namespace stillframe::sample
