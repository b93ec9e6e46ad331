#include "tf/wide_transform.h"

#include <cmath>

namespace stillframe::tf {
namespace {

struct WideVector {
  Wide x, y, z;
};

/// 2 / |q|^2, which makes rotated() exact for a quaternion of any norm.
Wide twoOverSquaredNorm(Wide w, Wide x, Wide y, Wide z) noexcept { return 2 / ((w * w + x * x) + (y * y + z * z)); }

/// v + s * (w * (u x v) + u x (u x v)) with u = (x, y, z).
WideVector rotated(Wide w, Wide x, Wide y, Wide z, const WideVector& v) noexcept {
  const Wide s = twoOverSquaredNorm(w, x, y, z);
  const Wide cx = y * v.z - z * v.y;
  const Wide cy = z * v.x - x * v.z;
  const Wide cz = x * v.y - y * v.x;
  return {v.x + s * (w * cx + (y * cz - z * cy)), v.y + s * (w * cy + (z * cx - x * cz)),
          v.z + s * (w * cz + (x * cy - y * cx))};
}

void multiplyRotations(const WideTransform& l, const WideTransform& r, WideTransform& out) noexcept {
  out.w = (l.w * r.w - l.x * r.x) - (l.y * r.y + l.z * r.z);
  out.x = (l.w * r.x + l.x * r.w) + (l.y * r.z - l.z * r.y);
  out.y = (l.w * r.y + l.y * r.w) + (l.z * r.x - l.x * r.z);
  out.z = (l.w * r.z + l.z * r.w) + (l.x * r.y - l.y * r.x);
}

}  // namespace

WideTransform widen(const RigidTransform& b_from_a) noexcept {
  const glm::dquat& q = b_from_a.rotation;
  const glm::dvec3& t = b_from_a.translation;
  return {q.w, q.x, q.y, q.z, t.x, t.y, t.z};
}

RigidTransform narrow(const WideTransform& a) noexcept {
  const Wide scale = 1 / std::sqrt((a.w * a.w + a.x * a.x) + (a.y * a.y + a.z * a.z));
  return {glm::dquat(static_cast<double>(a.w * scale), static_cast<double>(a.x * scale),
                     static_cast<double>(a.y * scale), static_cast<double>(a.z * scale)),
          glm::dvec3(static_cast<double>(a.tx), static_cast<double>(a.ty), static_cast<double>(a.tz))};
}

WideTransform compose(const WideTransform& c_from_b, const WideTransform& b_from_a) noexcept {
  const WideVector v = rotated(c_from_b.w, c_from_b.x, c_from_b.y, c_from_b.z, {b_from_a.tx, b_from_a.ty, b_from_a.tz});
  WideTransform out;
  multiplyRotations(c_from_b, b_from_a, out);
  out.tx = v.x + c_from_b.tx;
  out.ty = v.y + c_from_b.ty;
  out.tz = v.z + c_from_b.tz;
  return out;
}

WideTransform composeInverse(const WideTransform& c_from_b, const WideTransform& c_from_a) noexcept {
  const WideTransform conjugate{c_from_b.w, -c_from_b.x, -c_from_b.y, -c_from_b.z, 0, 0, 0};
  const WideVector v = rotated(conjugate.w, conjugate.x, conjugate.y, conjugate.z,
                               {c_from_a.tx - c_from_b.tx, c_from_a.ty - c_from_b.ty, c_from_a.tz - c_from_b.tz});
  WideTransform out;
  multiplyRotations(conjugate, c_from_a, out);
  out.tx = v.x;
  out.ty = v.y;
  out.tz = v.z;
  return out;
}

std::optional<glm::dquat> normalizedRotation(const glm::dquat& rotation) noexcept {
  const Wide w = rotation.w, x = rotation.x, y = rotation.y, z = rotation.z;
  const Wide squared_norm = (w * w + x * x) + (y * y + z * z);
  if (!(squared_norm > 0)) {
    return std::nullopt;
  }
  // Rounding the four components of a unit quaternion moves its squared norm by up to 2 epsilon.
  if (std::abs(squared_norm - 1) <= 2 * static_cast<Wide>(std::numeric_limits<double>::epsilon())) {
    return rotation;
  }
  const Wide scale = 1 / std::sqrt(squared_norm);
  return glm::dquat(static_cast<double>(w * scale), static_cast<double>(x * scale), static_cast<double>(y * scale),
                    static_cast<double>(z * scale));
}

}  // namespace stillframe::tf
