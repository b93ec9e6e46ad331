#include "tools/accuracy/transparency_accuracy.h"

#include "tests/support/offscreen_test.h"

namespace stillframe::accuracy {
namespace {

class TransparencyAccuracy : public test::OffscreenTest {};

TEST_F(TransparencyAccuracy, HasNoErrorWhereAllIsInOrderAndLittleWhereWhatMattersIs) {
  const auto measured = transparencyAccuracy(*renderer_, 0.0);
  ASSERT_TRUE(measured) << measured.error().message;
  bool has_default = false;
  for (const TransparencyRow& row : measured->rows) {
    const std::string name = std::to_string(row.layers) + " layers, " + std::to_string(row.most_sorted) + " in order";
    if (row.most_sorted >= row.layers) {
      EXPECT_EQ(row.max_error, 0.0) << name;
    } else if (row.most_sorted == 0) {
      EXPECT_GT(row.max_error, 0.02) << name;
    }
    if (row.most_sorted == scenegraph::BlendLimits{}.most_sorted) {
      has_default = true;
      // A step of a byte; of more layers that each hide next to nothing, those behind make three or so.
      EXPECT_LT(row.max_error, row.layers > scenegraph::BlendLimits{}.most_sorted ? 3.0 / 255.0 : 1.0 / 255.0) << name;
    }
  }
  EXPECT_TRUE(has_default);
  EXPECT_NE(measured->report.svg.find("<svg"), std::string::npos);
}

}  // namespace
}  // namespace stillframe::accuracy
