#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <functional>
#include <vector>

#include "scenegraph/pipeline/picture.h"
#include "scenegraph/status.h"

namespace stillframe::scenegraph {

/// Pixels as a PNG holds them: sRGB-encoded red, green, blue, top row first.
struct BytePicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  friend bool operator==(const BytePicture&, const BytePicture&) = default;
};

/// Exact sRGB encoding, rounded to the nearest byte; beyond [0, 1] is clamped, NaN is 0.
[[nodiscard]] BytePicture toBytes(const Picture& picture);
/// The same with alpha, 4 bytes a pixel, colours not premultiplied: as a PNG and most programs have them.
[[nodiscard]] std::vector<std::uint8_t> toRgbaBytes(const Picture& picture);

/// Called while a picture is written, with the share that is, 0 to 1; false gives it up ("CannotWrite: cancelled").
using WriteProgress = std::function<bool(double share)>;

/// The writers write beside `path` and rename, so a failure leaves what was there. Equal pixels give equal files.
/// Code "CannotWrite" names the path and the system's reason.

/// 8-bit PNG, marked sRGB: RGB, or RGBA where the picture has alpha.
std::expected<void, Status> writePng(const BytePicture& picture, const std::filesystem::path& path,
                                     const WriteProgress& progress = {});
std::expected<void, Status> writePng(const Picture& picture, const std::filesystem::path& path,
                                     const WriteProgress& progress = {});
/// OpenEXR with 32-bit float channels R, G, B, A (scene-linear) and Z (metres along the view axis, +infinity where
/// nothing was drawn), ZIP compressed. A picture that has them: N.X, N.Y and N.Z, and the whole number "id" of the
/// layer, whose names stand one a line in the attribute "layers", from 1.
std::expected<void, Status> writeExr(const Picture& picture, const std::filesystem::path& path,
                                     const WriteProgress& progress = {});
/// Any 8-bit PNG; "CannotRead" otherwise.
[[nodiscard]] std::expected<BytePicture, Status> readPng(const std::filesystem::path& path);

}  // namespace stillframe::scenegraph
