#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "tf/rigid_transform.h"

namespace stillframe::accuracy {

#if defined(__SIZEOF_FLOAT128__)
__extension__ using Quad = __float128;
#else
using Quad = long double;
#endif

/// A rigid transform as matrix and vector with 113 bits, to judge others by. Slow; needs no libquadmath: a quaternion's
/// norm is divided out without a square root.
struct RigidReference {
  std::array<std::array<Quad, 3>, 3> rotation{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<Quad, 3> translation{0, 0, 0};

  RigidReference() = default;
  /// The rotation that the quaternion, of whatever norm, stands for exactly.
  explicit RigidReference(const tf::RigidTransform& transform) {
    const Quad w = transform.rotation.w, x = transform.rotation.x, y = transform.rotation.y, z = transform.rotation.z;
    const Quad s = 2 / (w * w + x * x + y * y + z * z);
    rotation = {{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                 {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
                 {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}};
    translation = {transform.translation.x, transform.translation.y, transform.translation.z};
  }
  /// The matrix as it is, orthogonal or not.
  explicit RigidReference(const glm::dmat4& matrix) {
    for (glm::length_t row = 0; row < 3; ++row) {
      for (glm::length_t column = 0; column < 3; ++column) {
        rotation[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = matrix[column][row];
      }
      translation[static_cast<std::size_t>(row)] = matrix[3][row];
    }
  }
};

[[nodiscard]] inline RigidReference operator*(const RigidReference& c_from_b, const RigidReference& b_from_a) {
  RigidReference out;
  for (std::size_t i = 0; i < 3; ++i) {
    out.translation[i] = c_from_b.translation[i];
    for (std::size_t k = 0; k < 3; ++k) {
      out.translation[i] += c_from_b.rotation[i][k] * b_from_a.translation[k];
      out.rotation[i][k] = 0;
      for (std::size_t j = 0; j < 3; ++j) {
        out.rotation[i][k] += c_from_b.rotation[i][j] * b_from_a.rotation[j][k];
      }
    }
  }
  return out;
}

[[nodiscard]] inline RigidReference inverse(const RigidReference& b_from_a) {
  RigidReference out;
  for (std::size_t i = 0; i < 3; ++i) {
    out.translation[i] = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      out.rotation[i][k] = b_from_a.rotation[k][i];
      out.translation[i] -= b_from_a.rotation[k][i] * b_from_a.translation[k];
    }
  }
  return out;
}

/// Distance between the images of the origin, metres.
[[nodiscard]] inline double placementError(const RigidReference& actual, const RigidReference& expected) {
  Quad sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Quad difference = actual.translation[i] - expected.translation[i];
    sum += difference * difference;
  }
  return std::sqrt(static_cast<double>(sum));
}

/// Angle between the rotations, radians, for small angles (Frobenius norm of the difference over sqrt 2).
[[nodiscard]] inline double rotationError(const RigidReference& actual, const RigidReference& expected) {
  Quad sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Quad difference = actual.rotation[i][k] - expected.rotation[i][k];
      sum += difference * difference;
    }
  }
  return std::sqrt(static_cast<double>(sum) / 2.0);
}

}  // namespace stillframe::accuracy
