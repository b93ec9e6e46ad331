#pragma once

#include <memory>
#include <string_view>

#include "scenegraph/layer.h"

namespace stillframe::nodes {

/// One topic of Draco or Cloudini clouds (REQUIREMENTS C3): the layer of clouds, fed by a decoder.
///
/// A message is decoded and converted on a worker, once; what cannot be decoded clears the view with the decoder's
/// sentence for a status, and is not tried again.
[[nodiscard]] std::unique_ptr<scenegraph::Layer> createCompressedCloudLayer(std::string_view topic);

}  // namespace stillframe::nodes
