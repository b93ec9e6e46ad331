#include "nodes/poses/polygon_fill.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/support/builders.h"

namespace stillframe::nodes {
namespace {

using Points = std::vector<glm::dvec3>;

/// Area of the triangles; each must have the turn that `up` sees counter-clockwise.
double areaOf(const Points& points, const glm::dvec3& up) {
  const auto triangles = fillPolygon(points);
  EXPECT_TRUE(triangles);
  double area = 0.0;
  for (std::size_t i = 0; triangles && i + 2 < triangles->size(); i += 3) {
    const glm::dvec3& a = points[(*triangles)[i]];
    const glm::dvec3 twice = glm::cross(points[(*triangles)[i + 1]] - a, points[(*triangles)[i + 2]] - a);
    EXPECT_GE(glm::dot(twice, up), 0.0);
    area += glm::length(twice) / 2;
  }
  return area;
}

TEST(PolygonFill, FillsConcaveOutlinesEitherWayRound) {
  const Points arrow{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}};
  EXPECT_NEAR(areaOf(arrow, {0, 0, 1}), 10.0, 1e-12);
  const Points backwards(arrow.rbegin(), arrow.rend());
  EXPECT_NEAR(areaOf(backwards, {0, 0, -1}), 10.0, 1e-12);
}

TEST(PolygonFill, FillsOnAnyPlaneAndScale) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    Points star;
    for (int i = 0; i < 10; ++i) {
      const double radius = scale * (i % 2 == 0 ? 2.0 : 1.0);
      const double angle = std::numbers::pi * i / 5;
      star.push_back({radius * std::cos(angle), 0.0, -radius * std::sin(angle)});
    }
    EXPECT_NEAR(areaOf(star, {0, 1, 0}) / (scale * scale), 10.0 * std::sin(std::numbers::pi / 5), 1e-9);
  }
}

TEST(PolygonFill, SurvivesWhatIsNoPolygon) {
  EXPECT_TRUE(fillPolygon({})->empty());
  EXPECT_TRUE(fillPolygon(Points{{0, 0, 0}, {1, 0, 0}})->empty());
  EXPECT_TRUE(fillPolygon(Points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}})->empty()) << "on one line";
  EXPECT_TRUE(fillPolygon(Points(9, glm::dvec3(1, 1, 1)))->empty());
  EXPECT_NEAR(areaOf({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}, {0, 0, 1}), 1.0,
              1e-12)
      << "corners that repeat";
  EXPECT_FALSE(fillPolygon(Points(kMostFilledCorners + 1)));
  test::Random random(5);
  for (int round = 0; round < 50; ++round) {
    Points tangle;
    for (int i = 0; i < 60; ++i) {
      tangle.push_back({random.number(-1, 1), random.number(-1, 1), random.number(-0.1, 0.1)});
    }
    const auto triangles = fillPolygon(tangle);
    ASSERT_TRUE(triangles);
    EXPECT_LE(triangles->size(), 3 * (tangle.size() - 2));
  }
}

}  // namespace
}  // namespace stillframe::nodes
