#include "nodes/poses/covariance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

namespace stillframe::nodes {
namespace {

/// How far below 0 an eigenvalue of a correlation matrix may lie by rounding: senders store floats too.
constexpr double kCorrelationSlack = 1e-6;

/// Eigenvalues and eigenvectors of a symmetric matrix.
struct Eigen {
  glm::dvec3 values{0.0};
  glm::dmat3 vectors{1.0};
};

/// One rotation that makes m[p][q] zero, applied to the matrix and to the vectors.
void rotate(glm::dmat3& m, glm::dmat3& vectors, int p, int q) {
  const double theta = (0.5 * m[q][q] - 0.5 * m[p][p]) / m[p][q];  // an overflow is a rotation by 0
  const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double c = 1.0 / std::hypot(t, 1.0);
  const double s = t * c;
  const double off = m[p][q];
  m[p][p] -= t * off;
  m[q][q] += t * off;
  m[p][q] = m[q][p] = 0.0;
  const int r = 3 - p - q;
  const double rp = m[r][p];
  const double rq = m[r][q];
  m[r][p] = m[p][r] = c * rp - s * rq;
  m[r][q] = m[q][r] = s * rp + c * rq;
  const glm::dvec3 vp = vectors[p];
  const glm::dvec3 vq = vectors[q];
  vectors[p] = c * vp - s * vq;
  vectors[q] = s * vp + c * vq;
}

/// Cyclic Jacobi. Stops when each entry is nothing against the geometric mean of its two diagonals, so that small
/// eigenvalues of positive matrices keep their own digits.
Eigen eigenOf(glm::dmat3 m) {
  constexpr int kMostSweeps = 60;
  constexpr double kEps = std::numeric_limits<double>::epsilon();
  Eigen eigen;
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    bool is_diagonal = true;
    for (const auto& [p, q] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
      const double mean = std::sqrt(std::abs(m[p][p])) * std::sqrt(std::abs(m[q][q]));
      if (std::abs(m[p][q]) > kEps * mean && std::abs(m[p][q]) > std::numeric_limits<double>::min()) {
        rotate(m, eigen.vectors, p, q);
        is_diagonal = false;
      }
    }
    if (is_diagonal) {
      break;
    }
  }
  eigen.values = {m[0][0], m[1][1], m[2][2]};
  return eigen;
}

/// Whether the matrix is one of covariances: judged on correlations, which know no units.
bool isPositive(const glm::dmat3& m) {
  glm::dmat3 correlation(1.0);
  for (int i = 0; i < 3; ++i) {
    if (m[i][i] < 0.0) {
      return false;
    }
    for (int j = 0; j < 3; ++j) {
      if (i == j) {
        continue;
      }
      const double mean = std::sqrt(m[i][i]) * std::sqrt(m[j][j]);
      if (std::abs(m[i][j]) > mean * (1.0 + kCorrelationSlack)) {
        return false;
      }
      correlation[i][j] = mean > 0.0 ? m[i][j] / mean : 0.0;
    }
  }
  const Eigen eigen = eigenOf(correlation);
  return std::min({eigen.values.x, eigen.values.y, eigen.values.z}) >= -kCorrelationSlack;
}

glm::dmat3 blockOf(const std::array<double, 36>& covariance, std::size_t first) {
  glm::dmat3 block;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      block[static_cast<int>(column)][static_cast<int>(row)] = covariance[6 * (first + row) + first + column];
    }
  }
  return block;
}

/// Two unit vectors across `axis`, which is the third of a right-handed system.
glm::dmat3 systemAbout(const glm::dvec3& axis) {
  const glm::dvec3 other = std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(other, axis));
  return {x, glm::cross(axis, x), axis};
}

}  // namespace

std::expected<Spread, CovarianceError> spreadOf(const glm::dmat3& covariance) {
  glm::dmat3 m;
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      m[i][j] = 0.5 * covariance[i][j] + 0.5 * covariance[j][i];
      if (!std::isfinite(m[i][j])) {
        return std::unexpected(CovarianceError::NotFinite);
      }
      largest = std::max(largest, std::abs(m[i][j]));
    }
  }
  Spread spread;
  if (largest == 0.0) {
    return spread;
  }
  if (!isPositive(m)) {
    return std::unexpected(CovarianceError::NotPositive);
  }
  const Eigen eigen = eigenOf(m);
  for (int i = 0; i < 3; ++i) {
    spread.sigma[i] = std::sqrt(std::max(eigen.values[i], 0.0));
  }
  spread.axes = eigen.vectors;
  if (glm::determinant(spread.axes) < 0.0) {
    spread.axes[2] = -spread.axes[2];
  }
  return spread;
}

std::expected<Spread, CovarianceError> directionSpreadOf(const glm::dmat3& rotation_covariance,
                                                         const glm::dvec3& axis) {
  // A small rotation w moves the axis by w x axis: along u and v across it by v.w and -u.w.
  const glm::dmat3 system = systemAbout(axis);
  const glm::dvec3 along_u = system[1];
  const glm::dvec3 along_v = -system[0];
  const auto product = [&](const glm::dvec3& a, const glm::dvec3& b) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        // 0 times an unknown that is given as infinite must not spoil the rest.
        sum += a[i] == 0.0 || b[j] == 0.0 ? 0.0 : a[i] * b[j] * rotation_covariance[i][j];
      }
    }
    return sum;
  };
  glm::dmat3 across(0.0);
  across[0][0] = product(along_u, along_u);
  across[1][1] = product(along_v, along_v);
  across[0][1] = across[1][0] = 0.5 * product(along_u, along_v) + 0.5 * product(along_v, along_u);
  auto spread = spreadOf(across);
  if (spread) {
    // The third axis of `across` is untouched by the rotations: column 2 stays the axis itself.
    spread->axes = system * spread->axes;
    if (glm::dot(spread->axes[2], axis) < 0.0) {
      spread->axes[2] = -spread->axes[2];
      spread->axes[1] = -spread->axes[1];
    }
  }
  return spread;
}

glm::dmat3 positionBlock(const std::array<double, 36>& covariance) { return blockOf(covariance, 0); }

glm::dmat3 rotationBlock(const std::array<double, 36>& covariance) { return blockOf(covariance, 3); }

}  // namespace stillframe::nodes
