#pragma once

#include <expected>
#include <string>
#include <vector>

#include "scenegraph/pipeline/offscreen_renderer.h"
#include "scenegraph/status.h"
#include "tools/accuracy/accuracy.h"

namespace stillframe::accuracy {

/// One way of drawing the same picture: what it costs and how far off it is.
struct PostRow {
  std::string subject;     ///< what is varied, and so what it is compared with
  std::string way;         ///< the value
  double rmse = 0.0;       ///< of linear light where 1 is white, against the subject's reference
  double max_error = 0.0;  ///< of one channel of one pixel
  double frame_ms = 0.0;   ///< shortest of several frames, all of it
  double extra_ms = 0.0;   ///< beyond a frame without the effect
};

struct PostReport {
  AccuracyReport report;
  std::vector<PostRow> rows;
};

/// Error against run time of the post passes: samples, radius and resolution of the ambient occlusion against 1024
/// samples, neighbours of the eye-dome lighting against 128, formats of targets against 32-bit floats, anti-aliasing
/// against 64 samples of the whole picture. Draws a scene of its own; takes about `seconds`, and the references.
[[nodiscard]] std::expected<PostReport, scenegraph::Status> postAccuracy(scenegraph::OffscreenRenderer& renderer,
                                                                         double seconds = 20.0);

}  // namespace stillframe::accuracy
