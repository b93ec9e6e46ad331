#include "scenegraph/pipeline/half_float.h"

#include <Imath/half.h>
#include <gtest/gtest.h>

namespace stillframe::scenegraph {
namespace {

TEST(HalfFloat, IsImathsFloatForEveryPattern) {
  for (std::uint32_t bits = 0; bits < 0x10000U; ++bits) {
    const auto pattern = static_cast<std::uint16_t>(bits);
    const float expected = Imath::half(Imath::half::FromBits, pattern);
    ASSERT_EQ(std::bit_cast<std::uint32_t>(floatFromHalf(pattern)), std::bit_cast<std::uint32_t>(expected)) << bits;
  }
}

}  // namespace
}  // namespace stillframe::scenegraph
