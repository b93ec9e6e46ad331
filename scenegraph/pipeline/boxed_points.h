#pragma once

#include <osg/Array>
#include <vector>

#include "scenegraph/raster/point_blocks.h"

namespace stillframe::scenegraph {

/// Positions that know the boxes of their groups, so that a rasteriser leaves out what is out of the picture. To all
/// others, exported files too, it is the Vec3Array that it says it is.
class BoxedPoints : public osg::Vec3Array {
 public:
  BoxedPoints() : osg::Vec3Array(osg::Array::BIND_PER_VERTEX) {}
  /// Once the positions stand; any thread that has the array to itself.
  void findBoxes() { boxes_ = empty() ? std::vector<PointBox>{} : boxesOf({front().ptr(), 3 * size()}); }
  /// None before findBoxes(), nor when the array has changed its size since.
  [[nodiscard]] std::span<const PointBox> boxes() const noexcept {
    return boxes_.size() == (size() + kPassesOfSample - 1) / kPassesOfSample ? std::span(boxes_)
                                                                             : std::span<const PointBox>{};
  }

 private:
  std::vector<PointBox> boxes_;
};

}  // namespace stillframe::scenegraph
