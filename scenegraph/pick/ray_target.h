#pragma once

#include <cstdint>
#include <optional>
#include <osg/Referenced>

#include "scenegraph/pick/pick_hit.h"

namespace stillframe::scenegraph {

/// What a line of sight meets of a drawable: the user data of a drawable with so many copies that drawing them again
/// for each move of the cursor would take long, while a ray finds its way in a few microseconds.
///
/// The id pass asks it instead of drawing, and holds the answer against the depth of all else. It must say what the
/// picture shows. Not an osg::Object: exported files are without. GUI thread.
class RayTarget : public osg::Referenced {
 public:
  struct Hit {
    std::uint32_t instance = 0;  ///< as gl_InstanceID
    double along = 0.0;          ///< in units of the ray's direction
  };
  /// The nearest thing drawn at `along` >= 0; the ray in the drawable's own coordinates.
  [[nodiscard]] virtual std::optional<Hit> meet(const PickRay& ray) const = 0;
};

}  // namespace stillframe::scenegraph
