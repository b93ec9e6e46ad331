#pragma once

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "scenegraph/stopwatch.h"
#include "tools/cli/cli_error.h"
#include "tools/cli/recording_options.h"

namespace stillframe::cli {

/// One measured number, and what it should be where there is a target.
struct BenchResult {
  std::string name;
  double value = 0.0;
  std::string unit;
  std::optional<double> at_most = {};
  std::optional<double> at_least = {};
};

/// Wall time of one call in seconds.
template <typename Function>
double secondsOf(const Function& function) {
  const auto start = std::chrono::steady_clock::now();
  function();
  return scenegraph::secondsSince(start);
}

/// The best of several calls: what the machine can do when nobody disturbs it.
template <typename Function>
double bestSecondsOf(int calls, const Function& function) {
  double best = secondsOf(function);
  for (int call = 1; call < calls; ++call) {
    best = std::min(best, secondsOf(function));
  }
  return best;
}

/// Memory that the program has taken from the heap and not given back.
[[nodiscard]] inline double heapMib() {
  const auto info = ::mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) / (1024.0 * 1024.0);
}

/// Value below which `fraction` of the sorted values lie; not of none.
[[nodiscard]] inline double quantile(const std::vector<double>& sorted, double fraction) {
  return sorted[static_cast<std::size_t>(fraction * static_cast<double>(sorted.size() - 1) + 0.5)];
}

/// Four digits of a value, all of those before the point: 10540, 94.11, 8e-05.
[[nodiscard]] std::string valueText(double value);

// The cases; each appends what it measured.

/// Memory copy, and cloud conversion beside it.
void benchClouds(std::vector<BenchResult>& results);
/// Cloudini and Draco decoding beside memory copy and the bare library.
void benchCodecs(std::vector<BenchResult>& results);
/// States of an occupancy grid under a stream of patches; ticks of a grid map.
void benchGrids(std::vector<BenchResult>& results);
/// Ticks of a robot of 200 links.
void benchRobot(std::vector<BenchResult>& results);
/// Voxel grids: conversion, ticks, and frames with the exposed voxels alone.
void benchVoxels(std::vector<BenchResult>& results);
/// Ticks of layers of poses and paths.
void benchPoses(std::vector<BenchResult>& results);
/// Scans, depth images and grid maps beside memory copy; ticks of a view among 10 000 patches.
void benchSensors(std::vector<BenchResult>& results);
/// Ticks of a topic of markers of which few change.
void benchMarkers(std::vector<BenchResult>& results);
/// Messages of markers and poses, from their bytes to what is drawn, beside memory copy.
void benchMessages(std::vector<BenchResult>& results);
/// Frames of 1 and 10 million points by each rasteriser, and beside the bare loop; frames while the camera moves.
void benchPoints(std::vector<BenchResult>& results);
/// Ticks of 1000 frames with 200 layers in 4 views.
void benchTicks(std::vector<BenchResult>& results);
/// The slider of a recording dragged there and back, twice: from a position to its picture, and what keeps the thread
/// of the window. Memory of the data at rest.
[[nodiscard]] Result<void> benchScrub(const RecordingOptions& options, std::vector<BenchResult>& results);
/// Opening a recording as the window does, to the first picture of its clouds, beside reading what that needs.
[[nodiscard]] Result<void> benchOpen(const RecordingOptions& options, std::vector<BenchResult>& results);
/// Memory and time of 1, 2 and 4 views of one recording, each in a fixed frame of its own.
[[nodiscard]] Result<void> benchViews(const RecordingOptions& options, std::vector<BenchResult>& results);
/// What benchViews() appended as curves over the number of views, memory and time, each to that of one view; an SVG.
[[nodiscard]] std::string viewsPlot(const std::vector<BenchResult>& results, const std::string& caption);
/// The TransformBuffer beside its targets.
void benchTransforms(std::vector<BenchResult>& results);

/// What earlier runs have printed with --json as one table in Markdown, a column a file, by the files' names.
[[nodiscard]] Result<std::string> benchTable(const std::vector<std::string>& files);

}  // namespace stillframe::cli
