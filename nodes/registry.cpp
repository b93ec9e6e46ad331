#include "nodes/registry.h"

#include <vector>

namespace stillframe::nodes {

std::span<const scenegraph::LayerType> layerTypes() {
  static const std::vector<scenegraph::LayerType> kTypes{};
  return kTypes;
}

}  // namespace stillframe::nodes
