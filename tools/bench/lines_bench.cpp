// Lines: a path of 1 000 000 poses, and the same points as GL_LINE_STRIP, which is one pixel wide and has no joints.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <osg/Group>
#include <string>

#include "nodes/line_state.h"
#include "nodes/lines/line_drawable.h"
#include "scenegraph/geometry.h"
#include "scenegraph/pipeline/offscreen_renderer.h"

namespace stillframe::bench {
namespace {

/// A robot that mows a field of 100 m: rows of 1 m, a pose every 10 cm.
glm::dvec3 mower(std::size_t i) {
  constexpr std::size_t kRow = 1000;
  const std::size_t row = i / kRow;
  const auto along = static_cast<double>(i % kRow) * 0.1;
  return {row % 2 == 0 ? along : 100.0 - along, static_cast<double>(row) * 0.1,
          0.02 * std::sin(static_cast<double>(i))};
}

nodes::LineArrays makePath(std::size_t points, double width_px) {
  nodes::LineBuilder builder;
  builder.reserve(points);
  builder.begin(nodes::LineBuilder::Kind::Strip, {.width = width_px});
  for (std::size_t i = 0; i < points; ++i) {
    builder.add(mower(i));
  }
  builder.end();
  return builder.take();
}

void drawRepeatedly(benchmark::State& state, osg::Group& root) {
  const auto renderer = scenegraph::OffscreenRenderer::create();
  if (!renderer) {
    state.SkipWithError(renderer.error().message.c_str());
    return;
  }
  const scenegraph::CameraView view{.eye_from_fixed = scenegraph::lookAt({50, -60, 60}, {50, 50, 0}, {0, 0, 1})};
  const scenegraph::RenderOptions size{.width = 1280, .height = 720};
  (void)(*renderer)->render(root, view, size);
  double least_ms = 1e9;
  for (auto _ : state) {
    (void)(*renderer)->render(root, view, size);
    const double frame_ms = (*renderer)->lastFrame().frame_ms;
    state.SetIterationTime(frame_ms * 1e-3);
    least_ms = std::min(least_ms, frame_ms);
  }
  state.counters["least_ms"] = least_ms;
}

void collect(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(makePath(static_cast<std::size_t>(state.range(0)), 2.0).segments);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void draw(benchmark::State& state) {
  nodes::LineDrawable lines;
  lines.set(makePath(static_cast<std::size_t>(state.range(0)), static_cast<double>(state.range(1))));
  const osg::ref_ptr<osg::Group> root = new osg::Group;
  root->addChild(lines.geometry());
  drawRepeatedly(state, *root);
}

void drawGlLineStrip(benchmark::State& state) {
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.range(0)); ++i) {
    const glm::dvec3 point = mower(i);
    vertices->push_back(osg::Vec3(osg::Vec3d(point.x, point.y, point.z)));
  }
  const nodes::LineState line_state;
  const osg::ref_ptr<osg::Geometry> geometry = scenegraph::makeGeometry();
  geometry->setStateSet(line_state.stateSet());
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_LINE_STRIP, 0, static_cast<GLsizei>(vertices->size())));
  const osg::ref_ptr<osg::Group> root = new osg::Group;
  root->addChild(geometry);
  drawRepeatedly(state, *root);
}

BENCHMARK(collect)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(draw)->Args({1'000'000, 1})->Args({1'000'000, 3})->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(drawGlLineStrip)->Arg(1'000'000)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stillframe::bench

BENCHMARK_MAIN();
