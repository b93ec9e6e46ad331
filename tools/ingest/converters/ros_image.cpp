// sensor_msgs/Image, sensor_msgs/CompressedImage and sensor_msgs/CameraInfo.

#include "scenegraph/objects/image.h"
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/images.h"
#include "tools/ingest/converters/row_decoder.h"

namespace stillframe::ingest::converters {

using scenegraph::CameraInfo;
using scenegraph::Image;

Created rosImage(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&ImageRow::image, &Image::stamp>("header.stamp")
      .field<&ImageRow::image, &Image::frame_id>("header.frame_id")
      .field<&ImageRow::image, &Image::height>("height")
      .field<&ImageRow::image, &Image::width>("width")
      .field<&ImageRow::image, &Image::encoding>("encoding")
      .field<&ImageRow::image, &Image::is_bigendian>("is_bigendian")
      .field<&ImageRow::image, &Image::row_step>("step")
      .field<&ImageRow::data>("data");
  return RowDecoder<ImageRow>::create(schema, message_encoding, shape, rawImage);
}

Created rosCompressedImage(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&ImageRow::image, &Image::stamp>("header.stamp")
      .field<&ImageRow::image, &Image::frame_id>("header.frame_id")
      .field<&ImageRow::image, &Image::encoding>("format")
      .field<&ImageRow::data>("data");
  return RowDecoder<ImageRow>::create(schema, message_encoding, shape, compressedImage);
}

Created rosCameraInfo(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&CameraRow::info, &CameraInfo::stamp>("header.stamp")
      .field<&CameraRow::info, &CameraInfo::frame_id>("header.frame_id");
  bindCamera(shape);
  shape.field<&CameraRow::info, &CameraInfo::binning_x>("binning_x")
      .optional()
      .field<&CameraRow::info, &CameraInfo::binning_y>("binning_y")
      .optional()
      .field<&CameraRow::info, &CameraInfo::roi_x_offset>("roi.x_offset")
      .optional()
      .field<&CameraRow::info, &CameraInfo::roi_y_offset>("roi.y_offset")
      .optional()
      .field<&CameraRow::info, &CameraInfo::roi_width>("roi.width")
      .optional()
      .field<&CameraRow::info, &CameraInfo::roi_height>("roi.height")
      .optional();
  return RowDecoder<CameraRow>::create(schema, message_encoding, shape, cameraInfo);
}

}  // namespace stillframe::ingest::converters
