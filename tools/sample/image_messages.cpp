#include "tools/sample/image_messages.h"

#include <span>

#include "tools/ingest/cdr_writer.h"
#include "tools/sample/definition_text.h"

namespace stillframe::sample {
namespace {

constexpr std::string_view kImage =
    "std_msgs/Header header\n"
    "uint32 height\n"
    "uint32 width\n"
    "string encoding\n"
    "uint8 is_bigendian\n"
    "uint32 step\n"
    "uint8[] data\n" STILLFRAME_HEADER;

constexpr std::string_view kCameraInfo =
    "std_msgs/Header header\n"
    "uint32 height\n"
    "uint32 width\n"
    "string distortion_model\n"
    "float64[] d\n"
    "float64[9] k\n"
    "float64[9] r\n"
    "float64[12] p\n"
    "uint32 binning_x\n"
    "uint32 binning_y\n"
    "RegionOfInterest roi\n" STILLFRAME_SEPARATOR
    "MSG: sensor_msgs/RegionOfInterest\n"
    "uint32 x_offset\n"
    "uint32 y_offset\n"
    "uint32 height\n"
    "uint32 width\n"
    "bool do_rectify\n" STILLFRAME_HEADER;

}  // namespace

Ros2Type imageType() { return {"sensor_msgs/msg/Image", kImage}; }
Ros2Type cameraInfoType() { return {"sensor_msgs/msg/CameraInfo", kCameraInfo}; }

std::vector<std::byte> serializeImage(const scenegraph::Image& image) {
  ingest::CdrWriter cdr;
  cdr.header(image.stamp.ns, image.frame_id).number(image.height).number(image.width).string(image.encoding);
  cdr.number(static_cast<std::uint8_t>(image.is_bigendian)).number(image.row_step).byteSequence(image.data.bytes);
  return cdr.bytes();
}

std::vector<std::byte> serializeCameraInfo(const scenegraph::CameraInfo& info) {
  ingest::CdrWriter cdr;
  cdr.header(info.stamp.ns, info.frame_id).number(info.height).number(info.width).string(info.distortion_model);
  cdr.length(info.distortion.size());
  for (const std::span<const double> values :
       {std::span<const double>(info.distortion), std::span<const double>(info.k), std::span<const double>(info.r),
        std::span<const double>(info.p)}) {
    for (const double value : values) {
      cdr.number(value);
    }
  }
  cdr.number(info.binning_x).number(info.binning_y).number(info.roi_x_offset).number(info.roi_y_offset);
  cdr.number(info.roi_height).number(info.roi_width).number(std::uint8_t{0});
  return cdr.bytes();
}

}  // namespace stillframe::sample
