#pragma once

#include <gtest/gtest.h>

#include <string>

#include "scenegraph/export/picture_io.h"

namespace stillframe::test {

/// How far a picture may be from the golden one: another Mesa rounds and rasterises a little differently.
struct GoldenTolerance {
  double pixels = 0.005;  ///< fraction that may differ by more than `step`
  int step = 3;           ///< channel difference that does not count
};

/// Compares with tests/golden/NAME.png. A failure says by how much and leaves NAME_actual.png and NAME_diff.png (ten
/// times the difference) in golden/ of the build tree.
///
/// With STILLFRAME_BLESS=1 in the environment the golden picture is written instead: look at it, then commit it.
/// Numbers about the picture stand beside every use, for a golden picture shows that something changed, not what is
/// right.
[[nodiscard]] testing::AssertionResult matchesGolden(const scenegraph::BytePicture& picture, const std::string& name,
                                                     const GoldenTolerance& tolerance = {});

}  // namespace stillframe::test
