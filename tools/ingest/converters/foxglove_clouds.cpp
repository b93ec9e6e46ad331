// foxglove.PointCloud, foxglove.CompressedPointCloud and foxglove.LaserScan, in protobuf, JSON and ROS.
#include <limits>

#include "scenegraph/objects/laser_scan.h"
#include "tools/ingest/converters/compressed_clouds.h"
#include "tools/ingest/converters/converters.h"

namespace stillframe::ingest::converters {

namespace {

using scenegraph::CompressedPointCloud;
using scenegraph::LaserScan;
using scenegraph::PointCloud;

struct FoxgloveCloudRow {
  PointCloud cloud;
  std::vector<PackedFieldRow> fields;
  std::span<const std::byte> data;
};

RowDecoder<FoxgloveCloudRow>::Result convertCloud(FoxgloveCloudRow& row, const MessageView& payloads) {
  PointCloud& cloud = row.cloud;
  // Points of no bytes at all: the cloud's layout is refused for that, but only where there is a point.
  cloud.width = cloud.point_step == 0 && !row.data.empty() ? 1 : countOf(row.data.size(), cloud.point_step);
  cloud.row_step = static_cast<std::uint32_t>(std::min<std::uint64_t>(std::uint64_t{cloud.width} * cloud.point_step,
                                                                      std::numeric_limits<std::uint32_t>::max()));
  cloud.is_dense = false;  // not told
  cloud.fields = packedFields(row.fields);
  cloud.data = payloadOf(row.data, payloads);
  return finished(std::move(cloud));
}

struct FoxgloveScanRow {
  LaserScan scan;
  double end_angle = 0.0;
};

}  // namespace

Created foxglovePointCloud(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&FoxgloveCloudRow::cloud, &PointCloud::stamp>("timestamp")
      .field<&FoxgloveCloudRow::cloud, &PointCloud::frame_id>("frame_id")
      .row<&FoxgloveCloudRow::cloud, &PointCloud::pose>("pose", poseShape())
      .field<&FoxgloveCloudRow::cloud, &PointCloud::point_step>("point_stride")
      .rows<&FoxgloveCloudRow::fields>("fields", packedFieldShape())
      .field<&FoxgloveCloudRow::data>("data");
  return RowDecoder<FoxgloveCloudRow>::create(schema, message_encoding, shape, convertCloud);
}

Created foxgloveCompressedCloud(const SchemaRecord& schema, std::string_view message_encoding) {
  using Row = CompressedCloudRow;
  Shape shape;
  shape.field<&Row::cloud, &CompressedPointCloud::stamp>("timestamp")
      .field<&Row::cloud, &CompressedPointCloud::frame_id>("frame_id")
      .row<&Row::cloud, &CompressedPointCloud::pose>("pose", poseShape())
      .field<&Row::data>("data")
      .field<&Row::cloud, &CompressedPointCloud::format>("format");
  return RowDecoder<Row>::create(schema, message_encoding, shape, compressedCloud);
}

Created foxgloveLaserScan(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&FoxgloveScanRow::scan, &LaserScan::stamp>("timestamp")
      .field<&FoxgloveScanRow::scan, &LaserScan::frame_id>("frame_id")
      .row<&FoxgloveScanRow::scan, &LaserScan::pose>("pose", poseShape())
      .field<&FoxgloveScanRow::scan, &LaserScan::angle_min_rad>("start_angle")
      .field<&FoxgloveScanRow::end_angle>("end_angle")
      .field<&FoxgloveScanRow::scan, &LaserScan::ranges_m>("ranges")
      .field<&FoxgloveScanRow::scan, &LaserScan::intensities>("intensities");
  return RowDecoder<FoxgloveScanRow>::create(
      schema, message_encoding, shape,
      [](FoxgloveScanRow& row, const MessageView&) -> RowDecoder<FoxgloveScanRow>::Result {
        LaserScan& scan = row.scan;
        const std::size_t beams = scan.ranges_m.size();
        scan.angle_increment_rad =
            beams > 1 ? (row.end_angle - scan.angle_min_rad) / static_cast<double>(beams - 1) : 0.0;
        scan.range_max_m = std::numeric_limits<double>::infinity();
        if (scan.intensities.size() != beams) {
          scan.intensities.clear();
        }
        return finished(std::move(scan));
      });
}

}  // namespace stillframe::ingest::converters
