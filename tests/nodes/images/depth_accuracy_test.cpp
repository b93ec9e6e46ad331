#include "tools/accuracy/depth_accuracy.h"

#include <gtest/gtest.h>

namespace stillframe::test {
namespace {

TEST(DepthAccuracy, TheLayerInvertsEveryLensWhereFixedPointStepsDoNot) {
  const auto accuracy = accuracy::depthAccuracy();
  ASSERT_EQ(accuracy.rows.size(), 4U * 10);
  double worst_of_five_steps_px = 0.0;
  for (const auto& row : accuracy.rows) {
    EXPECT_GT(row.nanoseconds, 0.0);
    if (row.method == "guarded Newton (the layer)") {
      EXPECT_EQ(row.lost, 0U) << row.lens;
      EXPECT_LT(row.residual_px, 1e-8) << row.lens;
      EXPECT_LT(row.error_px, 1e-7) << row.lens;
    } else if (row.method == "fixed point") {
      worst_of_five_steps_px = row.steps == 5 ? std::max(worst_of_five_steps_px, row.error_px) : worst_of_five_steps_px;
    } else {
      EXPECT_LT(row.error_px, 1e-4) << row.lens << ": floats";
      EXPECT_GT(row.error_px, 1e-7) << row.lens << ": floats were compared";
    }
  }
  EXPECT_GT(worst_of_five_steps_px, 0.1) << "the usual way would have done";
  EXPECT_NE(accuracy.report.table.find("| equidistant, a fisheye | fixed point | 5 |"), std::string::npos);
  EXPECT_NE(accuracy.report.svg.find("</svg>"), std::string::npos);
}

}  // namespace
}  // namespace stillframe::test
