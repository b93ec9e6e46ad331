#pragma once

#include <expected>
#include <string_view>

#include "nodes/robots/robot.h"
#include "scenegraph/status.h"

namespace stillframe::nodes {

/// Reads a URDF through urdfdom, after scanUrdf() has found it fit. What urdfdom says on the console becomes the status
/// "UrdfMalformed" instead. Sizes that are not positive and finite leave their shape out and are remarked on; axes are
/// normalised. Any thread; one at a time, because urdfdom's console is global.
[[nodiscard]] std::expected<Robot, scenegraph::Status> readUrdf(std::string_view text);

}  // namespace stillframe::nodes
