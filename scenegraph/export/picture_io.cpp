#include "scenegraph/export/picture_io.h"

#include <png.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <memory>
#include <span>
#include <string>

#include "scenegraph/export/replace_file.h"
#include "scenegraph/srgb.h"

namespace stillframe::scenegraph {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

constexpr const char* kCancelled = "cancelled";
constexpr int kRowsATurn = 64;  // between two reports

/// Whether to stop, asked once for some rows.
bool isGivenUp(const WriteProgress& progress, int rows_done, int rows) {
  return progress && rows_done % kRowsATurn == 0 && !progress(static_cast<double>(rows_done) / rows);
}

/// What libpng is handed.
struct Pixels {
  int width = 0;
  int height = 0;
  bool has_alpha = false;
  std::function<const std::uint8_t*(int)> row;
};

/// libpng comes back from its errors with a jump, over which nothing may need to be destroyed.
const char* writePngRows(png_structp writer, png_infop info, std::FILE* file, const Pixels& picture,
                         const WriteProgress& progress) {
  if (setjmp(png_jmpbuf(writer)) != 0) {  // NOLINT(cert-err52-cpp): it is libpng's way
    return "libpng";
  }
  png_init_io(writer, file);
  png_set_IHDR(writer, info, static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height), 8,
               picture.has_alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
  png_set_sRGB(writer, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(writer, info);
  for (int y = 0; y < picture.height; ++y) {
    if (isGivenUp(progress, y, picture.height)) {
      return kCancelled;
    }
    png_write_row(writer, picture.row(y));
  }
  png_write_end(writer, info);
  return nullptr;
}

std::expected<void, std::string> writePngFile(const Pixels& picture, const std::filesystem::path& path,
                                              const WriteProgress& progress) {
  errno = 0;
  File file{std::fopen(path.c_str(), "wb")};
  if (file == nullptr) {
    return std::unexpected(lastSystemError());
  }
  std::string message;
  const auto keep = [](png_structp writer, png_const_charp text) {
    *static_cast<std::string*>(png_get_error_ptr(writer)) = text;
    png_longjmp(writer, 1);
  };
  png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, keep, [](png_structp, auto) {});
  png_infop info = writer == nullptr ? nullptr : png_create_info_struct(writer);
  std::expected<void, std::string> result;
  if (info == nullptr) {
    result = std::unexpected("no memory for libpng");
  } else if (const char* const failure = writePngRows(writer, info, file.get(), picture, progress)) {
    result = std::unexpected(failure == kCancelled ? kCancelled : message + " (" + lastSystemError() + ")");
  }
  png_destroy_write_struct(&writer, &info);
  // Bytes may still be on their way: a full disk shows when they are flushed.
  if (result && std::fclose(file.release()) != 0) {
    result = std::unexpected(lastSystemError());
  }
  return result;
}

std::expected<void, std::string> writeExrFile(const Picture& picture, const std::filesystem::path& path,
                                              const WriteProgress& progress) {
  const auto width = static_cast<std::size_t>(picture.width);
  Imf::Header header(picture.width, picture.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer buffer;
  const auto add = [&](const char* name, const float* first, std::size_t stride) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    // OpenEXR's type for reading and writing alike; writing does not change what it points to.
    auto* base = reinterpret_cast<char*>(const_cast<float*>(first));  // NOLINT
    buffer.insert(name, Imf::Slice(Imf::FLOAT, base, stride * sizeof(float), stride * width * sizeof(float)));
  };
  add("R", picture.rgba.data(), 4);
  add("G", picture.rgba.data() + 1, 4);
  add("B", picture.rgba.data() + 2, 4);
  add("A", picture.rgba.data() + 3, 4);
  add("Z", picture.depth_m.data(), 1);
  if (!picture.normals.empty()) {
    add("N.X", picture.normals.data(), 3);
    add("N.Y", picture.normals.data() + 1, 3);
    add("N.Z", picture.normals.data() + 2, 3);
  }
  if (!picture.layer_ids.empty()) {
    header.channels().insert("id", Imf::Channel(Imf::UINT));
    auto* base = reinterpret_cast<char*>(const_cast<std::uint32_t*>(picture.layer_ids.data()));  // NOLINT
    buffer.insert("id", Imf::Slice(Imf::UINT, base, sizeof(std::uint32_t), width * sizeof(std::uint32_t)));
    std::string names;
    for (const std::string& name : picture.layer_names) {
      names += name + "\n";
    }
    header.insert("layers", Imf::StringAttribute(names));
  }
  errno = 0;
  try {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    for (int y = 0; y < picture.height; y += kRowsATurn) {
      if (isGivenUp(progress, y, picture.height)) {
        return std::unexpected(kCancelled);
      }
      file.writePixels(std::min(kRowsATurn, picture.height - y));
    }
  } catch (const std::exception& error) {
    return std::unexpected(errno != 0 ? lastSystemError() : std::string(error.what()));
  }
  return {};
}

/// 4 floats a pixel to 3 bytes.
void toRgb(std::span<const float> rgba, std::span<std::uint8_t> bytes) {
  for (std::size_t i = 0; i < rgba.size() / 4; ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      bytes[i * 3 + channel] = srgbByteFromLinear(rgba[i * 4 + channel]);
    }
  }
}

/// 4 floats a pixel, premultiplied, to 4 bytes that are not.
void toRgba(std::span<const float> rgba, std::span<std::uint8_t> bytes) {
  for (std::size_t i = 0; i + 3 < bytes.size(); i += 4) {
    const float alpha = std::clamp(rgba[i + 3], 0.0F, 1.0F);
    for (std::size_t c = i; c < i + 3; ++c) {
      bytes[c] = alpha > 0.0F ? srgbByteFromLinear(rgba[c] / alpha) : std::uint8_t{0};
    }
    bytes[i + 3] = static_cast<std::uint8_t>(std::lround(alpha * 255.0F));
  }
}

std::expected<void, Status> writePixels(const Pixels& pixels, const std::filesystem::path& path,
                                        const WriteProgress& progress) {
  return replaceFile(path, [&](const std::filesystem::path& beside) { return writePngFile(pixels, beside, progress); });
}

}  // namespace

BytePicture toBytes(const Picture& picture) {
  BytePicture bytes{.width = picture.width, .height = picture.height, .rgb = {}};
  bytes.rgb.resize(picture.rgba.size() / 4 * 3);
  toRgb(picture.rgba, bytes.rgb);
  return bytes;
}

std::vector<std::uint8_t> toRgbaBytes(const Picture& picture) {
  std::vector<std::uint8_t> bytes(picture.rgba.size());
  toRgba(picture.rgba, bytes);
  return bytes;
}

std::expected<void, Status> writePng(const BytePicture& picture, const std::filesystem::path& path,
                                     const WriteProgress& progress) {
  const std::size_t stride = std::size_t{3} * static_cast<std::size_t>(picture.width);
  return writePixels({.width = picture.width,
                      .height = picture.height,
                      .row = [&](int y) { return &picture.rgb[stride * static_cast<std::size_t>(y)]; }},
                     path, progress);
}

std::expected<void, Status> writePng(const Picture& picture, const std::filesystem::path& path,
                                     const WriteProgress& progress) {
  const auto width = static_cast<std::size_t>(picture.width);
  std::vector<std::uint8_t> bytes((picture.has_alpha ? 4 : 3) * width);
  const auto row = [&](int y) -> const std::uint8_t* {
    const auto values = std::span(picture.rgba).subspan(4 * width * static_cast<std::size_t>(y), 4 * width);
    picture.has_alpha ? toRgba(values, bytes) : toRgb(values, bytes);
    return bytes.data();
  };
  return writePixels({.width = picture.width, .height = picture.height, .has_alpha = picture.has_alpha, .row = row},
                     path, progress);
}

std::expected<void, Status> writeExr(const Picture& picture, const std::filesystem::path& path,
                                     const WriteProgress& progress) {
  return replaceFile(path,
                     [&](const std::filesystem::path& beside) { return writeExrFile(picture, beside, progress); });
}

std::expected<BytePicture, Status> readPng(const std::filesystem::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const auto failure = [&]() {
    const std::string reason = image.message;
    png_image_free(&image);
    return std::unexpected(Status{StatusLevel::Error, "CannotRead", "cannot read " + path.string() + ": " + reason});
  };
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) {
    return failure();
  }
  image.format = PNG_FORMAT_RGB;
  BytePicture picture{.width = static_cast<int>(image.width), .height = static_cast<int>(image.height), .rgb = {}};
  picture.rgb.resize(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr) == 0) {
    return failure();
  }
  return picture;
}

}  // namespace stillframe::scenegraph
