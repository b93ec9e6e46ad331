#include "nodes/points/colormap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "nodes/coloring.h"
#include "nodes/points/channel.h"
#include "nodes/points/value_range.h"

namespace stillframe::test {
namespace {

using nodes::findColormap;
using nodes::mapRange;
using nodes::SrgbColor;
using nodes::ValueRange;

void expectColor(const SrgbColor& color, double r, double g, double b) {
  EXPECT_NEAR(color[0] * 255.0F, r, 0.51);
  EXPECT_NEAR(color[1] * 255.0F, g, 0.51);
  EXPECT_NEAR(color[2] * 255.0F, b, 0.51);
}

TEST(Colormap, OffersTheRequiredOnesAndMore) {
  std::set<std::string_view> names;
  for (const nodes::Colormap& map : nodes::colormaps()) {
    names.insert(map.name);
  }
  for (const char* name :
       {"turbo", "viridis", "plasma", "grayscale", "inferno", "magma", "cividis", "coolwarm", "jet"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  EXPECT_EQ(nodes::colormaps().front().name, nodes::kDefaultColormap);
  EXPECT_EQ(findColormap("no such map"), nullptr);
}

TEST(Colormap, HasThePublishedEnds) {
  expectColor(findColormap("viridis")->at(0.0), 68, 1, 84);
  expectColor(findColormap("viridis")->at(1.0), 253, 231, 37);
  expectColor(findColormap("turbo")->at(0.0), 48, 18, 59);
  expectColor(findColormap("turbo")->at(1.0), 122, 4, 3);
  expectColor(findColormap("plasma")->at(0.0), 13, 8, 135);
  expectColor(findColormap("plasma")->at(1.0), 240, 249, 33);
  expectColor(findColormap("coolwarm")->at(0.5), 221, 221, 221);
  expectColor(findColormap("jet")->at(0.375), 0, 255, 255);
}

TEST(Colormap, GrayscaleIsTheIdentity) {
  for (int i = 0; i <= 255; ++i) {
    expectColor(findColormap("grayscale")->at(i / 255.0), i, i, i);
  }
}

using Matrix = std::array<std::array<double, 3>, 3>;

/// Linear light as eyes without one sort of cones see it: G. Machado, M. Oliveira, L. Fernandes, 2009, severity 1.
constexpr std::array<std::pair<const char*, Matrix>, 4> kEyes{{
    {"all cones", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
    {"no long", {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}}},
    {"no middle", {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}}},
    {"no short", {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}},
}};
constexpr Matrix kXyzFromLinear{
    {{0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}}};

std::array<double, 3> times(const Matrix& matrix, const std::array<double, 3>& v) {
  std::array<double, 3> product{};
  for (std::size_t row = 0; row < 3; ++row) {
    product[row] = matrix[row][0] * v[0] + matrix[row][1] * v[1] + matrix[row][2] * v[2];
  }
  return product;
}

/// CIE L*, a*, b* of an sRGB colour as these eyes see it.
std::array<double, 3> labOf(const SrgbColor& srgb, const Matrix& eyes) {
  std::array<double, 3> linear{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = static_cast<double>(srgb[c]);
    linear[c] = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  }
  linear = times(eyes, linear);
  for (double& value : linear) {
    value = std::clamp(value, 0.0, 1.0);
  }
  const auto xyz = times(kXyzFromLinear, linear);
  const auto f = [](double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0; };
  const double x = f(xyz[0] / 0.95047);
  const double y = f(xyz[1]);
  const double z = f(xyz[2] / 1.08883);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

/// The least rise of lightness from one anchor to the next, and the least distance of two colours that lie an eighth of
/// the range apart or more.
std::pair<double, double> readability(const nodes::Colormap& map, const Matrix& eyes) {
  double rise = 100.0;
  double distance = 1000.0;
  for (std::size_t i = 0; i < nodes::Colormap::kAnchors; ++i) {
    const auto a = labOf(map.anchors[i], eyes);
    for (std::size_t j = i + 1; j < nodes::Colormap::kAnchors; ++j) {
      const auto b = labOf(map.anchors[j], eyes);
      if (j == i + 1) {
        rise = std::min(rise, b[0] - a[0]);
      }
      if (j >= i + nodes::Colormap::kAnchors / 8) {
        distance = std::min(distance, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
      }
    }
  }
  return {rise, distance};
}

TEST(Colormap, TheDefaultIsReadWithAnyEyes) {
  for (const auto& [name, eyes] : kEyes) {
    const auto [rise, distance] = readability(*findColormap(nodes::kDefaultColormap), eyes);
    EXPECT_GT(rise, 0.4) << name << ": darker is always less";
    EXPECT_GT(distance, 8.0) << name << ": eighths are told apart, and none comes twice";
  }
  // Which is more than can be said of the rainbow.
  const auto [rise, distance] = readability(*findColormap("turbo"), kEyes[2].second);
  EXPECT_LT(rise, -5.0);
  EXPECT_LT(distance, 6.0);
}

TEST(Colormap, ClampsAndSurvivesNan) {
  const nodes::Colormap& map = *findColormap("turbo");
  EXPECT_EQ(map.at(-5.0), map.at(0.0));
  EXPECT_EQ(map.at(1e300), map.at(1.0));
  EXPECT_EQ(map.at(std::numeric_limits<double>::quiet_NaN()), map.at(0.0));
}

double mapped(const ValueRange& range, double value, double offset = 0.0) {
  const auto map = mapRange(range, offset);
  return (value - offset) * map.scale + map.bias;
}

TEST(ValueRange, MapsItsLimitsToZeroAndOneAlsoBackwards) {
  EXPECT_NEAR(mapped({10, 20}, 10), 0.0, 1e-12);
  EXPECT_NEAR(mapped({10, 20}, 20), 1.0, 1e-12);
  EXPECT_NEAR(mapped({20, 10}, 20), 0.0, 1e-12);
  EXPECT_NEAR(mapped({20, 10}, 12.5), 0.75, 1e-12);
  EXPECT_NEAR(mapped({4e9, 4e9 + 2}, 4e9 + 1, 4e9), 0.5, 1e-12);
}

TEST(ValueRange, IsAlwaysFinite) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kMax = std::numeric_limits<double>::max();
  for (const ValueRange& range : {ValueRange{5, 5},
                                  {0, kInf},
                                  {-kInf, kInf},
                                  {kNan, 1},
                                  {1, kNan},
                                  {0, 1e-300},
                                  {0, 5e-324},
                                  {1e9, 1e9 + 1e-7}}) {
    const auto map = mapRange(range);
    EXPECT_TRUE(std::isfinite(static_cast<float>(map.scale)) && std::isfinite(static_cast<float>(map.bias)))
        << range.low << " " << range.high;
  }
  EXPECT_EQ(mapped({5, 5}, 5), 0.5);
  EXPECT_NEAR(mapped({-kMax, kMax}, 0.0), 0.5, 1e-12);
}

TEST(ValueRange, TakesNearestRankPercentilesOfFiniteValues) {
  std::vector<float> values = {nodes::kMissingValue, nodes::kValueReach};
  for (int i = 100; i >= 0; --i) {
    values.push_back(static_cast<float>(i));
  }
  EXPECT_EQ(nodes::percentileRange(values, 1000.0, 1, 99), (ValueRange{1001, 1099}));
  EXPECT_EQ(nodes::percentileRange(values, 0.0, 0, 100), (ValueRange{0, 100}));
  EXPECT_EQ(nodes::percentileRange(values, 0.0, 99, 1), (ValueRange{1, 99}));
  EXPECT_EQ(nodes::percentileRange(values, 0.0, -1e300, 1e300), (ValueRange{0, 100}));
  EXPECT_EQ(nodes::percentileRange({}, 7.0, 1, 99), (ValueRange{0, 0}));
  EXPECT_EQ(nodes::percentileRangeOfAxis(std::vector<float>{1, 2, 3, 4, 5, 6}, 1, 10.0, 0, 100), (ValueRange{12, 15}));
}

}  // namespace
}  // namespace stillframe::test
