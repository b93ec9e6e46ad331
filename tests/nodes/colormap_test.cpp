#include "nodes/points/colormap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "nodes/points/channel.h"
#include "nodes/points/value_range.h"

namespace stillframe::test {
namespace {

using nodes::findColormap;
using nodes::mapRange;
using nodes::Rgb;
using nodes::ValueRange;

void expectColor(const Rgb& color, double r, double g, double b) {
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
  EXPECT_EQ(nodes::colormaps().front().name, "turbo");
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
