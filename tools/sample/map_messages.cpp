#include "tools/sample/map_messages.h"

#include "tools/ingest/cdr_writer.h"
#include "tools/sample/definition_text.h"

namespace stillframe::sample {
namespace {

constexpr std::string_view kOccupancyGrid =
    "std_msgs/Header header\n"
    "nav_msgs/MapMetaData info\n"
    "# Row-major, starting with (0,0). 0..100, unknown is -1.\n"
    "int8[] data\n" STILLFRAME_SEPARATOR
    "MSG: nav_msgs/MapMetaData\n"
    "builtin_interfaces/Time map_load_time\n"
    "float32 resolution\n"
    "uint32 width\n"
    "uint32 height\n"
    "geometry_msgs/Pose origin\n" STILLFRAME_POSE STILLFRAME_HEADER;

constexpr std::string_view kOccupancyGridUpdate =
    "std_msgs/Header header\n"
    "int32 x\n"
    "int32 y\n"
    "uint32 width\n"
    "uint32 height\n"
    "int8[] data\n" STILLFRAME_HEADER;

}  // namespace

Ros2Type occupancyGridType() { return {"nav_msgs/msg/OccupancyGrid", kOccupancyGrid}; }
Ros2Type occupancyGridUpdateType() { return {"map_msgs/msg/OccupancyGridUpdate", kOccupancyGridUpdate}; }

std::vector<std::byte> serializeOccupancyGrid(const scenegraph::OccupancyGrid& grid) {
  ingest::CdrWriter cdr;
  cdr.header(grid.stamp.ns, grid.frame_id).stamp(grid.stamp.ns);
  cdr.number(static_cast<float>(grid.resolution_m)).number(grid.width).number(grid.height);
  const auto& [rotation, translation] = grid.origin;
  for (const double value :
       {translation.x, translation.y, translation.z, rotation.x, rotation.y, rotation.z, rotation.w}) {
    cdr.number(value);
  }
  return cdr.byteSequence(grid.data.bytes).bytes();
}

std::vector<std::byte> serializeOccupancyGridUpdate(const scenegraph::OccupancyGridUpdate& patch) {
  ingest::CdrWriter cdr;
  cdr.header(patch.stamp.ns, patch.frame_id).number(patch.x).number(patch.y).number(patch.width).number(patch.height);
  return cdr.byteSequence(patch.data.bytes).bytes();
}

}  // namespace stillframe::sample
