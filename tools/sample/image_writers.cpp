#include "tools/sample/image_writers.h"

#include <png.h>
#include <turbojpeg.h>

#include <cstring>

namespace stillframe::sample {

std::vector<std::byte> writeGrayPng(std::uint32_t width, const std::vector<std::uint16_t>& values) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = static_cast<png_uint_32>(values.size() / width);
  image.format = PNG_FORMAT_LINEAR_Y;
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, values.data(), 0, nullptr);
  std::vector<std::byte> bytes(size);
  png_image_write_to_memory(&image, bytes.data(), &size, 0, values.data(), 0, nullptr);
  bytes.resize(size);
  return bytes;
}

std::vector<std::byte> writeRgbPng(std::uint32_t width, const std::vector<std::uint8_t>& rgb) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = static_cast<png_uint_32>(rgb.size() / 3 / width);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, rgb.data(), 0, nullptr);
  std::vector<std::byte> bytes(size);
  png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr);
  bytes.resize(size);
  return bytes;
}

std::vector<std::byte> writeJpeg(int width, const std::vector<std::uint8_t>& rgb) {
  const tjhandle encoder = tjInitCompress();
  unsigned char* data = nullptr;
  unsigned long size = 0;
  tjCompress2(encoder, rgb.data(), width, 0, static_cast<int>(rgb.size()) / 3 / width, TJPF_RGB, &data, &size,
              TJSAMP_444, 95, 0);
  std::vector<std::byte> bytes(size);
  std::memcpy(bytes.data(), data, size);
  tjFree(data);
  tjDestroy(encoder);
  return bytes;
}

std::vector<std::byte> writeRvl(std::uint32_t width, const std::vector<std::uint16_t>& values) {
  std::vector<std::uint32_t> words = {width, static_cast<std::uint32_t>(values.size() / width)};
  std::uint32_t word = 0;
  int nibbles = 0;
  const auto put = [&](std::uint32_t value) {
    do {
      const std::uint32_t nibble = (value & 7U) | (value > 7 ? 8U : 0U);
      value >>= 3U;
      word = word << 4U | nibble;
      if (++nibbles == 8) {
        words.push_back(word);
        nibbles = 0;
        word = 0;
      }
    } while (value != 0);
  };
  std::int32_t previous = 0;
  for (std::size_t i = 0; i < values.size();) {
    std::size_t zeros = i;
    while (zeros < values.size() && values[zeros] == 0) {
      ++zeros;
    }
    std::size_t others = zeros;
    while (others < values.size() && values[others] != 0) {
      ++others;
    }
    put(static_cast<std::uint32_t>(zeros - i));
    put(static_cast<std::uint32_t>(others - zeros));
    for (i = zeros; i < others; ++i) {
      const std::int32_t delta = values[i] - previous;
      put(static_cast<std::uint32_t>(delta * 2) ^ static_cast<std::uint32_t>(delta >> 31));
      previous = values[i];
    }
  }
  if (nibbles > 0) {
    words.push_back(word << (4U * static_cast<unsigned>(8 - nibbles)));
  }
  std::vector<std::byte> bytes(words.size() * 4);
  std::memcpy(bytes.data(), words.data(), bytes.size());
  return bytes;
}

}  // namespace stillframe::sample
