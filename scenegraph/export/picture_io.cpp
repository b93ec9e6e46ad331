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
#include <cstdio>
#include <memory>
#include <string>

#include "scenegraph/export/replace_file.h"
#include "scenegraph/srgb.h"

namespace stillframe::scenegraph {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// What libpng is handed.
struct Pixels {
  int width = 0;
  int height = 0;
  bool has_alpha = false;
  const std::vector<std::uint8_t>& bytes;
};

std::expected<void, std::string> writePngFile(const Pixels& picture, const std::filesystem::path& path) {
  errno = 0;
  File file{std::fopen(path.c_str(), "wb")};
  if (file == nullptr) {
    return std::unexpected(lastSystemError());
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  // 8-bit components are sRGB by libpng's definition, and marked so.
  image.format = picture.has_alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  std::expected<void, std::string> result;
  if (png_image_write_to_stdio(&image, file.get(), 0, picture.bytes.data(), 0, nullptr) == 0) {
    result = std::unexpected(std::string(image.message) + " (" + lastSystemError() + ")");
  }
  // Bytes may still be on their way: a full disk shows when they are flushed.
  if (result && std::fclose(file.release()) != 0) {
    result = std::unexpected(lastSystemError());
  }
  return result;
}

std::expected<void, std::string> writeExrFile(const Picture& picture, const std::filesystem::path& path) {
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
    file.writePixels(picture.height);
  } catch (const std::exception& error) {
    return std::unexpected(errno != 0 ? lastSystemError() : std::string(error.what()));
  }
  return {};
}

}  // namespace

BytePicture toBytes(const Picture& picture) {
  BytePicture bytes{.width = picture.width, .height = picture.height, .rgb = {}};
  const std::size_t pixels = picture.rgba.size() / 4;
  bytes.rgb.resize(pixels * 3);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel) {
      bytes.rgb[i * 3 + channel] = srgbByteFromLinear(picture.rgba[i * 4 + channel]);
    }
  }
  return bytes;
}

std::vector<std::uint8_t> toRgbaBytes(const Picture& picture) {
  std::vector<std::uint8_t> bytes(picture.rgba.size());
  for (std::size_t i = 0; i + 3 < bytes.size(); i += 4) {
    const float alpha = std::clamp(picture.rgba[i + 3], 0.0F, 1.0F);
    for (std::size_t c = i; c < i + 3; ++c) {
      bytes[c] = alpha > 0.0F ? srgbByteFromLinear(picture.rgba[c] / alpha) : std::uint8_t{0};
    }
    bytes[i + 3] = static_cast<std::uint8_t>(std::lround(alpha * 255.0F));
  }
  return bytes;
}

std::expected<void, Status> writePng(const BytePicture& picture, const std::filesystem::path& path) {
  const Pixels pixels{.width = picture.width, .height = picture.height, .bytes = picture.rgb};
  return replaceFile(path, [&](const std::filesystem::path& beside) { return writePngFile(pixels, beside); });
}

std::expected<void, Status> writePng(const Picture& picture, const std::filesystem::path& path) {
  if (!picture.has_alpha) {
    return writePng(toBytes(picture), path);
  }
  const std::vector<std::uint8_t> bytes = toRgbaBytes(picture);
  const Pixels pixels{.width = picture.width, .height = picture.height, .has_alpha = true, .bytes = bytes};
  return replaceFile(path, [&](const std::filesystem::path& beside) { return writePngFile(pixels, beside); });
}

std::expected<void, Status> writeExr(const Picture& picture, const std::filesystem::path& path) {
  return replaceFile(path, [&](const std::filesystem::path& beside) { return writeExrFile(picture, beside); });
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
