#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace stillframe::nodes {

/// Why a covariance matrix has no shape.
enum class CovarianceError : std::uint8_t {
  NotFinite,    ///< a NaN or an infinity
  NotPositive,  ///< a negative variance, or a correlation beyond 1
};

/// Principal axes of a covariance: unit vectors, right-handed, and the standard deviation along each, 0 where the
/// matrix is singular.
struct Spread {
  glm::dmat3 axes{1.0};  ///< columns
  glm::dvec3 sigma{0.0};
};

/// Of the symmetric part of `covariance`, in its own units. Sound for entries from 1e-300 to 1e300 side by side: each
/// standard deviation is right to its own digits, not to those of the largest (Jacobi rotations, stopped by the
/// correlation that is left). Negative eigenvalues within rounding of the correlations count as 0.
[[nodiscard]] std::expected<Spread, CovarianceError> spreadOf(const glm::dmat3& covariance);

/// Spread of the direction `axis` (unit) when the rotation has this covariance about the fixed axes x, y, z (rad^2), as
/// ROS gives it: angles across the axis. The third column is the axis itself, with 0.
[[nodiscard]] std::expected<Spread, CovarianceError> directionSpreadOf(const glm::dmat3& rotation_covariance,
                                                                       const glm::dvec3& axis);

/// Blocks of the row-major 6 x 6 matrix x, y, z, rx, ry, rz of ROS.
[[nodiscard]] glm::dmat3 positionBlock(const std::array<double, 36>& covariance);
[[nodiscard]] glm::dmat3 rotationBlock(const std::array<double, 36>& covariance);

}  // namespace stillframe::nodes
