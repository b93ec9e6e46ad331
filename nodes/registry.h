#pragma once

#include <span>

#include "scenegraph/layer.h"

namespace stillframe::nodes {

/// Every kind of layer there is, one line each in registry.cpp. Built-ins first, in the order views add them.
[[nodiscard]] std::span<const scenegraph::LayerType> layerTypes();

}  // namespace stillframe::nodes
