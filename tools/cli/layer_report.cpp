#include "tools/cli/layer_report.h"

#include <cstdio>

#include "scenegraph/layer_cost.h"
#include "tools/cli/recording_options.h"

namespace stillframe::cli {

Json layersJson(const scenegraph::Scene& scene) {
  Json layers = Json::array();
  for (const auto& slot : scene.layers()) {
    const scenegraph::Layer& layer = *slot->layer;
    const scenegraph::Status& status = layer.status();
    Json counts = Json::object();
    for (const auto& [name, count] : layer.counts()) {
      counts[name] = count;
    }
    Json legend = nullptr;
    if (const auto colors = layer.isVisible() ? layer.legend() : std::nullopt) {
      legend = {{"title", colors->title}, {"unit", colors->unit}, {"low", colors->low}, {"high", colors->high}};
    }
    const scenegraph::LayerCost cost = scenegraph::layerCost(*slot);
    layers.push_back(
        {{"id", slot->id},
         {"title", slot->title},
         {"topic", slot->topic},
         {"type", slot->type->name},
         {"frame", layer.sourceFrame()},
         {"visible", layer.isVisible()},
         {"status",
          {{"level", scenegraph::toString(status.level)}, {"code", status.code}, {"message", status.message}}},
         {"counts", std::move(counts)},
         {"legend", std::move(legend)},
         {"cost",
          {{"vertices", cost.vertices},
           {"draw_calls", cost.draw_calls},
           {"decode_ms", cost.decode_ms ? Json(*cost.decode_ms) : Json(nullptr)}}}});
  }
  return layers;
}

Json problemsJson(std::span<const scenegraph::Problem> problems) {
  Json all = Json::array();
  for (const auto& problem : problems) {
    all.push_back({{"code", problem.code},
                   {"message", problem.message},
                   {"count", problem.count},
                   {"time_ns", problem.time ? Json(problem.time->ns) : Json(nullptr)}});
  }
  return all;
}

void printLines(std::string_view what, std::span<const std::string> lines) {
  for (const std::string& line : lines) {
    std::printf("  %s: %s\n", std::string(what).c_str(), printable(line).c_str());
  }
}

void printRemarks(const scenegraph::Scene& scene, const scenegraph::Dataset& dataset) {
  for (const auto& slot : scene.layers()) {
    const scenegraph::Status& status = slot->layer->status();
    if (status.level != scenegraph::StatusLevel::Ok) {
      std::printf("  %s: %s, %s: %s\n", printable(slot->id).c_str(),
                  std::string(scenegraph::toString(status.level)).c_str(), status.code.c_str(),
                  printable(status.message).c_str());
    }
  }
  const auto isOfData = [](const auto& slot) { return slot->type->consumes != scenegraph::ObjectType::None; };
  if (std::ranges::none_of(scene.layers(), isOfData) && dataset.transforms()->frameCount() == 0) {
    std::puts("  nothing of the recording can be drawn: 'stillframe info' says why, topic by topic");
  }
  for (const auto& problem : dataset.problems()) {
    std::printf("  problem, %s (%llu x): %s\n", problem.code.c_str(), static_cast<unsigned long long>(problem.count),
                printable(problem.message).c_str());
  }
}

}  // namespace stillframe::cli
