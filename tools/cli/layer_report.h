#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scenegraph/scene.h"
#include "tools/cli/json_text.h"

namespace stillframe::cli {

/// What every layer of a scene says of itself: topic, type, frame, visible, status and counts.
[[nodiscard]] Json layersJson(const scenegraph::Scene& scene);
/// The faults found in the recording: code, message, count.
[[nodiscard]] Json problemsJson(std::span<const scenegraph::Problem> problems);
/// "  WHAT: LINE" on stdout for each.
void printLines(std::string_view what, std::span<const std::string> lines);
/// A line on stdout for each layer that has something to say, and for each problem.
void printRemarks(const scenegraph::Scene& scene, const scenegraph::Dataset& dataset);

}  // namespace stillframe::cli
