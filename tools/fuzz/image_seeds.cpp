// image_seeds OUT: writes an image of every encoding that fuzz_depth reads: its five bytes of header, then the data.
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tools/sample/image_writers.h"

using namespace stillframe;

namespace {

constexpr std::uint8_t kWidth = 7;
constexpr std::uint8_t kHeight = 5;

/// `encoding` is the place in fuzz_depth's list, with its two flags.
bool write(const std::filesystem::path& path, std::uint8_t encoding, std::uint8_t row_step,
           const std::vector<std::byte>& data) {
  std::ofstream file(path, std::ios::binary);
  const std::array<char, 5> head = {static_cast<char>(encoding), kWidth, kHeight, static_cast<char>(row_step), 0};
  file.write(head.data(), head.size());
  file.write(reinterpret_cast<const char*>(data.data()), static_cast<std::streamsize>(data.size()));
  return file.good();
}

/// compressedDepth: the header with its two parameters of quantisation, then the picture.
std::vector<std::byte> quantised(const std::vector<std::byte>& body) {
  constexpr std::array<float, 2> kParameters = {100.0F, 1.5F};
  std::vector<std::byte> bytes(12);
  std::memcpy(bytes.data() + 4, kParameters.data(), sizeof kParameters);
  bytes.insert(bytes.end(), body.begin(), body.end());
  return bytes;
}

template <typename T>
std::vector<std::byte> bytesOf(const std::vector<T>& values) {
  std::vector<std::byte> bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 2) {
    return 2;
  }
  const std::filesystem::path out = arguments[1];
  std::filesystem::create_directories(out);
  std::vector<std::uint16_t> millimetres;
  std::vector<float> metres;
  std::vector<std::uint8_t> rgb;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    millimetres.push_back(static_cast<std::uint16_t>(i % 6 == 2 ? 0 : 500 + 37 * i));
    metres.push_back(0.001F * static_cast<float>(millimetres.back()));
    rgb.insert(rgb.end(), 3, static_cast<std::uint8_t>(7 * i));
  }
  const auto png = sample::writeGrayPng(kWidth, millimetres);
  const auto rvl = sample::writeRvl(kWidth, millimetres);
  const bool is_written =
      write(out / "depth_png", 0, 0, quantised(png)) && write(out / "inverse_depth_png", 0x80, 0, quantised(png)) &&
      write(out / "depth_rvl", 0, 0, quantised(rvl)) && write(out / "inverse_depth_rvl", 0x80, 0, quantised(rvl)) &&
      write(out / "16uc1", 3, 2 * kWidth, bytesOf(millimetres)) &&
      write(out / "16uc1_big", 0x43, 2 * kWidth, bytesOf(millimetres)) &&
      write(out / "32fc1", 4, 4 * kWidth, bytesOf(metres)) && write(out / "rgb8", 5, 3 * kWidth, bytesOf(rgb)) &&
      write(out / "png", 6, 0, sample::writeRgbPng(kWidth, rgb)) &&
      write(out / "jpeg", 7, 0, sample::writeJpeg(kWidth, rgb));
  return is_written ? 0 : 1;
}
