#include "nodes/poses/covariance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <vector>

#include "tests/support/builders.h"

namespace stillframe::nodes {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dmat3 diagonal(double x, double y, double z) { return {x, 0, 0, 0, y, 0, 0, 0, z}; }

std::vector<double> sortedSigma(const Spread& spread) {
  std::vector<double> sigma{spread.sigma.x, spread.sigma.y, spread.sigma.z};
  std::ranges::sort(sigma);
  return sigma;
}

/// Unit columns at right angles, right-handed, and sigma finite and not negative.
void expectSound(const Spread& spread) {
  EXPECT_NEAR(glm::determinant(spread.axes), 1.0, 1e-12);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(glm::length(spread.axes[i]), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(spread.axes[i], spread.axes[(i + 1) % 3]), 0.0, 1e-12);
    EXPECT_TRUE(std::isfinite(spread.sigma[i]) && spread.sigma[i] >= 0.0) << spread.sigma[i];
  }
}

TEST(Covariance, OfADiagonalIsItsRoots) {
  const auto spread = spreadOf(diagonal(4.0, 0.25, 9.0));
  ASSERT_TRUE(spread);
  EXPECT_EQ(spread->sigma, glm::dvec3(2.0, 0.5, 3.0));
  EXPECT_EQ(spread->axes, glm::dmat3(1.0));
}

TEST(Covariance, FindsTheAxesOfARotatedEllipsoid) {
  test::Random random(3);
  for (int i = 0; i < 500; ++i) {
    const glm::dmat3 turn = glm::mat3_cast(random.transform(1.0).rotation);
    const glm::dvec3 sigma{random.number(0.1, 1), random.number(1.5, 2), random.number(3, 4)};
    const auto spread =
        spreadOf(turn * diagonal(sigma.x * sigma.x, sigma.y * sigma.y, sigma.z * sigma.z) * glm::transpose(turn));
    ASSERT_TRUE(spread);
    expectSound(*spread);
    const auto sorted = sortedSigma(*spread);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(sorted[static_cast<std::size_t>(axis)], sigma[axis], 1e-12);
      double along = 0.0;  // of the true axis with the one found for the same sigma
      for (int found = 0; found < 3; ++found) {
        if (std::abs(spread->sigma[found] - sigma[axis]) < 1e-9) {
          along = std::abs(glm::dot(spread->axes[found], turn[axis]));
        }
      }
      EXPECT_NEAR(along, 1.0, 1e-9);
    }
  }
}

TEST(Covariance, KeepsTheDigitsOfSmallBesideHuge) {
  const auto stiff = spreadOf(diagonal(1e12, 4e-12, 1.0));
  ASSERT_TRUE(stiff);
  EXPECT_DOUBLE_EQ(stiff->sigma.x, 1e6);
  EXPECT_DOUBLE_EQ(stiff->sigma.y, 2e-6);
  EXPECT_EQ(stiff->sigma.z, 1.0);

  // Correlated: the small eigenvalue is (ac - b2) / a in exact arithmetic, 24 digits below the large one.
  const auto correlated = spreadOf({1e12, 0.5, 0, 0.5, 1e-12, 0, 0, 0, 1});
  ASSERT_TRUE(correlated);
  expectSound(*correlated);
  EXPECT_NEAR(sortedSigma(*correlated)[0], std::sqrt(0.75e-12), 1e-15);

  for (const double scale : {1e-300, 1e-150, 1e150, 1e300}) {
    const auto spread = spreadOf({4 * scale, scale, 0, scale, scale, 0, 0, 0, scale});
    ASSERT_TRUE(spread) << scale;
    expectSound(*spread);
    EXPECT_NEAR(sortedSigma(*spread)[2] / std::sqrt(scale), std::sqrt(2.5 + std::sqrt(3.25)), 1e-12) << scale;
  }
  const auto widest = spreadOf(diagonal(1e-300, 1e300, 0.0));
  ASSERT_TRUE(widest);
  EXPECT_DOUBLE_EQ(widest->sigma.x, 1e-150);
  EXPECT_DOUBLE_EQ(widest->sigma.y, 1e150);
}

TEST(Covariance, OfASingularMatrixIsFlat) {
  const auto line = spreadOf({1, 1, 0, 1, 1, 0, 0, 0, 0});
  ASSERT_TRUE(line);
  expectSound(*line);
  const auto sigma = sortedSigma(*line);
  EXPECT_NEAR(sigma[0], 0.0, 1e-8);
  EXPECT_NEAR(sigma[1], 0.0, 1e-8);
  EXPECT_NEAR(sigma[2], std::sqrt(2.0), 1e-12);
  const auto nothing = spreadOf(glm::dmat3(0.0));
  ASSERT_TRUE(nothing);
  EXPECT_EQ(nothing->sigma, glm::dvec3(0.0));
}

TEST(Covariance, TakesTheSymmetricPart) {
  const auto spread = spreadOf({2, 0, 0, 1, 2, 0, 0, 0, 1});
  ASSERT_TRUE(spread);
  EXPECT_NEAR(sortedSigma(*spread)[2], std::sqrt(2.5), 1e-12);
}

TEST(Covariance, RefusesWhatIsNone) {
  EXPECT_EQ(spreadOf(diagonal(kNan, 1, 1)).error(), CovarianceError::NotFinite);
  EXPECT_EQ(spreadOf(diagonal(1, kInfinity, 1)).error(), CovarianceError::NotFinite);
  EXPECT_EQ(spreadOf(diagonal(-1, 1, 1)).error(), CovarianceError::NotPositive) << "ROS: unknown";
  EXPECT_EQ(spreadOf({1, 2, 0, 2, 1, 0, 0, 0, 1}).error(), CovarianceError::NotPositive) << "a correlation of 2";
  EXPECT_EQ(spreadOf({1e12, 1e3, 0, 1e3, 1e-12, 0, 0, 0, 1}).error(), CovarianceError::NotPositive)
      << "beyond the small one's scale, far below the large one's";
  EXPECT_EQ(spreadOf({0, 1, 0, 1, 1, 0, 0, 0, 1}).error(), CovarianceError::NotPositive);
  const double third = -0.9;  // each pair is possible, all three together are not
  EXPECT_EQ(spreadOf({1, third, third, third, 1, third, third, third, 1}).error(), CovarianceError::NotPositive);
  EXPECT_TRUE(spreadOf({1, 1 + 1e-9, 0, 1 + 1e-9, 1, 0, 0, 0, 1})) << "rounding";
}

TEST(Covariance, OfADirectionGoesByTheFixedAxes) {
  // Turning about z moves x along y, turning about y moves it along z, turning about x moves it not.
  const auto ahead = directionSpreadOf(diagonal(100.0, 0.04, 0.01), {1, 0, 0});
  ASSERT_TRUE(ahead);
  expectSound(*ahead);
  EXPECT_NEAR(std::abs(ahead->axes[2].x), 1.0, 1e-12);
  EXPECT_NEAR(ahead->sigma[2], 0.0, 1e-12);
  for (int i = 0; i < 2; ++i) {
    const bool is_sideways = std::abs(ahead->axes[i].y) > 0.5;
    EXPECT_NEAR(ahead->sigma[i], is_sideways ? 0.1 : 0.2, 1e-12);
  }
  // The same covariance of a robot that looks along y: about the fixed x now, not about its own.
  const auto aside = directionSpreadOf(diagonal(0.04, 100.0, 0.01), {0, 1, 0});
  ASSERT_TRUE(aside);
  EXPECT_NEAR(std::max(aside->sigma[0], aside->sigma[1]), 0.2, 1e-12);
  const auto planar = directionSpreadOf(diagonal(1e12, 1e12, 1e-4), {std::sqrt(0.5), std::sqrt(0.5), 0});
  ASSERT_TRUE(planar);
  EXPECT_NEAR(std::min(planar->sigma[0], planar->sigma[1]), 0.01, 1e-9);
}

TEST(Covariance, ReadsBlocksByRows) {
  std::array<double, 36> all{};
  for (std::size_t i = 0; i < 36; ++i) {
    all[i] = static_cast<double>(i);
  }
  EXPECT_EQ(positionBlock(all)[2][0], 2.0) << "x with z";
  EXPECT_EQ(rotationBlock(all)[0][0], 21.0);
  EXPECT_EQ(rotationBlock(all)[2][1], 29.0) << "ry with rz";
}

}  // namespace
}  // namespace stillframe::nodes
