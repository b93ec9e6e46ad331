#include "scenegraph/layer_cost.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <vector>

#include "scenegraph/how_many.h"

namespace stillframe::scenegraph {
namespace {

class Counter : public osg::NodeVisitor {
 public:
  explicit Counter(LayerCost& cost) : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), cost_(cost) {
    setNodeMaskOverride(0);  // what is masked off is not drawn
  }
  void apply(osg::Drawable& drawable) override {
    const osg::Geometry* const geometry = drawable.asGeometry();
    if (geometry == nullptr) {  // a text
      ++cost_.draw_calls;
      return;
    }
    for (unsigned i = 0; i < geometry->getNumPrimitiveSets(); ++i) {
      const osg::PrimitiveSet& primitives = *geometry->getPrimitiveSet(i);
      const auto copies = static_cast<std::uint64_t>(std::max(1, primitives.getNumInstances()));
      cost_.vertices += copies * primitives.getNumIndices();
      ++cost_.draw_calls;
    }
  }

 private:
  LayerCost& cost_;
};

std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (auto i = static_cast<std::ptrdiff_t>(text.size()) - 3; i > 0; i -= 3) {
    text.insert(static_cast<std::size_t>(i), ",");
  }
  return text;
}

}  // namespace

LayerCost layerCost(const LayerSlot& slot) {
  LayerCost cost;
  cost.decode_ms = slot.meter->lastMs();
  std::vector<osg::Node*> nodes;
  if (slot.layer->isVisible()) {
    slot.layer->collectNodes(nodes);
  }
  Counter counter(cost);
  for (osg::Node* const node : nodes) {
    node->accept(counter);
  }
  return cost;
}

std::string costText(const LayerCost& cost) {
  std::string text = grouped(cost.vertices) + " " + nounOf(cost.vertices, "vertices") + " in " +
                     grouped(cost.draw_calls) + " " + nounOf(cost.draw_calls, "draw calls");
  const auto add = [&](const char* what, const std::optional<double>& ms) {
    constexpr double kLeastMs = 0.01;
    std::array<char, 32> number{};
    if (ms && *ms < kLeastMs) {
      text += what + std::string("less than 0.01 ms");
    } else if (ms) {
      const bool is_long = *ms >= 999.5;
      std::snprintf(number.data(), number.size(), is_long ? "%.1f" : "%.3g", is_long ? 1e-3 * *ms : *ms);
      text += what + std::string(number.data()) + (is_long ? " s" : " ms");
    }
  };
  add(", decoded in ", cost.decode_ms);
  add(", drawn in ", cost.draw_ms);
  return text;
}

}  // namespace stillframe::scenegraph
