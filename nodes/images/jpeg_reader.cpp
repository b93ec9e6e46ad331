#include "nodes/images/jpeg_reader.h"

#include <turbojpeg.h>

#include <memory>
#include <string>

#include "nodes/images/raw_rows.h"

namespace stillframe::nodes {
namespace {

// A block of 8 x 8 pixels takes at least two bits a component.
constexpr std::uint64_t kPixelsPerByte = 256;

struct Destroy {
  void operator()(void* handle) const { tjDestroy(handle); }
};

}  // namespace

std::expected<RgbaJpeg, ImageError> readJpeg(std::span<const std::byte> bytes) {
  const std::unique_ptr<void, Destroy> decoder(tjInitDecompress());
  const auto fail = [&](ImageFault fault, const std::string& message) {
    return std::unexpected(ImageError{fault, message});
  };
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int color_space = 0;
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  if (decoder == nullptr ||
      tjDecompressHeader3(decoder.get(), data, bytes.size(), &width, &height, &subsampling, &color_space) != 0) {
    return fail(ImageFault::CorruptImage, std::string("the JPEG cannot be read: ") + tjGetErrorStr2(decoder.get()));
  }
  const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  const std::string what =
      "a JPEG of " + sizeText(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height));
  if (pixels > kMaxPixels || pixels > bytes.size() * kPixelsPerByte) {
    return fail(ImageFault::ImageTooLarge, what + " is larger than its " + std::to_string(bytes.size()) +
                                               " bytes can hold, or than the " + std::to_string(kMaxPixels) +
                                               " pixels read here");
  }
  RgbaJpeg image{.width = static_cast<std::uint32_t>(width), .height = static_cast<std::uint32_t>(height), .rgba = {}};
  image.rgba.resize(pixels * 4);
  if (tjDecompress2(decoder.get(), data, bytes.size(), image.rgba.data(), width, 0, height, TJPF_RGBA,
                    TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS) != 0) {
    return fail(ImageFault::CorruptImage, what + " cannot be read: " + tjGetErrorStr2(decoder.get()));
  }
  return image;
}

}  // namespace stillframe::nodes
