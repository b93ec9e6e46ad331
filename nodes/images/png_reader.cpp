#include "nodes/images/png_reader.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <string>

#include "nodes/images/raw_rows.h"

namespace stillframe::nodes {
namespace {

constexpr std::size_t kSignatureBytes = 8;
// Deflate makes at most 1032 bytes of one (its longest match is 258 bytes in two bits).
constexpr std::uint64_t kDeflateRatio = 1032;

struct Source {
  std::span<const std::byte> left;
  std::array<char, 80> fault{};  // a plain array: what libpng's longjmp passes over has no destructors
};

void readBytes(png_structp png, png_bytep to, std::size_t count) {
  auto* const source = static_cast<Source*>(png_get_io_ptr(png));
  if (source->left.size() < count) {
    png_error(png, "it breaks off");
  }
  std::memcpy(to, source->left.data(), count);
  source->left = source->left.subspan(count);
}

[[noreturn]] void noteError(png_structp png, png_const_charp message) {
  auto* const source = static_cast<Source*>(png_get_error_ptr(png));
  std::strncpy(source->fault.data(), message, source->fault.size() - 1);
  png_longjmp(png, 1);
}
void ignoreWarning(png_structp, png_const_charp) {}

/// libpng's two structures, freed together.
struct Reader {
  explicit Reader(Source& source)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, noteError, ignoreWarning)),
        info(png != nullptr ? png_create_info_struct(png) : nullptr) {}
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  png_structp png;
  png_infop info;
};

struct Header {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  int bits = 0;
  int color = 0;
  int interlace = 0;
};

// The two functions with setjmp hold no object with a destructor.
bool readHeader(Reader& reader, Source& source, Header& header) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) {
    return false;
  }
  png_set_read_fn(reader.png, &source, readBytes);
  png_set_crc_action(reader.png, PNG_CRC_ERROR_QUIT, PNG_CRC_WARN_DISCARD);
  png_set_chunk_malloc_max(reader.png, 1U << 20U);
  png_set_user_limits(reader.png, 1U << 24U, 1U << 24U);
  png_read_info(reader.png, reader.info);
  png_get_IHDR(reader.png, reader.info, &header.width, &header.height, &header.bits, &header.color, &header.interlace,
               nullptr, nullptr);
  return true;
}

bool readRows(Reader& reader, bool is_gray16, std::size_t row_bytes, png_byte* first, std::uint32_t height) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) {
    return false;
  }
  if (is_gray16) {
    if constexpr (std::endian::native == std::endian::little) {
      png_set_swap(reader.png);
    }
  } else {
    png_set_expand(reader.png);
    png_set_scale_16(reader.png);
    png_set_gray_to_rgb(reader.png);
    png_set_add_alpha(reader.png, 0xFF, PNG_FILLER_AFTER);
  }
  const int passes = png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  if (png_get_rowbytes(reader.png, reader.info) != row_bytes) {
    png_error(reader.png, "its rows have another length than announced");
  }
  for (int pass = 0; pass < passes; ++pass) {
    for (std::uint32_t row = 0; row < height; ++row) {
      png_read_row(reader.png, first + row * row_bytes, nullptr);
    }
  }
  return true;
}

std::unexpected<ImageError> corrupt(const Source& source) {
  return std::unexpected(
      ImageError{ImageFault::CorruptImage, std::string("the PNG cannot be read: ") + source.fault.data()});
}

/// Values of type T, `channels` a pixel.
template <typename T>
struct Pixels {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<T> values;
};

template <typename T>
std::expected<Pixels<T>, ImageError> readPng(std::span<const std::byte> bytes, std::size_t channels) {
  Source source{bytes, {}};
  Reader reader(source);
  Header header;
  if (reader.info == nullptr) {
    return std::unexpected(ImageError{ImageFault::CorruptImage, "the PNG cannot be read: no memory for its header"});
  }
  if (!readHeader(reader, source, header)) {
    return corrupt(source);
  }
  const bool is_gray = sizeof(T) == 2;
  const std::string what = "a PNG of " + sizeText(header.width, header.height);
  if (is_gray && (header.color != PNG_COLOR_TYPE_GRAY || header.bits != 16)) {
    return std::unexpected(ImageError{ImageFault::CorruptImage,
                                      what + " with " + std::to_string(header.bits) + " bits of colour type " +
                                          std::to_string(header.color) + " is no depth, which is 16 bits of grey"});
  }
  const std::uint64_t pixels = std::uint64_t{header.width} * header.height;
  const std::uint64_t stored_bytes = pixels * static_cast<unsigned>(std::max(header.bits, 1)) / 8;
  if (pixels > kMaxPixels || stored_bytes > bytes.size() * kDeflateRatio) {
    return std::unexpected(ImageError{ImageFault::ImageTooLarge, what + " is larger than its " +
                                                                     std::to_string(bytes.size()) +
                                                                     " bytes can hold, or than the " +
                                                                     std::to_string(kMaxPixels) + " pixels read here"});
  }
  Pixels<T> image{.width = header.width, .height = header.height, .values = {}};
  image.values.resize(pixels * channels);
  if (!readRows(reader, is_gray, header.width * channels * sizeof(T), reinterpret_cast<png_byte*>(image.values.data()),
                header.height)) {
    return corrupt(source);
  }
  return image;
}

}  // namespace

bool isPng(std::span<const std::byte> bytes) noexcept {
  return bytes.size() >= kSignatureBytes &&
         png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, kSignatureBytes) == 0;
}

std::expected<Gray16Png, ImageError> readGray16Png(std::span<const std::byte> bytes) {
  auto png = readPng<std::uint16_t>(bytes, 1);
  if (!png) {
    return std::unexpected(png.error());
  }
  return Gray16Png{png->width, png->height, std::move(png->values)};
}

std::expected<RgbaPng, ImageError> readRgbaPng(std::span<const std::byte> bytes) {
  auto png = readPng<std::uint8_t>(bytes, 4);
  if (!png) {
    return std::unexpected(png.error());
  }
  return RgbaPng{png->width, png->height, std::move(png->values)};
}

}  // namespace stillframe::nodes
