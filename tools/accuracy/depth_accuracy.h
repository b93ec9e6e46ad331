#pragma once

#include <string>
#include <vector>

#include "tools/accuracy/accuracy.h"

namespace stillframe::accuracy {

/// One way of turning a lens round, held against rays that are known beforehand.
struct DepthAccuracyRow {
  std::string lens;
  std::string method;
  int steps = 0;             ///< at most; 0 for a way that ends by itself
  double error_px = 0.0;     ///< worst over the picture, in pixels at its middle
  double residual_px = 0.0;  ///< worst distance of the forward model of what was found from the pixel
  std::size_t lost = 0;      ///< pixels that have a ray for which none was found
  double nanoseconds = 0.0;  ///< a pixel
};

struct DepthAccuracy {
  AccuracyReport report;
  std::vector<DepthAccuracyRow> rows;
};

/// Error against run time of rectifying depth images: the layer's guarded Newton steps, the same rounded to the floats
/// that are uploaded, and the usual fixed-point steps, for lenses of each distortion model. Takes about a second.
[[nodiscard]] DepthAccuracy depthAccuracy();

}  // namespace stillframe::accuracy
