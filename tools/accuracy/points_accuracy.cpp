#include "tools/accuracy/points_accuracy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <osg/Geometry>
#include <osg/NodeVisitor>

#include "scenegraph/export/picture_io.h"
#include "scenegraph/geometry.h"
#include "scenegraph/pipeline/point_collection.h"
#include "tools/accuracy/svg_plot.h"

namespace stillframe::accuracy {
namespace {

using scenegraph::kPassesOfBothLaps;
using scenegraph::kPassesOfSample;

constexpr int kWidthPx = 1280;
constexpr int kHeightPx = 720;
constexpr int kRepeats = 3;
constexpr std::array<std::uint32_t, 11> kPasses{1, 2, 5, 10, 20, 51, 102, 256, 512, kPassesOfSample, kPassesOfBothLaps};

/// What an error is measured on: bytes as they are shown, and whether a pixel has points.
struct Seen {
  std::vector<std::uint8_t> rgb;
  std::vector<bool> is_covered;
};

Seen seenOf(const scenegraph::Picture& picture) {
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

/// Puts other positions under the points, or their own again; lets OpenGL draw a part of them, or all again.
class PointSubset : public osg::NodeVisitor {
 public:
  PointSubset(std::uint32_t passes, bool is_quantised)
      : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), passes_(passes), is_quantised_(is_quantised) {}
  ~PointSubset() override {
    for (const auto& [geometry, positions] : replaced_) {
      geometry->setVertexArray(positions);
    }
    for (const auto& [geometry, primitives] : cut_) {
      geometry->setPrimitiveSet(0, primitives);
    }
  }
  PointSubset(const PointSubset&) = delete;
  PointSubset& operator=(const PointSubset&) = delete;

  void apply(osg::Geometry& geometry) override {
    if (geometry.getNodeMask() != scenegraph::kOpaquePoints || geometry.getNumPrimitiveSets() != 1) {
      return;
    }
    auto* const positions = dynamic_cast<osg::Vec3Array*>(geometry.getVertexArray());
    if (is_quantised_ && positions != nullptr && !positions->empty()) {
      replaced_.emplace_back(&geometry, positions);
      const std::vector<float> rounded = quantised({positions->front().ptr(), 3 * positions->size()});
      osg::ref_ptr<osg::Vec3Array> other = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
      for (std::size_t i = 0; i < rounded.size(); i += 3) {
        other->push_back({rounded[i], rounded[i + 1], rounded[i + 2]});
      }
      other->setVertexBufferObject(new osg::VertexBufferObject);
      geometry.setVertexArray(other);
    }
    if (passes_ < kPassesOfSample) {
      cut_.emplace_back(&geometry, geometry.getPrimitiveSet(0));
      geometry.setPrimitiveSet(0, part(geometry.getVertexArray()->getNumElements()));
    }
  }

 private:
  [[nodiscard]] osg::ref_ptr<osg::PrimitiveSet> part(std::uint32_t count) const {
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
    return chosen;
  }

  std::uint32_t passes_;
  bool is_quantised_;
  std::vector<std::pair<osg::ref_ptr<osg::Geometry>, osg::ref_ptr<osg::Array>>> replaced_;
  std::vector<std::pair<osg::ref_ptr<osg::Geometry>, osg::ref_ptr<osg::PrimitiveSet>>> cut_;
};

/// A way to draw, as the report names it.
struct Method {
  const char* name;
  scenegraph::PointWay way;
  bool is_quantised;
};
constexpr std::array kMethods{
    Method{"CPU", scenegraph::PointWay::Cpu, false}, Method{"CPU, 16 bit", scenegraph::PointWay::Cpu, true},
    Method{"compute", scenegraph::PointWay::Compute, false}, Method{"OpenGL", scenegraph::PointWay::OpenGl, false}};

/// Whole frames of a scene with nothing in it but its points.
class Subject {
 public:
  Subject(scenegraph::OffscreenRenderer& renderer, osg::Group& root, const scenegraph::CameraView& view)
      : renderer_(renderer), root_(root), view_(view) {}

  /// Puts into `row` how long that takes, and how much was drawn.
  std::expected<Seen, scenegraph::Status> draw(const Method& method, std::uint32_t passes, PointsAccuracyRow& row) {
    const bool is_gl = method.way == scenegraph::PointWay::OpenGl;
    PointSubset subset(is_gl ? passes : kPassesOfBothLaps, method.is_quantised);
    root_.accept(subset);
    const scenegraph::RenderOptions options{.width = kWidthPx,
                                            .height = kHeightPx,
                                            .background = {0, 0, 0, 1},
                                            .points = method.way,
                                            .point_limits = {.passes = passes}};
    std::expected<scenegraph::Picture, scenegraph::Status> picture;
    row.milliseconds = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kRepeats; ++i) {
      // Another view between, or there would be nothing to draw. The first frame uploads and compiles.
      scenegraph::CameraView aside = view_;
      aside.eye_from_fixed[3][0] += 1e-3 * (kRepeats - 1 - i);
      picture = renderer_.render(root_, aside, options);
      if (!picture) {
        return std::unexpected(picture.error());
      }
      row.milliseconds = std::min(row.milliseconds, renderer_.lastFrame().frame_ms);
    }
    const auto& points = renderer_.lastFrame().points;
    row.share = points ? points->share : std::min(1.0, static_cast<double>(passes) / kPassesOfSample);
    return seenOf(*picture);
  }

 private:
  scenegraph::OffscreenRenderer& renderer_;
  osg::Group& root_;
  scenegraph::CameraView view_;
};

std::size_t countPoints(osg::Group& root, const scenegraph::CameraView& view) {
  const glm::dmat4 clip_from_eye = scenegraph::projection(view, static_cast<double>(kWidthPx) / kHeightPx);
  return scenegraph::collectPoints(root, osg::Matrixd(glm::value_ptr(view.eye_from_fixed)),
                                   osg::Matrixd(glm::value_ptr(clip_from_eye)), kHeightPx)
      .count;
}

std::string tableOf(const std::vector<PointsAccuracyRow>& rows, const std::string& head) {
  std::string table = "# Points: error against run time\n\n" + head +
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
    for (const Method& method : kMethods) {
      PlotSeries series{method.name, {}};
      for (const PointsAccuracyRow& row : rows) {
        if (row.method == method.name) {
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
  PointsAccuracyRow whole;
  const auto reference = subject.draw(kMethods.back(), kPassesOfBothLaps, whole);
  if (!reference) {
    return std::unexpected(reference.error());
  }
  PointsAccuracy accuracy;
  accuracy.report.name = "points";
  for (const std::uint32_t passes : kPasses) {
    for (const Method& method : kMethods) {
      PointsAccuracyRow row{.method = method.name};
      const auto seen = subject.draw(method, passes, row);
      if (!seen) {
        return std::unexpected(seen.error());
      }
      if (row.share == 1.0 && passes < kPassesOfBothLaps) {
        continue;  // no second lap: the next is the same
      }
      measure(row, *seen, *reference);
      accuracy.rows.push_back(std::move(row));
    }
  }
  const std::string head = what + ", " + std::to_string(countPoints(root, view)) + " points, " +
                           std::to_string(kWidthPx) + "x" + std::to_string(kHeightPx) + " pixels, OpenGL by " +
                           renderer.context().info().renderer + ", " + dateOfToday() + ".";
  accuracy.report.table = tableOf(accuracy.rows, head);
  accuracy.report.svg = plotOf(accuracy.rows, head);
  return accuracy;
}

}  // namespace stillframe::accuracy
