#pragma once

#include <limits>
#include <optional>

#include "tf/rigid_transform.h"

namespace stillframe::tf {

/// Scalar of single compositions. On x86-64 Linux the 80-bit x87 format: 64 bits of mantissa, hardware speed,
/// no FMA needed and no contraction or -ffast-math to fear; on aarch64 Linux IEEE quad (exact but slow).
using Wide = long double;
static_assert(std::numeric_limits<Wide>::digits >= 64, "compositions need more than double's 53 bits");
static_assert(std::numeric_limits<Wide>::max_exponent > 2 * std::numeric_limits<double>::max_exponent,
              "the square of any double must be representable");

/// A rigid transform with 11 bits more than double, for where one product must be right to the last bit of its result.
///
/// The quaternion is not kept unit: every use divides by its squared norm, so the rounding of a stored quaternion's
/// norm does not scale translations. About 85 ns a product on x87: for chains use ChainAccumulator. A value; no thread
/// rules.
struct WideTransform {
  Wide w = 1, x = 0, y = 0, z = 0;
  Wide tx = 0, ty = 0, tz = 0;
};

[[nodiscard]] WideTransform widen(const RigidTransform& b_from_a) noexcept;
/// Rounded to double, with a unit quaternion.
[[nodiscard]] RigidTransform narrow(const WideTransform& b_from_a) noexcept;
/// c_from_a = c_from_b * b_from_a.
[[nodiscard]] WideTransform compose(const WideTransform& c_from_b, const WideTransform& b_from_a) noexcept;
/// b_from_a = inverse(c_from_b) * c_from_a. Translations are subtracted before they are rotated: two frames close to
/// each other and far from c lose nothing.
[[nodiscard]] WideTransform composeInverse(const WideTransform& c_from_b, const WideTransform& c_from_a) noexcept;

/// The same rotation as a unit quaternion; nullopt for norm zero. Any finite norm, 5e-324 and 1.8e308 included, is
/// normalised without overflow or underflow. One that is unit already to within rounding is returned untouched, since
/// rounding it again would only move it.
[[nodiscard]] std::optional<glm::dquat> normalizedRotation(const glm::dquat& rotation) noexcept;

}  // namespace stillframe::tf
