// sensor_msgs/PointCloud2.
#include "scenegraph/objects/point_cloud.h"
#include "tf/transform_buffer.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"

namespace stillframe::ingest::converters {

namespace {

struct PointFieldRow {
  std::string_view name;
  std::uint32_t offset = 0;
  std::uint32_t datatype = 0;
  std::uint32_t count = 0;
};

struct RosCloudRow {
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

/// Of what lies before the points, and them: nothing that comes after.
Shape earlyShape() {
  Shape field;
  field.field<&PointFieldRow::name>("name")
      .field<&PointFieldRow::offset>("offset")
      .field<&PointFieldRow::datatype>("datatype")
      .field<&PointFieldRow::count>("count");
  Shape cloud;
  cloud.field<&RosCloudRow::stamp>("header.stamp")
      .field<&RosCloudRow::frame_id>("header.frame_id")
      .field<&RosCloudRow::height>("height")
      .field<&RosCloudRow::width>("width")
      .rows<&RosCloudRow::fields>("fields", std::move(field))
      .field<&RosCloudRow::is_bigendian>("is_bigendian")
      .field<&RosCloudRow::point_step>("point_step")
      .field<&RosCloudRow::row_step>("row_step")
      .field<&RosCloudRow::data>("data");
  return cloud;
}

Shape cloudShape() {
  Shape cloud = earlyShape();
  cloud.field<&RosCloudRow::is_dense>("is_dense");
  return cloud;
}

RowDecoder<RosCloudRow>::Result convert(RosCloudRow& row, const MessageView& message) {
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
    cloud.fields.push_back({std::string(field.name), field.offset, fieldType(field.datatype), field.count});
  }
  cloud.data = payloadOf(row.data, message);
  return scenegraph::AnyObject::make(std::move(cloud));
}

class CloudDecoder final : public MessageDecoder {
 public:
  CloudDecoder(std::unique_ptr<MessageDecoder> whole, std::unique_ptr<RowReader> early)
      : whole_(std::move(whole)), early_(std::move(early)) {}
  [[nodiscard]] std::expected<scenegraph::AnyObject, scenegraph::DecodeError> decode(
      const MessageView& message) const override {
    return whole_->decode(message);
  }
  [[nodiscard]] std::optional<scenegraph::AnyObject> decodeEarly(const MessageView& message,
                                                                 std::size_t there) const override {
    RosCloudRow row;
    if (!early_->readEarly(message, there, &row)) {
      return std::nullopt;
    }
    auto cloud = convert(row, message);
    return cloud ? std::optional(*std::move(cloud)) : std::nullopt;
  }
  [[nodiscard]] bool decodesEarly() const noexcept override { return true; }

 private:
  std::unique_ptr<MessageDecoder> whole_;
  std::unique_ptr<RowReader> early_;
};

}  // namespace

Created rosPointCloud(const SchemaRecord& schema, std::string_view message_encoding) {
  auto whole = RowDecoder<RosCloudRow>::create(schema, message_encoding, cloudShape(), convert);
  auto early = makeRowReader(schema, message_encoding, earlyShape());
  if (!whole || !early) {
    return whole;
  }
  return std::make_unique<CloudDecoder>(*std::move(whole), *std::move(early));
}

}  // namespace stillframe::ingest::converters
