#include "tf/chain_kernels.h"

#include <cstring>
#include <limits>

#include "tf/chain_accumulator.h"

#ifdef __FAST_MATH__
#error "compensated arithmetic needs IEEE semantics: build without -ffast-math"
#endif
#ifdef GLM_FORCE_QUAT_DATA_WXYZ
#error "a quaternion is loaded as x, y, z, w"
#endif
#if defined(__x86_64__)
#define STILLFRAME_AVX2_KERNELS
#endif

// The arithmetic stands here once, for four plain doubles and for an AVX register. All of it is inlined into functions
// that are compiled for their instruction set; lanes are handed on by reference, as a vector by value would have a
// calling convention of its own in each. This library is compiled without contraction to FMA: all round alike.
#define STILLFRAME_LANES [[gnu::always_inline]] inline

namespace stillframe::tf {
namespace {

struct PlainLanes {
  std::array<double, 4> v;
  STILLFRAME_LANES double operator[](std::size_t i) const { return v[i]; }
};
STILLFRAME_LANES PlainLanes operator+(const PlainLanes& a, const PlainLanes& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}
STILLFRAME_LANES PlainLanes operator-(const PlainLanes& a, const PlainLanes& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
}
STILLFRAME_LANES PlainLanes operator*(const PlainLanes& a, const PlainLanes& b) {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]};
}
/// Lane I of `from`, or with ~I its negative.
template <int I>
STILLFRAME_LANES double signedLane(const PlainLanes& from) {
  constexpr auto kLane = static_cast<std::size_t>(I < 0 ? ~I : I);
  return I < 0 ? -from[kLane] : from[kLane];
}
template <int A, int B, int C, int D>
STILLFRAME_LANES void permute(const PlainLanes& from, PlainLanes& out) {
  out = {signedLane<A>(from), signedLane<B>(from), signedLane<C>(from), signedLane<D>(from)};
}

#ifdef STILLFRAME_AVX2_KERNELS
using VectorLanes [[gnu::vector_size(32)]] = double;
using VectorBits [[gnu::vector_size(32)]] = std::int64_t;

template <int A, int B, int C, int D>
STILLFRAME_LANES void permute(const VectorLanes& from, VectorLanes& out) {
  constexpr std::int64_t kMinus = std::numeric_limits<std::int64_t>::min();
  out = __builtin_shufflevector(from, from, A < 0 ? ~A : A, B < 0 ? ~B : B, C < 0 ? ~C : C, D < 0 ? ~D : D);
  if constexpr (A < 0 || B < 0 || C < 0 || D < 0) {
    constexpr VectorBits kSigns{A < 0 ? kMinus : 0, B < 0 ? kMinus : 0, C < 0 ? kMinus : 0, D < 0 ? kMinus : 0};
    out = reinterpret_cast<VectorLanes>(reinterpret_cast<VectorBits>(out) ^ kSigns);
  }
}
#endif

template <typename Lanes>
STILLFRAME_LANES void fill(double value, Lanes& out) {
  out = Lanes{value, value, value, value};
}

/// Rounded to multiples of 2^-26; the magnitude must stay below 2^25.
template <typename Lanes>
STILLFRAME_LANES void highPart(const Lanes& value, Lanes& out) {
  Lanes rounder;
  fill(1.5 * 67'108'864.0, rounder);  // its ulp is 2^-26
  out = (value + rounder) - rounder;
}

template <typename Lanes>
struct Chain {
  Lanes high, low, sum, rest;

  STILLFRAME_LANES void load(const ChainParts& from) {
    std::memcpy(&high, from.high.data(), sizeof(Lanes));
    std::memcpy(&low, from.low.data(), sizeof(Lanes));
    std::memcpy(&sum, from.sum.data(), sizeof(Lanes));
    std::memcpy(&rest, from.rest.data(), sizeof(Lanes));
  }
  STILLFRAME_LANES void store(ChainParts& to) const {
    std::memcpy(to.high.data(), &high, sizeof(Lanes));
    std::memcpy(to.low.data(), &low, sizeof(Lanes));
    std::memcpy(to.sum.data(), &sum, sizeof(Lanes));
    std::memcpy(to.rest.data(), &rest, sizeof(Lanes));
  }

  /// |q|^2 - 1: the squares of the high parts sum without rounding.
  STILLFRAME_LANES double normExcess() const {
    const Lanes squares = high * high;
    const Lanes tails = (high + (high + low)) * low;
    return (((squares[0] + squares[1]) + (squares[2] + squares[3])) - 1.0) +
           ((tails[0] + tails[1]) + (tails[2] + tails[3]));
  }

  /// Adds R * offset to the translation.
  STILLFRAME_LANES void addRotated(const glm::dvec3& offset_in_end) {
    const Lanes offset{offset_in_end.x, offset_in_end.y, offset_in_end.z, 0.0};
    const Lanes q = high + low;
    Lanes scale, w, offset_yzx, q_yzx, cross, cross_yzx, double_cross;
    fill(2.0 - 2.0 * normExcess(), scale);  // 2 / |q|^2 to first order
    fill(q[3], w);
    permute<1, 2, 0, 3>(offset, offset_yzx);
    permute<1, 2, 0, 3>(q, q_yzx);
    const Lanes cross_zxy = q * offset_yzx - q_yzx * offset;
    permute<1, 2, 0, 3>(cross_zxy, cross);
    permute<1, 2, 0, 3>(cross, cross_yzx);
    const Lanes double_cross_zxy = q * cross_yzx - q_yzx * cross;
    permute<1, 2, 0, 3>(double_cross_zxy, double_cross);
    const Lanes term = offset + scale * (w * cross + double_cross);
    // sum + rest += term, with sum the rounded whole.
    const Lanes rough = sum + term;
    const Lanes shared = rough - sum;
    const Lanes tail = rest + ((sum - (rough - shared)) + (term - shared));
    sum = rough + tail;
    rest = (rough - sum) + tail;
  }

  /// q = q * q0. Only the exact part of the product is rounded to the new high part, as the next link waits for that;
  /// the low part grows by some 2^-26 a link until fold().
  STILLFRAME_LANES void multiply(const Lanes& q0) {
    Lanes q1, q2, q3, h0, h1, h2, h3, ax, ay, az, aw, bx, by, bz, bw;
    highPart(q0, h0);
    permute<3, ~2, 1, ~0>(q0, q1);
    permute<2, 3, ~0, ~1>(q0, q2);
    permute<~1, 0, 3, ~2>(q0, q3);
    permute<3, ~2, 1, ~0>(h0, h1);
    permute<2, 3, ~0, ~1>(h0, h2);
    permute<~1, 0, 3, ~2>(h0, h3);
    fill(high[0], ax);
    fill(high[1], ay);
    fill(high[2], az);
    fill(high[3], aw);
    fill(low[0], bx);
    fill(low[1], by);
    fill(low[2], bz);
    fill(low[3], bw);
    const Lanes lead = (aw * h0 + ax * h1) + (ay * h2 + az * h3);
    const Lanes tail = ((aw * (q0 - h0) + ax * (q1 - h1)) + (ay * (q2 - h2) + az * (q3 - h3))) +
                       ((bw * q0 + bx * q1) + (by * q2 + bz * q3));
    highPart(lead, high);
    low = (lead - high) + tail;
  }

  /// Brings the low part back below 2^-26.
  STILLFRAME_LANES void fold() {
    const Lanes unfolded = high;
    const Lanes whole = high + low;
    highPart(whole, high);
    low = (unfolded - high) + low;
  }

  STILLFRAME_LANES void append(const RigidTransform& link) {
    Lanes rotation;
    std::memcpy(&rotation, &link.rotation, sizeof(rotation));
    addRotated(link.translation);
    multiply(rotation);
  }

  STILLFRAME_LANES void narrow(RigidTransform& out) const {
    Lanes shrink;
    fill(-0.5 * normExcess(), shrink);  // 1 / |q| to first order: the norm is within rounding of 1
    const Lanes rounded = high + (low + high * shrink);
    std::memcpy(&out.rotation, &rounded, sizeof(rounded));
    out.translation = glm::dvec3(sum[0], sum[1], sum[2]);
  }
};

template <typename Lanes>
STILLFRAME_LANES void appendLinks(ChainParts& parts, std::span<const RigidTransform* const> links) {
  Chain<Lanes> chain;
  chain.load(parts);
  for (const RigidTransform* const link : links) {
    chain.append(*link);
  }
  chain.fold();
  chain.store(parts);
}

template <typename Lanes>
STILLFRAME_LANES void appendSteps(std::span<ChainStep> steps) {
  for (ChainStep& step : steps) {
    Chain<Lanes> chain;
    chain.load(*step.from);
    chain.append(*step.link);
    chain.fold();
    chain.store(*step.to);
    chain.narrow(step.rounded);
  }
}

void appendPlain(ChainParts& parts, std::span<const RigidTransform* const> links) noexcept {
  appendLinks<PlainLanes>(parts, links);
}
void appendEachPlain(std::span<ChainStep> steps) noexcept { appendSteps<PlainLanes>(steps); }

#ifdef STILLFRAME_AVX2_KERNELS
[[gnu::target("avx2")]] void appendAvx2(ChainParts& parts, std::span<const RigidTransform* const> links) noexcept {
  appendLinks<VectorLanes>(parts, links);
}
[[gnu::target("avx2")]] void appendEachAvx2(std::span<ChainStep> steps) noexcept { appendSteps<VectorLanes>(steps); }
#endif

}  // namespace

const ChainKernels& ChainKernels::portable() noexcept {
  static constexpr ChainKernels kPlain{appendPlain, appendEachPlain};
  return kPlain;
}

const ChainKernels& ChainKernels::best() noexcept {
#ifdef STILLFRAME_AVX2_KERNELS
  static constexpr ChainKernels kAvx2{appendAvx2, appendEachAvx2};
  static const ChainKernels& best = __builtin_cpu_supports("avx2") != 0 ? kAvx2 : portable();
  return best;
#else
  return portable();
#endif
}

// The rest of ChainAccumulator is here for its arithmetic.

void ChainAccumulator::appendInverse(const RigidTransform& c_from_b) noexcept {
  Chain<PlainLanes> chain;
  chain.load(parts);
  const glm::dquat& q = c_from_b.rotation;
  chain.multiply({-q.x, -q.y, -q.z, q.w});
  chain.addRotated(-c_from_b.translation);
  chain.fold();
  chain.store(parts);
}

RigidTransform ChainAccumulator::narrow() const noexcept {
  Chain<PlainLanes> chain;
  chain.load(parts);
  RigidTransform rounded;
  chain.narrow(rounded);
  return rounded;
}

WideTransform ChainAccumulator::widen() const noexcept {
  const auto rotation = [this](std::size_t i) {
    return static_cast<Wide>(parts.high[i]) + static_cast<Wide>(parts.low[i]);
  };
  const auto translation = [this](std::size_t i) {
    return static_cast<Wide>(parts.sum[i]) + static_cast<Wide>(parts.rest[i]);
  };
  return {rotation(3), rotation(0), rotation(1), rotation(2), translation(0), translation(1), translation(2)};
}

}  // namespace stillframe::tf
