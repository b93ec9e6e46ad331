#include "tools/accuracy/depth_accuracy.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>

#include "nodes/images/camera_model.h"
#include "tools/accuracy/svg_plot.h"

namespace stillframe::accuracy {
namespace {

using nodes::CameraModel;
using Point = CameraModel::Point;

constexpr double kFocal_px = 525.0;
constexpr double kCentreU_px = 319.5;
constexpr double kCentreV_px = 239.5;
constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 480;

struct Lens {
  std::string name;
  std::string model;
  std::vector<double> distortion;
};
std::vector<Lens> lenses() {
  return {{"plumb_bob, a webcam", "plumb_bob", {-0.10, 0.02, 0.0003, -0.0002, 0.0}},
          {"plumb_bob, wide", "plumb_bob", {-0.33, 0.13, 0.0006, -0.0004, -0.022}},
          {"rational_polynomial", "rational_polynomial", {0.5, -2.6, 0.0005, -0.0003, 1.4, 0.4, -2.4, 1.4}},
          {"equidistant, a fisheye", "equidistant", {-0.015, 0.02, -0.018, 0.004}}};
}

CameraModel modelOf(const Lens& lens) {
  scenegraph::CameraInfo info;
  info.width = kWidth;
  info.height = kHeight;
  info.k = {kFocal_px, 0.0, kCentreU_px, 0.0, kFocal_px, kCentreV_px, 0.0, 0.0, 1.0};
  info.distortion_model = lens.model;
  info.distortion = lens.distortion;
  auto model = CameraModel::make(info, kWidth, kHeight, nodes::PixelGrid::Raw);
  if (!model) {
    throw std::logic_error(model.error().message);
  }
  return *model;
}

/// A ray, and the pixel in which the lens draws it.
struct Sample {
  Point ideal;
  double u = 0.0;
  double v = 0.0;
};

/// Rays all over the picture, from which the pixels follow: what is to be found is known to the last bit.
std::vector<Sample> samplesOf(const CameraModel& model) {
  std::vector<Sample> samples;
  constexpr int kSide = 161;
  constexpr double kReach = 0.75;  // tangent at the picture's edge, and somewhat more
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const Point ideal{kReach * (2.0 * i / (kSide - 1) - 1.0), kReach * (2.0 * j / (kSide - 1) - 1.0)};
      const Point seen = model.distorted(ideal);
      const Sample sample{ideal, seen.x * kFocal_px + kCentreU_px, seen.y * kFocal_px + kCentreV_px};
      if (sample.u >= -0.5 && sample.v >= -0.5 && sample.u < kWidth - 0.5 && sample.v < kHeight - 0.5) {
        samples.push_back(sample);
      }
    }
  }
  return samples;
}

/// x <- x + seen - distorted(x): what undistortPoints of the common libraries does, five steps by default.
Point fixedPoint(const CameraModel& model, const Sample& sample, int steps) {
  const Point seen{(sample.u - kCentreU_px) / kFocal_px, (sample.v - kCentreV_px) / kFocal_px};
  Point at = seen;
  for (int step = 0; step < steps; ++step) {
    const Point bent = model.distorted(at);
    at = {at.x + seen.x - bent.x, at.y + seen.y - bent.y};
  }
  return at;
}

std::optional<Point> newton(const CameraModel& model, const Sample& sample, bool as_floats) {
  const auto ray = model.ray(sample.u, sample.v);
  if (!ray) {
    return std::nullopt;
  }
  if (!as_floats) {
    return ray->at;
  }
  const volatile auto x = static_cast<float>(ray->at.x);  // g++ 12 -O3 leaves the rounding of both branches out
  const volatile auto y = static_cast<float>(ray->at.y);
  return Point{static_cast<double>(x), static_cast<double>(y)};
}

DepthAccuracyRow measure(const Lens& lens, const std::string& method, int steps, const std::vector<Sample>& samples,
                         const CameraModel& model, const std::function<std::optional<Point>(const Sample&)>& invert) {
  DepthAccuracyRow row{lens.name, method, steps};
  const auto distance_px = [](const Point& a, const Point& b) {
    const double distance = kFocal_px * std::hypot(a.x - b.x, a.y - b.y);
    return std::isfinite(distance) ? distance : 1e9;
  };
  for (const Sample& sample : samples) {
    const auto found = invert(sample);
    if (!found) {
      ++row.lost;
      continue;
    }
    row.error_px = std::max(row.error_px, distance_px(*found, sample.ideal));
    row.residual_px = std::max(row.residual_px, distance_px(model.distorted(*found), model.distorted(sample.ideal)));
  }
  using Clock = std::chrono::steady_clock;
  double best = std::numeric_limits<double>::infinity();
  volatile double sink = 0.0;
  for (int round = 0; round < 5; ++round) {
    const auto before = Clock::now();
    for (const Sample& sample : samples) {
      sink = invert(sample).value_or(Point{}).x;
    }
    const std::chrono::duration<double, std::nano> took = Clock::now() - before;
    best = std::min(best, took.count() / static_cast<double>(samples.size()));
  }
  (void)sink;
  row.nanoseconds = best;
  return row;
}

std::string tableOf(const std::vector<DepthAccuracyRow>& rows) {
  std::string table(
      "| lens | way | steps | error (px) | residual (px) | without a ray | time (ns a pixel) |\n"
      "|---|---|--:|--:|--:|--:|--:|\n");
  for (const DepthAccuracyRow& row : rows) {
    std::array<char, 200> line{};
    std::snprintf(line.data(), line.size(), "| %s | %s | %s | %.1e | %.1e | %zu | %.0f |\n", row.lens.c_str(),
                  row.method.c_str(), row.steps > 0 ? std::to_string(row.steps).c_str() : "", row.error_px,
                  row.residual_px, row.lost, row.nanoseconds);
    table += line.data();
  }
  return table;
}

std::string plotOf(const std::vector<DepthAccuracyRow>& rows) {
  PlotFigure figure;
  figure.title = "Rectifying depth images: error against run time";
  figure.caption = "Fixed point: 1, 2, 3, 5, 10, 20, 50, 100 steps from left to right. Worst pixel of 640 x 480.";
  figure.x_label = "time a pixel (ns)";
  figure.y_label = "error of the ray (px)";
  for (const Lens& lens : lenses()) {
    PlotPanel panel;
    panel.title = lens.name;
    for (const DepthAccuracyRow& row : rows) {
      if (row.lens != lens.name) {
        continue;
      }
      if (panel.series.empty() || panel.series.back().name != row.method) {
        panel.series.push_back({row.method, {}});
      }
      panel.series.back().points.push_back({row.nanoseconds, row.error_px});
    }
    figure.panels.push_back(panel);
  }
  return renderSvg(figure);
}

}  // namespace

DepthAccuracy depthAccuracy() {
  DepthAccuracy accuracy;
  for (const Lens& lens : lenses()) {
    const CameraModel model = modelOf(lens);
    const std::vector<Sample> samples = samplesOf(model);
    for (const int steps : {1, 2, 3, 5, 10, 20, 50, 100}) {
      accuracy.rows.push_back(measure(lens, "fixed point", steps, samples, model, [&](const Sample& sample) {
        return std::optional(fixedPoint(model, sample, steps));
      }));
    }
    accuracy.rows.push_back(measure(lens, "guarded Newton (the layer)", 0, samples, model,
                                    [&](const Sample& sample) { return newton(model, sample, false); }));
    accuracy.rows.push_back(measure(lens, "the same as FLOAT32 (uploaded)", 0, samples, model,
                                    [&](const Sample& sample) { return newton(model, sample, true); }));
  }
  accuracy.report = {.name = "depth", .table = tableOf(accuracy.rows), .svg = plotOf(accuracy.rows)};
  return accuracy;
}

}  // namespace stillframe::accuracy
