// foxglove.RawImage, foxglove.CompressedImage and foxglove.CameraCalibration, in protobuf, JSON and ROS.
#include "tools/ingest/converters/converters.h"
#include "tools/ingest/converters/images.h"

namespace stillframe::ingest::converters {

using scenegraph::CameraInfo;
using scenegraph::Image;

Created foxgloveRawImage(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&ImageRow::image, &Image::stamp>("timestamp")
      .field<&ImageRow::image, &Image::frame_id>("frame_id")
      .field<&ImageRow::image, &Image::width>("width")
      .field<&ImageRow::image, &Image::height>("height")
      .field<&ImageRow::image, &Image::encoding>("encoding")
      .field<&ImageRow::image, &Image::row_step>("step")
      .field<&ImageRow::data>("data");
  return RowDecoder<ImageRow>::create(schema, message_encoding, shape, rawImage);
}

Created foxgloveCompressedImage(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&ImageRow::image, &Image::stamp>("timestamp")
      .field<&ImageRow::image, &Image::frame_id>("frame_id")
      .field<&ImageRow::image, &Image::encoding>("format")
      .field<&ImageRow::data>("data");
  return RowDecoder<ImageRow>::create(schema, message_encoding, shape, compressedImage);
}

Created foxgloveCameraCalibration(const SchemaRecord& schema, std::string_view message_encoding) {
  Shape shape;
  shape.field<&CameraRow::info, &CameraInfo::stamp>("timestamp")
      .field<&CameraRow::info, &CameraInfo::frame_id>("frame_id");
  bindCamera(shape);
  return RowDecoder<CameraRow>::create(schema, message_encoding, shape, cameraInfo);
}

}  // namespace stillframe::ingest::converters
