#pragma once

#include <expected>
#include <string>
#include <vector>

#include "scenegraph/pipeline/offscreen_renderer.h"
#include "scenegraph/status.h"
#include "tools/accuracy/accuracy.h"

namespace stillframe::accuracy {

/// Blended fragments put in order only so far: what it costs and how far off it is.
struct TransparencyRow {
  int layers = 0;          ///< that each pixel has about
  double opacity = 0.0;    ///< of each
  int most_sorted = 0;     ///< 0: weighted blending
  double rmse = 0.0;       ///< of linear light where 1 is white, against all of them in order
  double max_error = 0.0;  ///< of one channel of one pixel
  double frame_ms = 0.0;   ///< shortest of several
};

struct TransparencyReport {
  AccuracyReport report;
  std::vector<TransparencyRow> rows;
};

/// Error against run time of blending without all fragments in order, for few and for many layers of panes that run
/// through each other. Draws a scene of its own; takes about `seconds`.
[[nodiscard]] std::expected<TransparencyReport, scenegraph::Status> transparencyAccuracy(
    scenegraph::OffscreenRenderer& renderer, double seconds = 10.0);

}  // namespace stillframe::accuracy
