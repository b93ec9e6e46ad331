#include "scenegraph/pipeline/draw_times.h"

#include <GL/gl.h>

#include <algorithm>
#include <chrono>
#include <osg/Node>
#include <osg/ref_ptr>
#include <utility>

#include "scenegraph/stopwatch.h"

namespace stillframe::scenegraph {
namespace {

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

}  // namespace

DrawTimes::DrawTimes(const Scene& scene)
    : scene_(scene), revision_(scene.settingsRevision()), shortest_ms_(scene.layers().size()) {}

bool DrawTimes::isValid() const {
  return scene_.layers().size() == shortest_ms_.size() && scene_.settingsRevision() == revision_;
}

void DrawTimes::step(const std::function<void()>& draw) {
  if (isDone() || !isValid()) {
    return;
  }
  std::vector<Switch> switches;
  for (const auto& slot : scene_.layers()) {
    switches.emplace_back(*slot->layer);
    switches.back().set(false);
  }
  const std::size_t turn = frames_ / kRepeats;  // 0: none of them
  const bool is_first = frames_ % kRepeats == 0;
  const bool shows_nothing = turn > 0 && switches[turn - 1].isEmpty();
  if (shows_nothing) {
    frames_ += kRepeats;
  } else {
    if (turn > 0) {
      switches[turn - 1].set(true);
    }
    const auto start = std::chrono::steady_clock::now();
    draw();
    glFinish();
    const double ms = millisecondsSince(start);
    if (turn == 0) {
      without_layers_ms_ = is_first ? ms : std::min(ms, without_layers_ms_);
    } else {
      std::optional<double>& shortest = shortest_ms_[turn - 1];
      const double own_ms = std::max(0.0, ms - without_layers_ms_);
      shortest = is_first ? own_ms : std::min(own_ms, shortest.value_or(own_ms));
    }
    ++frames_;
  }
  for (const Switch& one : switches) {
    one.set(true);
  }
}

}  // namespace stillframe::scenegraph
