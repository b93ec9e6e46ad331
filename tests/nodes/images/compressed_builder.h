#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "tests/nodes/images/image_builder.h"
#include "tools/sample/image_writers.h"

namespace stillframe::test {

/// The header of compressedDepth before `body`.
inline scenegraph::Image compressedDepth(std::vector<std::byte> body, const std::string& pixels = "16UC1",
                                         float a = 0.0F, float b = 0.0F) {
  std::vector<std::byte> bytes(12);
  std::memcpy(bytes.data() + 4, &a, 4);
  std::memcpy(bytes.data() + 8, &b, 4);
  bytes.insert(bytes.end(), body.begin(), body.end());
  scenegraph::Image image;
  image.encoding = "compressedDepth";
  image.compressed_encoding = pixels;
  setData(image, std::move(bytes));
  return image;
}

}  // namespace stillframe::test
