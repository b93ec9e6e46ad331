#pragma once

#include <optional>
#include <osg/Matrixd>

#include "scenegraph/pick/ray_target.h"

namespace stillframe::scenegraph {

/// The target that answers for a drawable; nullptr for one that is drawn.
[[nodiscard]] const RayTarget* rayTargetOf(const osg::Node& drawable);

/// Lines of sight through the pixels of a picture, to one target. O(1) to make.
class IdRays {
 public:
  IdRays(const RayTarget& target, const osg::Matrixd& eye_from_local, const osg::Matrixd& clip_from_eye, int width_px,
         int height_px);

  struct Met {
    std::uint32_t instance = 0;
    float depth = 0.0F;  ///< reverse-Z, as the picture has it
  };
  /// Through the middle of a pixel, counted from the bottom left; nullopt where nothing is met before the eye.
  [[nodiscard]] std::optional<Met> at(int x_px, int y_px) const;

 private:
  const RayTarget& target_;
  osg::Matrixd local_from_eye_;
  osg::Matrixd clip_from_eye_;
  int width_px_;
  int height_px_;
};

}  // namespace stillframe::scenegraph
