#pragma once

#include <vector>

#include "tools/bench/bench_line.h"

namespace stillframe::bench {

/// The TransformBuffer's costs beside their targets, for `stillframe bench`. Spends about `seconds_per_case` on each of
/// nine cases, and some seconds on loading an hour of 100 Hz; needs 1.2 GB of memory for that.
[[nodiscard]] std::vector<BenchLine> runTfBench(double seconds_per_case);

}  // namespace stillframe::bench
