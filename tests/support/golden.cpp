#include "tests/support/golden.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>

namespace stillframe::test {
namespace {

using scenegraph::BytePicture;

bool isBlessing() {
  const char* const value = std::getenv("STILLFRAME_BLESS");
  return value != nullptr && std::string_view(value) == "1";
}

std::filesystem::path goldenPath(const std::string& name) {
  return std::filesystem::path(STILLFRAME_SOURCE_DIR) / "tests" / "golden" / (name + ".png");
}

struct Comparison {
  double fraction = 0.0;  // of pixels beyond the step
  int largest = 0;
  BytePicture amplified;
};

Comparison compare(const BytePicture& a, const BytePicture& b, int step) {
  Comparison result{.amplified = {.width = a.width, .height = a.height, .rgb = {}}};
  std::size_t beyond = 0;
  for (std::size_t pixel = 0; pixel + 2 < a.rgb.size(); pixel += 3) {
    int worst = 0;
    for (std::size_t i = pixel; i < pixel + 3; ++i) {
      const int difference = std::abs(static_cast<int>(a.rgb[i]) - static_cast<int>(b.rgb[i]));
      worst = std::max(worst, difference);
      result.amplified.rgb.push_back(static_cast<std::uint8_t>(std::min(255, 10 * difference)));
    }
    beyond += worst > step ? 1U : 0U;
    result.largest = std::max(result.largest, worst);
  }
  result.fraction = static_cast<double>(beyond) / static_cast<double>(std::max<std::size_t>(1, a.rgb.size() / 3));
  return result;
}

/// Where the pictures of a failure went, or why they did not.
std::string leave(const BytePicture& picture, const std::string& file) {
  const auto folder = std::filesystem::path(STILLFRAME_BINARY_DIR) / "golden";
  std::error_code ignored;
  std::filesystem::create_directories(folder, ignored);
  const auto written = scenegraph::writePng(picture, folder / file);
  return written ? (folder / file).string() : written.error().message;
}

}  // namespace

testing::AssertionResult matchesGolden(const BytePicture& picture, const std::string& name,
                                       const GoldenTolerance& tolerance) {
  const auto path = goldenPath(name);
  if (isBlessing()) {
    const auto written = scenegraph::writePng(picture, path);
    return written ? testing::AssertionSuccess() : testing::AssertionFailure() << written.error().message;
  }
  const auto golden = scenegraph::readPng(path);
  if (!golden) {
    return testing::AssertionFailure() << golden.error().message << "; drawn: " << leave(picture, name + "_actual.png");
  }
  if (golden->width != picture.width || golden->height != picture.height) {
    return testing::AssertionFailure() << name << " is " << picture.width << "x" << picture.height << ", golden "
                                       << golden->width << "x" << golden->height
                                       << "; drawn: " << leave(picture, name + "_actual.png");
  }
  const Comparison comparison = compare(picture, *golden, tolerance.step);
  if (comparison.fraction <= tolerance.pixels) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << name << ": " << 100.0 * comparison.fraction
                                     << " % of the pixels differ by more than " << tolerance.step << " (largest "
                                     << comparison.largest << ", allowed " << 100.0 * tolerance.pixels
                                     << " %); drawn: " << leave(picture, name + "_actual.png")
                                     << ", difference: " << leave(comparison.amplified, name + "_diff.png");
}

}  // namespace stillframe::test
