#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenegraph/objects/object.h"
#include "scenegraph/objects/payload.h"
#include "tf/time.h"

namespace stillframe::scenegraph {

struct CameraInfo;

/// A colour or depth image: sensor_msgs/Image, sensor_msgs/CompressedImage, foxglove.RawImage,
/// foxglove.CompressedImage.
///
/// Encodings: rgb8 rgba8 bgr8 bgra8 mono8 mono16 16UC1 (mm) 32FC1 (m) jpeg png compressedDepth; the string is open.
/// width and height are 0 where only the compressed bytes know them. Nothing has been checked.
struct Image {
  static constexpr ObjectType kType = ObjectType::Image;
  tf::TimePoint stamp;
  std::string frame_id;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string encoding;
  std::string compressed_encoding;  ///< of the pixels before compression ("16UC1", "rgb8"); "" where it is not told
  std::uint32_t row_step = 0;       ///< bytes, padding included
  bool is_bigendian = false;
  Payload data;
  std::shared_ptr<const CameraInfo> camera;  ///< that came with it (the host's DepthImage), or nullptr
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + data.bytes.size(); }
};

/// sensor_msgs/CameraInfo, foxglove.CameraCalibration: intrinsics of the images in the same frame (optical: z forward,
/// x right, y down).
struct CameraInfo {
  static constexpr ObjectType kType = ObjectType::CameraInfo;
  tf::TimePoint stamp;
  std::string frame_id;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string distortion_model;    ///< plumb_bob, rational_polynomial, equidistant; "" = none
  std::vector<double> distortion;  ///< D
  std::array<double, 9> k{};       ///< row-major fx 0 cx 0 fy cy 0 0 1
  std::array<double, 9> r{};       ///< rectification
  std::array<double, 12> p{};      ///< projection
  std::uint32_t binning_x = 0;     ///< 0 is read as 1
  std::uint32_t binning_y = 0;
  std::uint32_t roi_x_offset = 0;
  std::uint32_t roi_y_offset = 0;
  std::uint32_t roi_width = 0;  ///< 0: the whole image
  std::uint32_t roi_height = 0;
  [[nodiscard]] std::size_t byteSize() const { return sizeof(*this) + distortion.size() * sizeof(double); }
};

}  // namespace stillframe::scenegraph
