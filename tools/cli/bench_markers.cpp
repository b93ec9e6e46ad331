#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "nodes/markers/marker_picture.h"
#include "nodes/markers/scene_history.h"
#include "scenegraph/frame_graph.h"
#include "tools/cli/bench_results.h"

namespace stillframe::cli {
namespace {

constexpr int kCubes = 100'000;
constexpr int kChanged = kCubes / 100;

using Scene = std::shared_ptr<const scenegraph::SceneEntities>;

/// Cubes of these ids at random places.
Scene sceneOf(const std::vector<int>& ids, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-50.0, 50.0);
  auto scene = std::make_shared<scenegraph::SceneEntities>();
  for (const int id : ids) {
    scenegraph::SceneEntity entity;
    entity.id = std::to_string(id);
    entity.frame_id = "map";
    entity.is_frame_locked = true;
    entity.cubes.push_back({.pose = {.translation = {place(random), place(random), place(random)}},
                            .size = {0.2, 0.2, 0.2},
                            .color = {1.0F, 0.5F, 0.1F, 1.0F}});
    scene->steps.push_back({false, scene->entities.size()});
    scene->entities.push_back(std::move(entity));
  }
  return scene;
}

}  // namespace

void benchMarkers(std::vector<BenchResult>& results) {
  std::mt19937 random(11);
  std::vector<int> all(kCubes);
  for (int i = 0; i < kCubes; ++i) {
    all[static_cast<std::size_t>(i)] = i;
  }
  std::vector<Scene> messages{sceneOf(all, random)};
  constexpr std::size_t kFew = 20;
  for (std::size_t i = 0; i < kFew; ++i) {
    std::vector<int> some(kChanged);
    for (int& id : some) {
      id = static_cast<int>(random() % kCubes);
    }
    messages.push_back(sceneOf(some, random));
  }
  constexpr std::size_t kWhole = 5;
  messages.insert(messages.end(), kWhole, messages.front());

  scenegraph::FrameGraph frames(std::make_shared<tf::TransformBuffer>());
  nodes::MarkerPicture picture(frames, "/markers");
  nodes::SceneHistory history;
  const auto showFirst = [&](std::size_t count) {
    picture.show(std::make_shared<const nodes::SceneState>(history.at(
                     count, {static_cast<std::int64_t>(count)}, [](std::size_t place) { return place; },
                     [&](std::size_t place) {
                       return nodes::SceneMessage{{static_cast<std::int64_t>(place)}, place, 1000, messages[place]};
                     })),
                 {});
  };
  std::size_t count = 1;
  const double made_s = secondsOf([&] { showFirst(count); });
  const double few_s = bestSecondsOf(kFew, [&] { showFirst(++count); });
  const double whole_s = bestSecondsOf(kWhole, [&] { showFirst(++count); });
  if (picture.counts().entities != kCubes || picture.counts().draw_calls != 1) {
    throw std::logic_error("the benchmark's markers were not drawn");
  }
  results.push_back({"markers, 100 000 cubes made", 1e3 * made_s, "ms"});
  results.push_back({"markers, tick with 1 % of 100 000 changed", 1e3 * few_s, "ms"});
  results.push_back({"markers, tick with 1 % / with all changed", few_s / whole_s, "", 0.1});
}

}  // namespace stillframe::cli
