#include <algorithm>
#include <string>

#include "tools/ingest/cdr_writer.h"
#include "tools/sample/cloudini_writer.h"
#include "tools/sample/definition_text.h"
#include "tools/sample/draco_writer.h"
#include "tools/sample/lidar.h"

namespace stillframe::sample {
namespace {

constexpr std::string_view kCompressedCloud =
    "std_msgs/Header header\n"
    "uint32 height\n"
    "uint32 width\n"
    "sensor_msgs/PointField[] fields\n"
    "bool is_bigendian\n"
    "uint32 point_step\n"
    "uint32 row_step\n"
    "uint8[] compressed_data\n"
    "bool is_dense\n"
    "string format\n" STILLFRAME_SEPARATOR
    "MSG: sensor_msgs/PointField\n"
    "string name\n"
    "uint32 offset\n"
    "uint8 datatype\n"
    "uint32 count\n" STILLFRAME_HEADER;

std::vector<std::byte> packCloudini(const scenegraph::PointCloud& cloud) {
  nodes::cloudini::Header header;
  header.version = 5;
  header.width = cloud.width;
  header.point_step = cloud.point_step;
  for (const auto& field : cloud.fields) {
    const bool is_float = field.type == scenegraph::FieldType::Float32;
    const float resolution = field.name == "intensity" ? 1.0F : 0.001F;
    header.fields.push_back({field.name, field.offset, static_cast<nodes::cloudini::ValueType>(field.type),
                             is_float ? std::optional(resolution) : std::nullopt});
  }
  return writeCloudini(header, cloud.data.bytes, {.section_mode = SectionMode::DifferenceRuns});
}

/// Every fourth point of the lidar at 5 Hz, packed for a narrow link: by Cloudini to a millimetre, by Draco to 14 bits.
class CompressedLidar final : public Topic {
 public:
  CompressedLidar(const Stage& stage, std::uint32_t points, std::string format)
      : stage_(stage), lidar_(std::max(points / 4, 1U)), name_("/lidar/thin/" + format), format_(std::move(format)) {}
  std::string_view name() const override { return name_; }
  Ros2Type type() const override { return {"point_cloud_interfaces/msg/CompressedPointCloud2", kCompressedCloud}; }
  std::int64_t periodNs() const override { return 200'000'000; }

  std::vector<std::byte> message(std::int64_t elapsed_ns) const override {
    std::vector<std::byte> data;
    const scenegraph::PointCloud cloud = lidar_.scan(stage_, elapsed_ns, data);
    constexpr int kPositionBits = 14;
    const auto blob = format_ == "draco" ? writeDraco(cloud, kPositionBits) : packCloudini(cloud);
    ingest::CdrWriter cdr;
    cdr.header(cloud.stamp.ns, cloud.frame_id).number(cloud.height).number(cloud.width).length(cloud.fields.size());
    for (const auto& field : cloud.fields) {
      cdr.string(field.name).number(field.offset).number(static_cast<std::uint8_t>(field.type)).number(field.count);
    }
    cdr.number(std::uint8_t{0}).number(cloud.point_step).number(cloud.row_step).byteSequence(blob);
    return cdr.number(std::uint8_t{1}).string(format_).bytes();
  }

 private:
  Stage stage_;
  Lidar lidar_;
  std::string name_;
  std::string format_;
};

}  // namespace

std::unique_ptr<Topic> makeCompressedLidar(const Stage& stage, std::uint32_t points, std::string_view format) {
  return std::make_unique<CompressedLidar>(stage, points, std::string(format));
}

}  // namespace stillframe::sample
