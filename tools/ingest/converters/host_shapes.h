#pragma once

#include "tools/ingest/wire_shape.h"

/// Shapes of the host's own messages (package PJ), whose fields go by number.
namespace stillframe::ingest::converters {

[[nodiscard]] Shape hostVector();        ///< glm::dvec3
[[nodiscard]] Shape hostPlanarVector();  ///< glm::dvec2
[[nodiscard]] Shape hostQuaternion();    ///< glm::dquat
[[nodiscard]] Shape hostPose();          ///< tf::RigidTransform
[[nodiscard]] Shape hostColor();         ///< scenegraph::EntityColor: four doubles on the wire

}  // namespace stillframe::ingest::converters
