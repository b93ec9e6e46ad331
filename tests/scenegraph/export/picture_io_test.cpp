#include "scenegraph/export/picture_io.h"

#include <gtest/gtest.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace stillframe::scenegraph {
namespace {

float linearFromByte(int value) {
  const double srgb = value / 255.0;
  return static_cast<float>(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
}

/// 256 x 2: the bytes up in red and down in blue, green 0; depths from 1 m, the last at infinity.
Picture ramp() {
  Picture picture{.width = 256, .height = 2, .rgba = {}, .depth_m = {}};
  for (int i = 0; i < 512; ++i) {
    picture.rgba.insert(picture.rgba.end(), {linearFromByte(i % 256), 0.0F, linearFromByte(255 - i % 256), 1.0F});
    picture.depth_m.push_back(i == 511 ? std::numeric_limits<float>::infinity() : static_cast<float>(i + 1));
  }
  return picture;
}

std::string contents(const std::filesystem::path& path) {
  std::ifstream file{path, std::ios::binary};
  return {std::istreambuf_iterator<char>(file), {}};
}

class PictureIo : public ::testing::Test {
 protected:
  PictureIo() : folder_(std::filesystem::path(::testing::TempDir()) / ("picture_io_" + std::string(name()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~PictureIo() override { std::filesystem::remove_all(folder_); }
  static const char* name() { return ::testing::UnitTest::GetInstance()->current_test_info()->name(); }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }
  std::filesystem::path folder_;
};

TEST_F(PictureIo, BytesWithAlphaAreNotPremultiplied) {
  const float half = linearFromByte(128);
  const Picture picture{.width = 4,
                        .height = 1,
                        .rgba = {half, 0, 0, 1, 0.25F * half, 0, 0, 0.25F, 0, 0, 0, 0, 5, 5, 5, 0.5F},
                        .depth_m = std::vector<float>(4),
                        .has_alpha = true};
  EXPECT_EQ(toRgbaBytes(picture),
            (std::vector<std::uint8_t>{128, 0, 0, 255, 128, 0, 0, 64, 0, 0, 0, 0, 255, 255, 255, 128}));
}

TEST_F(PictureIo, PngHoldsEveryByteAndComesBack) {
  const Picture picture = ramp();
  ASSERT_TRUE(writePng(picture, folder_ / "ramp.png"));
  const auto back = readPng(folder_ / "ramp.png");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(*back, toBytes(picture));
  for (std::size_t i = 0; i < 256; ++i) {
    EXPECT_EQ(back->rgb[i * 3], i);
    EXPECT_EQ(back->rgb[i * 3 + 2], 255 - i);
  }
}

TEST_F(PictureIo, EqualPicturesGiveEqualFilesAndNothingBeside) {
  for (const char* const extension : {"png", "exr"}) {
    const auto write = [&](const char* stem) {
      const auto path = folder_ / (std::string(stem) + "." + extension);
      return std::string_view(extension) == "png" ? writePng(ramp(), path) : writeExr(ramp(), path);
    };
    ASSERT_TRUE(write("a"));
    ASSERT_TRUE(write("b"));
    EXPECT_EQ(contents(folder_ / (std::string("a.") + extension)), contents(folder_ / (std::string("b.") + extension)));
  }
  EXPECT_EQ(files(), 4U);
}

TEST_F(PictureIo, ExrHoldsLinearFloatsAndMetres) {
  Picture picture = ramp();
  picture.rgba[0] = 12.5F;  // brighter than white is kept
  ASSERT_TRUE(writeExr(picture, folder_ / "ramp.exr"));
  Imf::InputFile file((folder_ / "ramp.exr").c_str());
  for (const char* const channel : {"R", "G", "B", "A", "Z"}) {
    ASSERT_NE(file.header().channels().findChannel(channel), nullptr) << channel;
    EXPECT_EQ(file.header().channels().findChannel(channel)->type, Imf::FLOAT);
  }
  std::vector<float> red(512);
  std::vector<float> depth(512);
  Imf::FrameBuffer buffer;
  buffer.insert("R", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(red.data()), 4, std::size_t{4} * 256));
  buffer.insert("Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(depth.data()), 4, std::size_t{4} * 256));
  file.setFrameBuffer(buffer);
  file.readPixels(0, 1);
  for (std::size_t i = 0; i < 512; ++i) {
    EXPECT_EQ(red[i], picture.rgba[i * 4]);
    EXPECT_EQ(depth[i], picture.depth_m[i]);
  }
}

TEST_F(PictureIo, BytesOfWildValuesAreClampedAndNotANumberIsBlack) {
  Picture picture{.width = 2,
                  .height = 1,
                  .rgba = {-1, 7, std::nanf(""), 1, 0, 1, std::numeric_limits<float>::infinity(), 1},
                  .depth_m = {1, 1}};
  EXPECT_EQ(toBytes(picture).rgb, (std::vector<std::uint8_t>{0, 255, 0, 0, 255, 255}));
}

TEST_F(PictureIo, ProgressRisesAndCanBeGivenUp) {
  const Picture tall{.width = 3, .height = 300, .rgba = std::vector<float>(3600), .depth_m = std::vector<float>(900)};
  for (const auto& write : {+[](const Picture& picture, const std::filesystem::path& path, const WriteProgress& told) {
                              return writePng(picture, path, told);
                            },
                            +[](const Picture& picture, const std::filesystem::path& path, const WriteProgress& told) {
                              return writeExr(picture, path, told);
                            }}) {
    std::vector<double> shares;
    ASSERT_TRUE(write(tall, folder_ / "tall", [&](double share) {
      shares.push_back(share);
      return true;
    }));
    EXPECT_GT(shares.size(), 3U);
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_GT(shares.back(), 0.5);
    EXPECT_LT(shares.back(), 1.0);
    const std::string before = contents(folder_ / "tall");
    const auto given_up = write(tall, folder_ / "tall", [](double share) { return share < 0.5; });
    ASSERT_FALSE(given_up);
    EXPECT_NE(given_up.error().message.find("cancelled"), std::string::npos);
    EXPECT_EQ(contents(folder_ / "tall"), before) << "what was there stays";
    EXPECT_EQ(files(), 1U);
  }
}

TEST_F(PictureIo, FailureToWriteNamesPathAndReason) {
  for (const auto& write : {+[](const std::filesystem::path& path) { return writePng(ramp(), path); },
                            +[](const std::filesystem::path& path) { return writeExr(ramp(), path); }}) {
    const auto missing = write(folder_ / "no" / "such.png");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, "CannotWrite");
    EXPECT_NE(missing.error().message.find("such.png"), std::string::npos);
    EXPECT_NE(missing.error().message.find("No such file or directory"), std::string::npos) << missing.error().message;
    EXPECT_NE(write(folder_).error().message.find("directory"), std::string::npos);
    const auto full = write("/dev/full");
    ASSERT_FALSE(full);
    EXPECT_NE(full.error().message.find("No space left"), std::string::npos) << full.error().message;
  }
  EXPECT_EQ(files(), 0U);
}

TEST_F(PictureIo, ReadingWhatIsNoPngSaysSo) {
  std::ofstream(folder_ / "text.png") << "not a picture";
  EXPECT_EQ(readPng(folder_ / "text.png").error().code, "CannotRead");
  EXPECT_EQ(readPng(folder_ / "missing.png").error().code, "CannotRead");
}

}  // namespace
}  // namespace stillframe::scenegraph
