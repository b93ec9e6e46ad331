#pragma once

#include <glm/vec3.hpp>
#include <limits>

#include "scenegraph/camera/picking.h"

namespace stillframe::scenegraph {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();
inline constexpr PictureSize kSize{1280.0, 720.0};
inline const glm::dvec3 kEcef(4'177'000.25, 855'100.5, 4'728'200.75);

}  // namespace stillframe::scenegraph
