// sensor_msgs/LaserScan.
#include "scenegraph/objects/laser_scan.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"

namespace stillframe::ingest::converters {

using scenegraph::LaserScan;

Created rosLaserScan(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&LaserScan::stamp>("header.stamp")
      .field<&LaserScan::frame_id>("header.frame_id")
      .field<&LaserScan::angle_min_rad>("angle_min")
      .field<&LaserScan::angle_increment_rad>("angle_increment")
      .field<&LaserScan::time_increment_s>("time_increment")
      .field<&LaserScan::range_min_m>("range_min")
      .field<&LaserScan::range_max_m>("range_max")
      .field<&LaserScan::ranges_m>("ranges")
      .field<&LaserScan::intensities>("intensities");
  return RowDecoder<LaserScan>::create(schema, message_encoding, shape,
                                       [](LaserScan& scan, const MessageView&) -> RowDecoder<LaserScan>::Result {
                                         if (scan.intensities.size() != scan.ranges_m.size()) {
                                           scan.intensities.clear();
                                         }
                                         return finished(std::move(scan));
                                       });
}

}  // namespace stillframe::ingest::converters
