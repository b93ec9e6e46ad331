#pragma once

#include <glm/vec3.hpp>
#include <string>

namespace stillframe::viewer {

/// What the user has picked out, to be framed by F: a ball round a point of a frame.
struct Selection {
  std::string frame;
  glm::dvec3 point_in_frame{0.0, 0.0, 0.0};
  double radius_m = 1.0;
};

}  // namespace stillframe::viewer
