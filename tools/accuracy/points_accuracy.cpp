#include "tools/accuracy/points_accuracy.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <osg/Geometry>
#include <osg/NodeVisitor>

#include "scenegraph/export/picture_io.h"
#include "scenegraph/geometry.h"
#include "scenegraph/pipeline/half_float.h"
#include "scenegraph/pipeline/point_collection.h"
#include "tools/accuracy/svg_plot.h"

namespace stillframe::accuracy {
namespace {

using scenegraph::kPassesOfSample;
using scenegraph::PointBatch;
using scenegraph::PointCollection;

constexpr int kWidthPx = 1280;
constexpr int kHeightPx = 720;
constexpr int kRepeats = 5;
constexpr std::array<std::uint32_t, 10> kPasses{1, 2, 5, 10, 20, 51, 102, 256, 512, kPassesOfSample};

double milliseconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

/// What an error is measured on: bytes as they are shown, and whether a pixel has points.
struct Seen {
  std::vector<std::uint8_t> rgb;
  std::vector<bool> is_covered;
};

Seen seenOf(scenegraph::Picture picture) {
  Seen seen;
  for (const float depth : picture.depth_m) {
    seen.is_covered.push_back(std::isfinite(depth));
  }
  seen.rgb = scenegraph::toBytes(picture).rgb;
  return seen;
}

void measure(PointsAccuracyRow& row, const Seen& seen, const Seen& reference) {
  std::size_t either = 0;
  std::size_t expected = 0;
  std::size_t wrong = 0;
  std::size_t holes = 0;
  double squares = 0.0;
  for (std::size_t pixel = 0; pixel < reference.is_covered.size(); ++pixel) {
    int most = 0;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      const int apart = static_cast<int>(seen.rgb[i]) - static_cast<int>(reference.rgb[i]);
      most = std::max(most, std::abs(apart));
      squares += apart * apart;
    }
    const bool is_either = seen.is_covered[pixel] || reference.is_covered[pixel];
    either += is_either ? 1 : 0;
    expected += reference.is_covered[pixel] ? 1 : 0;
    wrong += is_either && most > 1 ? 1 : 0;
    holes += reference.is_covered[pixel] && !seen.is_covered[pixel] ? 1 : 0;
  }
  row.wrong = static_cast<double>(wrong) / static_cast<double>(std::max<std::size_t>(either, 1));
  row.holes = static_cast<double>(holes) / static_cast<double>(std::max<std::size_t>(expected, 1));
  row.rmse = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(reference.rgb.size(), 1)));
}

/// Positions as 16 bits over the box of their cloud bring them back.
std::vector<float> quantised(std::span<const float> positions) {
  std::array<float, 3> low;
  std::array<float, 3> high;
  low.fill(std::numeric_limits<float>::infinity());
  high.fill(-std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], positions[i]);
    high[i % 3] = std::max(high[i % 3], positions[i]);
  }
  std::vector<float> result(positions.begin(), positions.end());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const float step = (high[i % 3] - low[i % 3]) / 65535.0F;
    if (step > 0.0F) {
      result[i] = low[i % 3] + std::round((result[i] - low[i % 3]) / step) * step;
    }
  }
  return result;
}

/// The scene, with nothing in it but its points, as every method draws it.
class Subject {
 public:
  Subject(scenegraph::OffscreenRenderer& renderer, osg::Group& root, const scenegraph::CameraView& view)
      : renderer_(renderer), root_(root), view_(view), raster_(0) {
    const glm::dmat4 clip_from_eye = scenegraph::projection(view, static_cast<double>(kWidthPx) / kHeightPx);
    points_ = scenegraph::collectPoints(root, osg::Matrixd(glm::value_ptr(view.eye_from_fixed)),
                                        osg::Matrixd(glm::value_ptr(clip_from_eye)), kHeightPx);
  }
  [[nodiscard]] const PointCollection& points() const { return points_; }

  std::expected<Seen, scenegraph::Status> byOpenGl(double& frame_ms) {
    std::vector<double> times;
    std::expected<scenegraph::Picture, scenegraph::Status> picture;
    for (int i = 0; i < kRepeats; ++i) {
      picture = renderer_.render(root_, view_, kOptions);
      if (!picture) {
        return std::unexpected(picture.error());
      }
      times.push_back(renderer_.lastFrame().frame_ms);
    }
    frame_ms = *std::ranges::min_element(times);
    return seenOf(std::move(*picture));
  }

  Seen byCpu(std::span<const PointBatch> batches, std::uint32_t passes, double& frame_ms) {
    scenegraph::Picture picture;
    picture.width = kWidthPx;
    picture.height = kHeightPx;
    const std::size_t pixels = std::size_t{kWidthPx} * kHeightPx;
    std::vector<std::uint16_t> rgba(4 * pixels);
    std::vector<float> depth(pixels);
    frame_ms = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kRepeats; ++i) {
      const auto start = std::chrono::steady_clock::now();
      raster_.begin(kWidthPx, kHeightPx);
      raster_.draw(batches, {0, passes});
      raster_.resolve(scenegraph::PointShading(batches, points_.colors), rgba, depth);
      frame_ms = std::min(frame_ms, milliseconds(std::chrono::steady_clock::now() - start));
    }
    // Pictures have their top row first, the raster its bottom one.
    for (int row = kHeightPx - 1; row >= 0; --row) {
      for (std::size_t i = 0; i < std::size_t{kWidthPx}; ++i) {
        const std::size_t pixel = static_cast<std::size_t>(row) * kWidthPx + i;
        for (std::size_t c = 0; c < 4; ++c) {
          picture.rgba.push_back(c == 3 ? 1.0F : scenegraph::floatFromHalf(rgba[4 * pixel + c]));
        }
        picture.depth_m.push_back(depth[pixel] > 0.0F ? 1.0F : std::numeric_limits<float>::infinity());
      }
    }
    return seenOf(std::move(picture));
  }

 private:
  static constexpr scenegraph::RenderOptions kOptions{
      .width = kWidthPx, .height = kHeightPx, .background = {0, 0, 0, 1}, .points = scenegraph::PointWay::OpenGl};
  scenegraph::OffscreenRenderer& renderer_;
  osg::Group& root_;
  scenegraph::CameraView view_;
  scenegraph::PointRaster raster_;
  PointCollection points_;
};

/// Lets OpenGL draw a part of the points, or all again.
class PointSubset : public osg::NodeVisitor {
 public:
  explicit PointSubset(std::uint32_t passes) : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), passes_(passes) {}

  void apply(osg::Geometry& geometry) override {
    if (geometry.getNodeMask() != scenegraph::kOpaquePoints || geometry.getNumPrimitiveSets() != 1) {
      return;
    }
    const auto count = static_cast<std::uint32_t>(geometry.getVertexArray()->getNumElements());
    if (passes_ == kPassesOfSample) {
      geometry.setPrimitiveSet(0, new osg::DrawArrays(GL_POINTS, 0, static_cast<GLsizei>(count)));
      return;
    }
    osg::ref_ptr<osg::DrawElementsUInt> chosen = new osg::DrawElementsUInt{GL_POINTS};
    for (std::uint32_t first = 0; first < count; first += kPassesOfSample) {
      for (std::uint32_t pass = 0; pass < passes_; ++pass) {
        const std::uint32_t number = first + scenegraph::placeInGroup(first / kPassesOfSample, pass);
        if (number < count) {
          chosen->push_back(number);
        }
      }
    }
    std::ranges::sort(chosen->asVector());
    geometry.setPrimitiveSet(0, chosen);
  }

 private:
  std::uint32_t passes_;
};

std::string tableOf(const std::vector<PointsAccuracyRow>& rows, const std::string& head) {
  std::string table = head +
                      "\n\n| way | points drawn (%) | frame (ms) | wrong pixels (%) | holes (%) | RMSE (of 255) |\n"
                      "|---|--:|--:|--:|--:|--:|\n";
  for (const PointsAccuracyRow& row : rows) {
    std::array<char, 160> line{};
    std::snprintf(line.data(), line.size(), "| %s | %.2f | %.2f | %.3f | %.3f | %.3f |\n", row.method.c_str(),
                  100.0 * row.share, row.milliseconds, 100.0 * row.wrong, 100.0 * row.holes, row.rmse);
    table += line.data();
  }
  return table;
}

std::string plotOf(const std::vector<PointsAccuracyRow>& rows, const std::string& head) {
  PlotFigure figure;
  figure.title = "Drawing fewer points: error against run time";
  figure.caption = head + " Each curve: 0.1 % to 100 % of the points from left to right. Hollow: no error.";
  figure.x_label = "time of a frame (ms)";
  figure.y_label = "share of pixels, or RMSE of 255";
  for (const auto& [title, value] : std::initializer_list<std::pair<const char*, double PointsAccuracyRow::*>>{
           {"wrong pixels", &PointsAccuracyRow::wrong},
           {"holes", &PointsAccuracyRow::holes},
           {"RMSE", &PointsAccuracyRow::rmse}}) {
    PlotPanel panel{title, {}};
    for (const char* const method : {"CPU", "CPU, 16 bit", "OpenGL"}) {
      PlotSeries series{method, {}};
      for (const PointsAccuracyRow& row : rows) {
        if (row.method == method) {
          series.points.push_back({row.milliseconds, row.*value});
        }
      }
      panel.series.push_back(series);
    }
    figure.panels.push_back(panel);
  }
  return renderSvg(figure);
}

}  // namespace

std::expected<PointsAccuracy, scenegraph::Status> pointsAccuracy(scenegraph::OffscreenRenderer& renderer,
                                                                 osg::Group& root, const scenegraph::CameraView& view,
                                                                 const std::string& what) {
  Subject subject(renderer, root, view);
  double whole_ms = 0.0;
  const auto reference = subject.byOpenGl(whole_ms);
  if (!reference) {
    return std::unexpected(reference.error());
  }
  std::vector<std::vector<float>> rounded;
  std::vector<PointBatch> rounded_batches = subject.points().batches;
  for (PointBatch& batch : rounded_batches) {
    batch.positions = rounded.emplace_back(quantised(batch.positions));
  }
  PointsAccuracy accuracy;
  accuracy.report.name = "points";
  for (const std::uint32_t passes : kPasses) {
    const double share = static_cast<double>(passes) / kPassesOfSample;
    PointsAccuracyRow cpu{.method = "CPU", .share = share};
    measure(cpu, subject.byCpu(subject.points().batches, passes, cpu.milliseconds), *reference);
    PointsAccuracyRow fixed{.method = "CPU, 16 bit", .share = share};
    measure(fixed, subject.byCpu(rounded_batches, passes, fixed.milliseconds), *reference);
    PointsAccuracyRow gl{.method = "OpenGL", .share = share};
    PointSubset subset(passes);
    root.accept(subset);
    const auto seen = subject.byOpenGl(gl.milliseconds);
    if (!seen) {
      return std::unexpected(seen.error());
    }
    measure(gl, *seen, *reference);
    accuracy.rows.insert(accuracy.rows.end(), {cpu, fixed, gl});
  }
  const std::string head = what + ", " + std::to_string(subject.points().count) + " points, " +
                           std::to_string(kWidthPx) + "x" + std::to_string(kHeightPx) + " pixels, OpenGL by " +
                           renderer.context().info().renderer + ".";
  accuracy.report.table = tableOf(accuracy.rows, head);
  accuracy.report.svg = plotOf(accuracy.rows, head);
  return accuracy;
}

}  // namespace stillframe::accuracy
