#include <cmath>
#include <memory>
#include <stdexcept>

#include "nodes/registry.h"
#include "scenegraph/executor.h"
#include "scenegraph/objects/poses.h"
#include "scenegraph/scene.h"
#include "tools/bench/memory_messages.h"
#include "tools/cli/bench_results.h"

namespace stillframe::cli {
namespace {

using scenegraph::AnyObject;
using scenegraph::PosesInFrame;

/// Poses along a helix, a millisecond apart.
AnyObject makePoses(scenegraph::PosesKind kind, std::size_t count, double phase) {
  PosesInFrame poses;
  poses.kind = kind;
  poses.frame_id = "map";
  poses.poses.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = phase + 0.001 * static_cast<double>(i);
    poses.poses.push_back({{std::cos(angle / 2), 0.0, 0.0, std::sin(angle / 2)},
                           {20.0 * std::cos(angle), 20.0 * std::sin(angle), 1e-4 * static_cast<double>(i)}});
    poses.stamps.push_back({static_cast<std::int64_t>(i) * 1'000'000});
  }
  return AnyObject::make(std::move(poses));
}

/// Times of ticks that each come to a message not seen before.
double tickMs(scenegraph::PosesKind kind, std::size_t poses, std::size_t messages,
              const scenegraph::SettingTexts& settings) {
  std::vector<AnyObject> all;
  for (std::size_t i = 0; i < messages; ++i) {
    all.push_back(makePoses(kind, poses, static_cast<double>(i)));
  }
  const auto dataset = std::make_shared<scenegraph::Dataset>("bench");
  bench::addTopic(*dataset, "/poses", scenegraph::ObjectType::PosesInFrame, std::move(all));
  const auto executor = scenegraph::makeSynchronousExecutor();
  scenegraph::Scene scene(dataset, nodes::layerTypes(), *executor);
  scene.setFixedFrame("map");
  const auto slot = scene.addLayer("/poses");
  if (!slot || !(*slot)->layer->applySettings(settings)) {
    throw std::logic_error("the benchmark's poses have no layer");
  }
  std::vector<double> ticks_ms;
  for (std::size_t i = 0; i < messages; ++i) {
    ticks_ms.push_back(1e3 * secondsOf([&] { scene.update({static_cast<std::int64_t>(i)}); }));
  }
  std::ranges::sort(ticks_ms);
  return quantile(ticks_ms, 0.5);
}

}  // namespace

void benchPoses(std::vector<BenchResult>& results) {
  using scenegraph::PosesKind;
  results.push_back({"tick with 10 000 new poses, triads", tickMs(PosesKind::Array, 10'000, 40, {}), "ms", 16.6});
  results.push_back(
      {"tick with 10 000 new poses, arrows", tickMs(PosesKind::Array, 10'000, 40, {{"shape", "arrows"}}), "ms"});
  results.push_back({"tick with a new path of 1 000 000 poses",
                     tickMs(PosesKind::Path, 1'000'000, 3, {{"color_field", "time"}}), "ms"});
}

}  // namespace stillframe::cli
