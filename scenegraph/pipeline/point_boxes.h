#pragma once

#include <osg/Array>
#include <osg/Referenced>
#include <osg/ref_ptr>
#include <span>
#include <utility>
#include <vector>

#include "scenegraph/raster/point_blocks.h"

namespace stillframe::scenegraph {

/// The boxes of the groups of an array of positions, so that a rasteriser leaves out what is out of the picture. They
/// hang on the array as user data that no file keeps: a subclass of the array would not be exported at all.
class PointBoxes : public osg::Referenced {
 public:
  explicit PointBoxes(std::vector<PointBox> found) : boxes_(std::move(found)) {}
  [[nodiscard]] std::span<const PointBox> boxes() const noexcept { return boxes_; }

 private:
  std::vector<PointBox> boxes_;
};

/// Once the positions stand: boxesOf() them. Any thread that has the array to itself.
inline void setBoxes(osg::Vec3Array& positions, std::vector<PointBox> boxes) {
  positions.setUserData(new PointBoxes(std::move(boxes)));
}

/// None before setBoxes(), nor when the array has changed its size since.
[[nodiscard]] inline std::span<const PointBox> knownBoxes(const osg::Vec3Array& positions) {
  const auto* const known = dynamic_cast<const PointBoxes*>(positions.getUserData());
  const bool is_whole =
      known != nullptr && known->boxes().size() == (positions.size() + kPassesOfSample - 1) / kPassesOfSample;
  return is_whole ? known->boxes() : std::span<const PointBox>{};
}

}  // namespace stillframe::scenegraph
