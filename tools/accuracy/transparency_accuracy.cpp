#include "tools/accuracy/transparency_accuracy.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <osg/Array>
#include <osg/Geometry>
#include <random>

#include "generated/stillframe_accuracy_post/shaders.h"
#include "scenegraph/blending.h"
#include "scenegraph/geometry.h"
#include "scenegraph/stopwatch.h"
#include "tools/accuracy/svg_plot.h"

namespace stillframe::accuracy {
namespace {

using scenegraph::Picture;
using scenegraph::Status;

constexpr int kColumns = 128;
constexpr int kRows = 72;
constexpr int kAll = 1 << 20;
constexpr std::array kSorted{0, 1, 2, 4, 8, 16, 32, 64, 128};

struct Case {
  int layers;
  float opacity;
};
constexpr std::array kCases{Case{2, 0.5F}, Case{4, 0.5F}, Case{16, 0.3F}, Case{64, 0.1F}, Case{128, 0.04F}};

/// Panes that fill the picture and lean every which way, so that they run through each other.
osg::ref_ptr<osg::Group> makePanes(const Case& wanted) {
  std::mt19937 random(13);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
  osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(osg::Array::BIND_PER_VERTEX);
  for (int i = 0; i < wanted.layers; ++i) {
    const osg::Vec3 middle(0.0F, 0.0F, unit(random));
    const float lean_x = 0.3F * unit(random);
    const float lean_y = 0.3F * unit(random);
    const osg::Vec4 color(0.5F + 0.5F * unit(random), 0.5F + 0.5F * unit(random), 0.5F + 0.5F * unit(random),
                          wanted.opacity);
    for (const auto& [x, y] : {std::pair{-4.0F, -3.0F}, {4.0F, -3.0F}, {4.0F, 3.0F}, {-4.0F, 3.0F}}) {
      vertices->push_back(middle + osg::Vec3(x, y, lean_x * x + lean_y * y));
      normals->push_back({0.0F, 0.0F, 1.0F});
      colors->push_back(color);
    }
  }
  const osg::ref_ptr<osg::Geometry> panes = scenegraph::makeGeometry();
  panes->setVertexArray(vertices);
  panes->setNormalArray(normals);
  panes->setColorArray(colors);
  panes->addPrimitiveSet(new osg::DrawArrays{GL_QUADS, 0, static_cast<GLsizei>(vertices->size())});
  osg::StateSet& state = *panes->getOrCreateStateSet();
  namespace shaders = shaders::stillframe_accuracy_post;
  state.setAttributeAndModes(
      scenegraph::makeProgram("report_surface", shaders::k_surface_vert, shaders::k_surface_frag));
  state.addUniform(new osg::Uniform("u_is_lit", false));
  state.addUniform(new osg::Uniform("u_light", 1.0F));
  scenegraph::setBlended(state, true);
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  scene->addChild(panes);
  return scene;
}

std::expected<Picture, Status> draw(scenegraph::OffscreenRenderer& renderer, osg::Group& scene, int most_sorted) {
  return renderer.render(scene, {.eye_from_fixed = scenegraph::lookAt({0, 0, 4}, {0, 0, 0}, {0, 1, 0})},
                         {.width = kColumns,
                          .height = kRows,
                          .background = {0.12F, 0.13F, 0.15F, 1.0F},
                          .blend = {.most_sorted = most_sorted}});
}

void compare(const Picture& picture, const Picture& reference, TransparencyRow& row) {
  double sum = 0.0;
  for (std::size_t i = 0; i < reference.rgba.size(); ++i) {
    const double error = static_cast<double>(picture.rgba[i]) - static_cast<double>(reference.rgba[i]);
    sum += i % 4 == 3 ? 0.0 : error * error;
    row.max_error = std::max(row.max_error, std::abs(error));
  }
  row.rmse = std::sqrt(sum / (0.75 * static_cast<double>(reference.rgba.size())));
}

std::string titleOf(const Case& one) {
  std::array<char, 60> text{};
  std::snprintf(text.data(), text.size(), "%d layers of opacity %g", one.layers, static_cast<double>(one.opacity));
  return text.data();
}

}  // namespace

std::expected<TransparencyReport, Status> transparencyAccuracy(scenegraph::OffscreenRenderer& renderer,
                                                               double seconds) {
  const double each_s = seconds / static_cast<double>(kCases.size() * kSorted.size());
  const std::string name = renderer.context().info().renderer;
  TransparencyReport result;
  result.report.name = "transparency";
  std::string& table = result.report.table;
  table = "# Transparency: error against run time\n\nOn " + name + ", pictures of " + std::to_string(kColumns) + "x" +
          std::to_string(kRows) +
          ", by `stillframe accuracy transparency`. Panes that run through each other; of each pixel's fragments the "
          "nearest so many are put in order, and those behind count by their mean (0 in order: weighted blending). "
          "Errors are of linear light, white = 1 (a step of a byte is 3.9e-3), against all of them in order. In use: " +
          std::to_string(scenegraph::BlendLimits{}.most_sorted) + ".\n";
  PlotFigure figure{.title = "Transparency: error against run time",
                    .caption = "On " + name + ". Each curve: fragments in order growing from left to right.",
                    .x_label = "time of the frame (ms)",
                    .y_label = "RMSE of linear light, white = 1",
                    .panels = {}};
  for (const Case& one : kCases) {
    const osg::ref_ptr<osg::Group> scene = makePanes(one);
    const auto reference = draw(renderer, *scene, kAll);
    if (!reference) {
      return std::unexpected(reference.error());
    }
    table += "\n### " + titleOf(one) + "\n\n| in order | RMSE | largest error | frame (ms) |\n|--:|--:|--:|--:|\n";
    PlotPanel panel{.title = titleOf(one), .series = {{"fragments in order", {}}}};
    for (const int most_sorted : kSorted) {
      TransparencyRow row{.layers = one.layers,
                          .opacity = static_cast<double>(one.opacity),
                          .most_sorted = most_sorted,
                          .frame_ms = std::numeric_limits<double>::infinity()};
      const auto start = std::chrono::steady_clock::now();
      for (int i = 0; i < 2 || scenegraph::secondsSince(start) < each_s; ++i) {
        const auto picture = draw(renderer, *scene, most_sorted);
        if (!picture) {
          return std::unexpected(picture.error());
        }
        if (i == 0) {
          compare(*picture, *reference, row);
        } else {
          row.frame_ms = std::min(row.frame_ms, renderer.lastFrame().frame_ms);
        }
      }
      std::array<char, 120> line{};
      std::snprintf(line.data(), line.size(), "| %d | %.2e | %.3f | %.2f |\n", most_sorted, row.rmse, row.max_error,
                    row.frame_ms);
      table += line.data();
      panel.series[0].points.push_back({row.frame_ms, row.rmse});
      result.rows.push_back(row);
    }
    figure.panels.push_back(std::move(panel));
  }
  result.report.svg = renderSvg(figure);
  return result;
}

}  // namespace stillframe::accuracy
