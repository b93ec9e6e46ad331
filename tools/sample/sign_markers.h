#pragma once

#include <vector>

#include "tools/sample/marker_messages.h"

namespace stillframe::sample {

/// What stands about for good: a board on the wall above the ramp, triangles with a texture in the message, and two
/// cones before it, meshes in the message. In the frame "map"; the caller adds the stamp.
[[nodiscard]] std::vector<Marker> makeSigns();

}  // namespace stillframe::sample
