#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/objects/image.h"

namespace stillframe::test {

/// Hands the bytes over to an image.
inline void setData(scenegraph::Image& image, std::vector<std::byte> bytes) {
  const auto anchor = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  image.data = {*anchor, anchor};
}

/// An image without row padding from values in row order, in this machine's byte order.
template <typename T>
scenegraph::Image makeImage(const std::string& frame, const std::string& encoding, std::uint32_t width,
                            const std::vector<T>& values, std::uint32_t channels = 1) {
  scenegraph::Image image;
  image.frame_id = frame;
  image.encoding = encoding;
  image.width = width;
  image.row_step = width * channels * static_cast<std::uint32_t>(sizeof(T));
  image.height = static_cast<std::uint32_t>(values.size() / (std::size_t{width} * channels));
  std::vector<std::byte> bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  setData(image, std::move(bytes));
  return image;
}

inline scenegraph::Image depthImage16(const std::string& frame, std::uint32_t width,
                                      const std::vector<std::uint16_t>& millimetres) {
  return makeImage(frame, "16UC1", width, millimetres);
}

/// A pinhole of focal length `focal` (by default the width) looking through the picture's middle.
inline scenegraph::CameraInfo cameraInfo(const std::string& frame, std::uint32_t width, std::uint32_t height,
                                         double focal = 0.0) {
  scenegraph::CameraInfo info;
  info.frame_id = frame;
  info.width = width;
  info.height = height;
  const double f = focal > 0.0 ? focal : width;
  const double cx = 0.5 * (width - 1.0);
  const double cy = 0.5 * (height - 1.0);
  info.k = {f, 0, cx, 0, f, cy, 0, 0, 1};
  info.r = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.p = {f, 0, cx, 0, 0, f, cy, 0, 0, 0, 1, 0};
  return info;
}

}  // namespace stillframe::test
