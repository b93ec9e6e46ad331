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

TEST(HalfFloat, RoundsAsImathDoes) {
  for (std::uint32_t bits = 0; bits < std::bit_cast<std::uint32_t>(65504.0F); bits += 977) {
    const auto value = std::bit_cast<float>(bits);
    ASSERT_EQ(halfFromFloat(value), Imath::half(value).bits()) << value;
  }
  EXPECT_EQ(halfFromFloat(65504.0F), 0x7bff);
}

}  // namespace
}  // namespace stillframe::scenegraph
