#include <cstdint>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "nodes/registry.h"
#include "scenegraph/executor.h"
#include "scenegraph/objects/scene_entities.h"
#include "scenegraph/scene.h"
#include "tools/bench/memory_messages.h"
#include "tools/cli/bench_results.h"

namespace stillframe::cli {
namespace {

constexpr int kAll = 100'000;
constexpr int kChanged = kAll / 100;
constexpr int kFew = 20;
constexpr int kWhole = 5;

enum class Shape : std::uint8_t { Cube, Sphere, Arrow };

/// Entities of these ids at random places.
scenegraph::AnyObject message(Shape shape, const std::vector<int>& ids, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-50.0, 50.0);
  scenegraph::SceneEntities scene;
  for (const int id : ids) {
    scenegraph::SceneEntity entity;
    entity.id = std::to_string(id);
    entity.frame_id = "map";
    entity.is_frame_locked = true;
    const tf::RigidTransform pose{.translation = {place(random), place(random), place(random)}};
    const scenegraph::EntityColor color{1.0F, 0.5F, 0.1F, 1.0F};
    if (shape == Shape::Cube) {
      entity.cubes.push_back({.pose = pose, .size = {0.2, 0.2, 0.2}, .color = color});
    } else if (shape == Shape::Sphere) {
      entity.spheres.push_back({.pose = pose, .size = {0.2, 0.2, 0.2}, .color = color});
    } else {
      entity.arrows.push_back({.pose = pose,
                               .shaft_length = 0.3,
                               .shaft_diameter = 0.05,
                               .head_length = 0.1,
                               .head_diameter = 0.1,
                               .color = color});
    }
    scene.steps.push_back({false, scene.entities.size()});
    scene.entities.push_back(std::move(entity));
  }
  return scenegraph::AnyObject::make(std::move(scene));
}

/// Whole ticks: all made, then a hundredth of them changed, then all, then any of those hidden.
void add(Shape shape, const std::string& name, std::vector<BenchResult>& results) {
  std::mt19937 random(11);
  std::vector<int> all(kAll);
  for (int i = 0; i < kAll; ++i) {
    all[static_cast<std::size_t>(i)] = i;
  }
  std::vector<scenegraph::AnyObject> messages{message(shape, all, random)};
  for (int i = 0; i < kFew; ++i) {
    std::vector<int> some(kChanged);
    for (int& id : some) {
      id = static_cast<int>(random() % kAll);
    }
    messages.push_back(message(shape, some, random));
  }
  for (int i = 0; i < kWhole; ++i) {
    messages.push_back(message(shape, all, random));
  }
  const auto dataset = std::make_shared<scenegraph::Dataset>("bench");
  bench::addTopic(*dataset, "/markers", scenegraph::ObjectType::SceneEntities, std::move(messages));
  const auto executor = scenegraph::makeSynchronousExecutor();
  scenegraph::Scene scene(dataset, nodes::layerTypes(), *executor);
  scene.setFixedFrame("map");
  const auto slot = scene.addLayer("/markers");
  if (!slot) {
    throw std::logic_error("the benchmark's markers have no layer");
  }
  std::int64_t time = 0;
  const double made_s = secondsOf([&] { scene.update({time}); });
  const double few_s = bestSecondsOf(kFew, [&] { scene.update({++time}); });
  const double whole_s = bestSecondsOf(kWhole, [&] { scene.update({++time}); });
  const scenegraph::LayerCounts expected{{"entities", kAll}, {"primitives", kAll}, {"hidden", 0}, {"draw_calls", 1}};
  if ((*slot)->layer->counts() != expected) {
    throw std::logic_error("the benchmark's markers were not drawn");
  }
  (*slot)->layer->setVisible(false);
  scene.update({++time});
  const double hidden_s = bestSecondsOf(100, [&] { scene.update({--time}); });
  results.push_back({"markers, tick that makes 100 000 " + name, 1e3 * made_s, "ms"});
  results.push_back({"markers, tick with 1 % of 100 000 " + name + " changed", 1e3 * few_s, "ms", 16.6});
  results.push_back({"markers, tick with 1 % / with all " + name + " changed", few_s / whole_s, "", 0.1});
  results.push_back({"markers, tick with 100 000 " + name + " hidden", 1e3 * hidden_s, "ms", 0.1});
}

}  // namespace

void benchMarkers(std::vector<BenchResult>& results) {
  add(Shape::Cube, "cubes", results);
  add(Shape::Sphere, "spheres", results);
  add(Shape::Arrow, "arrows", results);
}

}  // namespace stillframe::cli
