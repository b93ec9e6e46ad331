#include <algorithm>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "nodes/registry.h"
#include "scenegraph/executor.h"
#include "scenegraph/scene.h"
#include "tools/bench/graph_writes.h"
#include "tools/bench/memory_messages.h"
#include "tools/bench/point_scene.h"
#include "tools/cli/bench_results.h"

namespace stillframe::cli {
namespace {

constexpr int kFrames = 1000;
constexpr int kLayers = 200;
constexpr int kViews = 4;
constexpr int kTicks = 200;
constexpr std::int64_t kSpacingNs = 10'000'000;

std::string frameName(int i) { return "frame" + std::to_string(i); }

/// Trees of ten frames about "map"; one frame in ten moves, at every tick.
void addFrames(scenegraph::Dataset& dataset) {
  for (int i = 0; i < kFrames; ++i) {
    const bool is_root = i % 10 == 0;
    const std::string parent = is_root ? "map" : frameName(i - 1);
    for (int tick = 0; tick < (is_root ? kTicks : 1); ++tick) {
      const auto inserted =
          dataset.transforms()->insert({.parent = parent,
                                        .child = frameName(i),
                                        .stamp = {tick * kSpacingNs},
                                        .parent_from_child = {.translation = {0.1 * i, 0.01 * tick, 0.0}}});
      if (!inserted) {
        throw std::logic_error("the benchmark's frames are no tree");
      }
    }
  }
}

/// A small cloud in every fifth frame, one message for all time.
void addClouds(scenegraph::Dataset& dataset) {
  for (int i = 0; i < kLayers; ++i) {
    scenegraph::PointCloud cloud = bench::makePointCloud(1000, false, static_cast<std::uint32_t>(i));
    cloud.frame_id = frameName(5 * i);
    std::vector<scenegraph::AnyObject> messages;
    messages.push_back(scenegraph::AnyObject::make(std::move(cloud)));
    bench::addTopic(dataset, "/points" + std::to_string(i), scenegraph::ObjectType::PointCloud, std::move(messages));
  }
}

/// What all views have been touched by so far.
struct Touched {
  explicit Touched(const std::vector<std::unique_ptr<scenegraph::Scene>>& views) {
    for (const auto& scene : views) {
      const bench::GraphWrites writes(scene->root());
      uniforms += writes.uniforms;
      arrays += writes.arrays;
      ticks += scene->ticks() * scene->layers().size();
    }
  }
  std::uint64_t uniforms = 0;
  std::uint64_t arrays = 0;
  std::uint64_t ticks = 0;
};

}  // namespace

void benchTicks(std::vector<BenchResult>& results) {
  const auto dataset = std::make_shared<scenegraph::Dataset>("bench");
  addFrames(*dataset);
  addClouds(*dataset);
  const auto executor = scenegraph::makeSynchronousExecutor();
  std::vector<std::unique_ptr<scenegraph::Scene>> views;
  for (int i = 0; i < kViews; ++i) {
    auto& scene = views.emplace_back(std::make_unique<scenegraph::Scene>(dataset, nodes::layerTypes(), *executor));
    scene->setFixedFrame("map");
    scene->addDefaultLayers();
    scene->update({0});
    scene->update({kSpacingNs / 2});  // what is set but once is set by now
  }
  std::vector<double> ticks_ms;
  std::vector<double> poses_ms;
  std::size_t written = 0;
  const Touched before(views);
  for (int tick = 1; tick < kTicks; ++tick) {
    const tf::TimePoint time{tick * kSpacingNs};
    // What the frames alone cost comes first; the update after it finds them posed.
    poses_ms.push_back(1e3 * secondsOf([&] {
                         for (const auto& scene : views) {
                           scene->frames().setTick("map", time);
                         }
                       }));
    for (const auto& scene : views) {
      written += scene->frames().lastTick().matrices_written;
    }
    ticks_ms.push_back(poses_ms.back() + 1e3 * secondsOf([&] {
                                           for (const auto& scene : views) {
                                             scene->update(time);
                                           }
                                         }));
  }
  const Touched moved(views);
  std::vector<double> still_ms;
  for (int tick = 0; tick < kTicks; ++tick) {
    still_ms.push_back(1e3 * secondsOf([&] {
                         for (const auto& scene : views) {
                           scene->update({(kTicks - 1) * kSpacingNs});
                         }
                       }));
  }
  const Touched still(views);
  for (std::vector<double>* const times : {&poses_ms, &ticks_ms, &still_ms}) {
    std::ranges::sort(*times);
  }
  const std::string name = "1000 frames, 200 layers, 4 views, ";
  const auto perTick = [](std::uint64_t all) { return static_cast<double>(all) / (kTicks - 1); };
  results.push_back({name + "re-pose of a tick", quantile(poses_ms, 0.5), "ms", 1.0});
  results.push_back({name + "tick", quantile(ticks_ms, 0.5), "ms"});
  results.push_back({name + "tick without any change", quantile(still_ms, 0.5), "ms", 0.1});
  results.push_back({name + "matrices written in a tick", perTick(written), ""});
  results.push_back({name + "uniforms set in a tick", perTick(moved.uniforms - before.uniforms), "", 0.0});
  results.push_back({name + "arrays uploaded in a tick", perTick(moved.arrays - before.arrays), "", 0.0});
  results.push_back(
      {name + "layers updated without any change", static_cast<double>(still.ticks - moved.ticks), "", 0.0});
}

}  // namespace stillframe::cli
