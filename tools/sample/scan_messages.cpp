#include "tools/sample/scan_messages.h"

#include "tools/ingest/cdr_writer.h"
#include "tools/sample/definition_text.h"

namespace stillframe::sample {
namespace {

constexpr std::string_view kLaserScan =
    "std_msgs/Header header # timestamp in the header is the acquisition time of the first ray in the scan\n"
    "float32 angle_min\n"
    "float32 angle_max\n"
    "float32 angle_increment\n"
    "float32 time_increment\n"
    "float32 scan_time\n"
    "float32 range_min\n"
    "float32 range_max\n"
    "float32[] ranges\n"
    "float32[] intensities\n" STILLFRAME_HEADER;

constexpr std::string_view kGridMap =
    "std_msgs/Header header\n"
    "grid_map_msgs/GridMapInfo info\n"
    "string[] layers\n"
    "string[] basic_layers\n"
    "std_msgs/Float32MultiArray[] data\n"
    "uint16 outer_start_index\n"
    "uint16 inner_start_index\n" STILLFRAME_SEPARATOR
    "MSG: grid_map_msgs/GridMapInfo\n"
    "float64 resolution\n"
    "float64 length_x\n"
    "float64 length_y\n"
    "geometry_msgs/Pose pose\n" STILLFRAME_POSE STILLFRAME_SEPARATOR
    "MSG: std_msgs/Float32MultiArray\n"
    "std_msgs/MultiArrayLayout layout\n"
    "float32[] data\n" STILLFRAME_SEPARATOR
    "MSG: std_msgs/MultiArrayLayout\n"
    "std_msgs/MultiArrayDimension[] dim\n"
    "uint32 data_offset\n" STILLFRAME_SEPARATOR
    "MSG: std_msgs/MultiArrayDimension\n"
    "string label\n"
    "uint32 size\n"
    "uint32 stride\n" STILLFRAME_HEADER;

template <typename Values>
void floats(ingest::CdrWriter& cdr, const Values& values) {
  cdr.length(values.size());
  for (const auto value : values) {
    cdr.number(static_cast<float>(value));
  }
}

}  // namespace

Ros2Type laserScanType() { return {"sensor_msgs/msg/LaserScan", kLaserScan}; }
Ros2Type gridMapType() { return {"grid_map_msgs/msg/GridMap", kGridMap}; }

std::vector<std::byte> serializeLaserScan(const scenegraph::LaserScan& scan) {
  ingest::CdrWriter cdr;
  const auto beams = static_cast<double>(scan.ranges_m.size());
  cdr.header(scan.stamp.ns, scan.frame_id);
  for (const double value :
       {scan.angle_min_rad, scan.angle_min_rad + (beams - 1.0) * scan.angle_increment_rad, scan.angle_increment_rad,
        scan.time_increment_s, beams * scan.time_increment_s, scan.range_min_m, scan.range_max_m}) {
    cdr.number(static_cast<float>(value));
  }
  floats(cdr, scan.ranges_m);
  floats(cdr, scan.intensities);
  return cdr.bytes();
}

std::vector<std::byte> serializeGridMap(const MapMessage& map) {
  ingest::CdrWriter cdr;
  cdr.header(map.stamp_ns, map.frame_id).number(map.resolution_m);
  cdr.number(map.resolution_m * map.rows).number(map.resolution_m * map.columns);
  for (const double value : {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}) {
    cdr.number(value);
  }
  cdr.length(map.layers.size());
  for (const MapLayerValues& layer : map.layers) {
    cdr.string(layer.name);
  }
  cdr.length(0).length(map.layers.size());
  for (const MapLayerValues& layer : map.layers) {
    const std::uint32_t cells = map.rows * map.columns;
    cdr.length(2).string("column_index").number(map.columns).number(cells);
    cdr.string("row_index").number(map.rows).number(map.rows).number(std::uint32_t{0});
    floats(cdr, layer.values);
  }
  cdr.number(std::uint16_t{0}).number(std::uint16_t{0});
  return cdr.bytes();
}

}  // namespace stillframe::sample
