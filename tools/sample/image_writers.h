#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stillframe::sample {

// Pictures as files of their formats hold them: what the readers are tested and fuzzed against. `values` and `rgb` are
// row by row; the height follows from their size.

/// A grey PNG of 16 bits.
[[nodiscard]] std::vector<std::byte> writeGrayPng(std::uint32_t width, const std::vector<std::uint16_t>& values);
/// A PNG of red, green and blue.
[[nodiscard]] std::vector<std::byte> writeRgbPng(std::uint32_t width, const std::vector<std::uint8_t>& rgb);
[[nodiscard]] std::vector<std::byte> writeJpeg(int width, const std::vector<std::uint8_t>& rgb);
/// RVL as its paper (Wilson 2017) writes it, after width and height.
[[nodiscard]] std::vector<std::byte> writeRvl(std::uint32_t width, const std::vector<std::uint16_t>& values);

}  // namespace stillframe::sample
