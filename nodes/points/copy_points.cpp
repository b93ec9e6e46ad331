#include "nodes/points/copy_points.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

// The loop stands here once, for one point in a register of four floats and for two in an AVX register. All of it is
// inlined into functions that are compiled for their instruction set; vectors are handed on by reference, as by value
// they would have a calling convention of their own in each.
#define STILLFRAME_LANES [[gnu::always_inline]] inline

namespace stillframe::nodes {
namespace {

// x, y, z and whatever follows, which is never looked at.
using Float4 [[gnu::vector_size(16)]] = float;
using Int4 [[gnu::vector_size(16)]] = std::int32_t;

/// Whether the first three lanes are finite.
STILLFRAME_LANES bool isFinite(const Float4& p) {
  const Int4 is_number = p * Float4{} == Float4{};  // zero times infinity is no number
#if defined(__x86_64__)
  return (__builtin_ia32_movmskps(std::bit_cast<Float4>(is_number)) & 0b111) == 0b111;
#else
  return (is_number[0] & is_number[1] & is_number[2]) != 0;
#endif
}

STILLFRAME_LANES void load(const std::byte* at, std::size_t /*step*/, Float4& out) {
  std::memcpy(&out, at, sizeof(out));
}
/// The fourth lane is overwritten by the next store.
STILLFRAME_LANES void store(const Float4& p, float* out) { std::memcpy(out, &p, sizeof(p)); }
STILLFRAME_LANES void spread(const Float4& axes, Float4& out) { out = axes; }
STILLFRAME_LANES void split(const Float4& p, Float4& first, Float4& second) { first = second = p; }

#if defined(__x86_64__)
using Float8 [[gnu::vector_size(32)]] = float;

STILLFRAME_LANES void split(const Float8& p, Float4& first, Float4& second) {
  first = __builtin_shufflevector(p, p, 0, 1, 2, 3);
  second = __builtin_shufflevector(p, p, 4, 5, 6, 7);
}
STILLFRAME_LANES void load(const std::byte* at, std::size_t step, Float8& out) {
  Float4 first;
  Float4 second;
  std::memcpy(&first, at, sizeof(first));
  std::memcpy(&second, at + step, sizeof(second));
  out = __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7);
}
STILLFRAME_LANES void store(const Float8& p, float* out) {
  Float4 first;
  Float4 second;
  split(p, first, second);
  store(first, out);
  store(second, out + 3);
}
STILLFRAME_LANES void spread(const Float4& axes, Float8& out) {
  out = __builtin_shufflevector(axes, axes, 0, 1, 2, 3, 0, 1, 2, 3);
}
#endif

/// Blocks copied until one holds a coordinate that is not finite.
template <typename Vector>
STILLFRAME_LANES std::size_t copyFinite(const std::byte* at, std::size_t step, std::size_t blocks, float* out,
                                        FloatBox& box) {
  constexpr std::size_t kPoints = sizeof(Vector) / 16;  // of a register
  constexpr std::size_t kRegisters = kCopyBlock / kPoints;
  Vector low;
  Vector high;
  spread(Float4{box.low[0], box.low[1], box.low[2], 0.0F}, low);
  spread(Float4{box.high[0], box.high[1], box.high[2], 0.0F}, high);
  std::size_t done = 0;
  for (; done < blocks; ++done, at += kCopyBlock * step, out += 3 * kCopyBlock) {
    std::array<Vector, kRegisters> p;
#pragma GCC unroll 8
    for (std::size_t i = 0; i < kRegisters; ++i) {
      load(at + i * kPoints * step, step, p[i]);
    }
    // Their sum is finite only if all are. Should it overflow, the points are looked at one by one.
    std::array<Vector, kRegisters> sums = p;
    std::array<Vector, kRegisters> lows = p;
    std::array<Vector, kRegisters> highs = p;
#pragma GCC unroll 8
    for (std::size_t half = kRegisters / 2; half > 0; half /= 2) {
#pragma GCC unroll 8
      for (std::size_t i = 0; i < half; ++i) {
        sums[i] = sums[i] + sums[i + half];
        lows[i] = lows[i] < lows[i + half] ? lows[i] : lows[i + half];
        highs[i] = highs[i] > highs[i + half] ? highs[i] : highs[i + half];
      }
    }
    Float4 first_sum;
    Float4 second_sum;
    split(sums[0], first_sum, second_sum);
    if (!isFinite(first_sum + second_sum)) {
      break;
    }
    low = low < lows[0] ? low : lows[0];
    high = high > highs[0] ? high : highs[0];
#pragma GCC unroll 8
    for (std::size_t i = 0; i < kRegisters; ++i) {
      store(p[i], out + 3 * kPoints * i);
    }
  }
  Float4 first_low, second_low, first_high, second_high;
  split(low, first_low, second_low);
  split(high, first_high, second_high);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(first_low[axis], second_low[axis]);
    box.high[axis] = std::max(first_high[axis], second_high[axis]);
  }
  return done;
}

using CopyFinite = std::size_t (*)(const std::byte*, std::size_t, std::size_t, float*, FloatBox&);

std::size_t copyFinitePlain(const std::byte* at, std::size_t step, std::size_t blocks, float* out, FloatBox& box) {
  return copyFinite<Float4>(at, step, blocks, out, box);
}

#if defined(__x86_64__)
[[gnu::target("avx")]] std::size_t copyFiniteAvx(const std::byte* at, std::size_t step, std::size_t blocks, float* out,
                                                 FloatBox& box) {
  return copyFinite<Float8>(at, step, blocks, out, box);
}
#endif

CopyFinite copyFiniteOfThisProcessor() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx") != 0) {
    return copyFiniteAvx;
  }
#endif
  return copyFinitePlain;
}

}  // namespace

CopiedPoints copyPoints(const std::byte* points, std::size_t step, std::size_t blocks, float reach, float* out,
                        FloatBox& box) {
  static const CopyFinite copy_finite = copyFiniteOfThisProcessor();
  constexpr std::size_t kChunk = 512 / kCopyBlock;  // so many at a time: the reach is looked up in their box
  std::size_t done = 0;
  while (done < blocks) {
    const std::size_t wanted = std::min(kChunk, blocks - done);
    FloatBox grown = box;
    const std::size_t copied =
        copy_finite(points + done * kCopyBlock * step, step, wanted, out + 3 * kCopyBlock * done, grown);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (grown.low[axis] < -reach || grown.high[axis] > reach) {
        return {done, wanted * kCopyBlock};
      }
    }
    box = grown;
    done += copied;
    if (copied < wanted) {
      return {done, kCopyBlock};
    }
  }
  return {done, 0};
}

}  // namespace stillframe::nodes
