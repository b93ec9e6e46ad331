#pragma once

#include <span>
#include <vector>

#include "scenegraph/objects/image.h"
#include "tools/ingest/converters/row_decoder.h"
#include "tools/ingest/converters/shapes.h"

/// What the ROS and the Foxglove schemas of images and cameras have in common.
namespace stillframe::ingest::converters {

struct ImageRow {
  scenegraph::Image image;
  std::span<const std::byte> data;
};
[[nodiscard]] RowDecoder<ImageRow>::Result rawImage(ImageRow& row, const MessageView& payloads);
/// `encoding` holds the format as sent: "jpeg", "rgb8; jpeg compressed bgr8", "16UC1; compressedDepth png".
[[nodiscard]] RowDecoder<ImageRow>::Result compressedImage(ImageRow& row, const MessageView& payloads);

struct CameraRow {
  scenegraph::CameraInfo info;
  std::vector<double> k, r, p;
};
/// Binds everything but header and timing. ROS 1 and Foxglove protobuf write K, D, R, P; ROS 2 k, d, r, p.
void bindCamera(Shape& shape);
/// Codes: "BadCameraInfo" for matrices of another length than 9, 9, 12 (or none at all).
[[nodiscard]] RowDecoder<CameraRow>::Result cameraInfo(CameraRow& row, const MessageView& payloads);

}  // namespace stillframe::ingest::converters
