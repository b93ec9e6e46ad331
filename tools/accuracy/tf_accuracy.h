#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tools/accuracy/accuracy.h"

namespace stillframe::accuracy {

/// One way of composing a chain of transforms, at one difficulty: what it costs and how far off it is.
struct TfAccuracyRow {
  std::string method;
  std::size_t depth = 0;     ///< edges of the chain
  double offset_m = 0.0;     ///< longest offset of an edge
  double error_m = 0.0;      ///< worst placement error of the chain's end, against the reference
  double error_rad = 0.0;    ///< worst rotation error, loss of orthogonality included
  double nanoseconds = 0.0;  ///< to compose the chain once
};

struct TfAccuracy {
  AccuracyReport report;
  std::vector<TfAccuracyRow> rows;
};

/// Error against run time of the ways of composing a chain of transforms, depths 1 to 1024, offsets 1 to 1e9 m. Seeded:
/// errors are the same in every run, times are measured. Takes about `seconds`, and a second more.
[[nodiscard]] TfAccuracy tfAccuracy(double seconds = 2.0);

}  // namespace stillframe::accuracy
