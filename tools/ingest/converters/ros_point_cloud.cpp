// sensor_msgs/PointCloud2.
#include "scenegraph/objects/point_cloud.h"
#include "tf/transform_buffer.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/ros_decoder.h"

namespace stillframe::ingest::converters {

namespace {

struct PointFieldRow {
  std::string_view name;
  std::uint32_t offset = 0;
  std::uint32_t datatype = 0;
  std::uint32_t count = 0;
};

struct CloudRow {
  tf::TimePoint stamp;
  std::string_view frame_id;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::vector<PointFieldRow> fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;
  std::span<const std::byte> data;
  bool is_dense = false;
};

Shape cloudShape() {
  Shape field;
  field.field<&PointFieldRow::name>("name")
      .field<&PointFieldRow::offset>("offset")
      .field<&PointFieldRow::datatype>("datatype")
      .field<&PointFieldRow::count>("count");
  Shape cloud;
  cloud.field<&CloudRow::stamp>("header.stamp")
      .field<&CloudRow::frame_id>("header.frame_id")
      .field<&CloudRow::height>("height")
      .field<&CloudRow::width>("width")
      .rows<&CloudRow::fields>("fields", std::move(field))
      .field<&CloudRow::is_bigendian>("is_bigendian")
      .field<&CloudRow::point_step>("point_step")
      .field<&CloudRow::row_step>("row_step")
      .field<&CloudRow::data>("data")
      .field<&CloudRow::is_dense>("is_dense");
  return cloud;
}

scenegraph::AnyObject convert(const CloudRow& row, const MessageView& message) {
  scenegraph::PointCloud cloud;
  cloud.stamp = row.stamp;
  cloud.frame_id = tf::stripLeadingSlashes(row.frame_id);
  cloud.width = row.width;
  cloud.height = row.height;
  cloud.point_step = row.point_step;
  cloud.row_step = row.row_step;
  cloud.is_bigendian = row.is_bigendian;
  cloud.is_dense = row.is_dense;
  cloud.color_packing = scenegraph::ColorPacking::PclWord;
  for (const PointFieldRow& field : row.fields) {
    const bool is_known = field.datatype <= static_cast<std::uint32_t>(scenegraph::FieldType::Float64);
    cloud.fields.push_back(
        {std::string(field.name), field.offset,
         is_known ? static_cast<scenegraph::FieldType>(field.datatype) : scenegraph::FieldType::Unknown, field.count});
  }
  cloud.data = payloadOf(row.data, message);
  return scenegraph::AnyObject::make(std::move(cloud));
}

}  // namespace

Created rosPointCloud(const SchemaRecord& schema, std::string_view message_encoding) {
  return RosDecoder<CloudRow>::create(schema, message_encoding, cloudShape(), convert);
}

}  // namespace stillframe::ingest::converters
