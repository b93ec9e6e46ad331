#include "scenegraph/pipeline/draw_times.h"

#include <GL/gl.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <osg/Node>
#include <osg/ref_ptr>
#include <utility>

#include "scenegraph/stopwatch.h"

namespace stillframe::scenegraph {
namespace {

constexpr int kRepeats = 3;

/// The nodes of one layer, and what their masks were.
class Switch {
 public:
  explicit Switch(const Layer& layer) {
    std::vector<osg::Node*> nodes;
    if (layer.isVisible()) {
      layer.collectNodes(nodes);
    }
    for (osg::Node* const node : nodes) {
      masks_.emplace_back(node, node->getNodeMask());
    }
  }
  [[nodiscard]] bool isEmpty() const noexcept { return masks_.empty(); }
  void set(bool on) const {
    for (const auto& [node, mask] : masks_) {
      node->setNodeMask(on ? mask : 0U);
    }
  }

 private:
  std::vector<std::pair<osg::ref_ptr<osg::Node>, osg::Node::NodeMask>> masks_;
};

double shortestMs(const std::function<void()>& draw) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRepeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    draw();
    glFinish();
    shortest = std::min(shortest, millisecondsSince(start));
  }
  return shortest;
}

}  // namespace

std::vector<std::optional<double>> measureDrawTimes(const Scene& scene, const std::function<void()>& draw) {
  std::vector<Switch> switches;
  for (const auto& slot : scene.layers()) {
    switches.emplace_back(*slot->layer);
    switches.back().set(false);
  }
  const double without_layers = shortestMs(draw);
  std::vector<std::optional<double>> times;
  for (const Switch& one : switches) {
    if (one.isEmpty()) {
      times.emplace_back();
      continue;
    }
    one.set(true);
    times.emplace_back(std::max(0.0, shortestMs(draw) - without_layers));
    one.set(false);
  }
  for (const Switch& one : switches) {
    one.set(true);
  }
  return times;
}

}  // namespace stillframe::scenegraph
