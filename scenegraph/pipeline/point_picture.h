#pragma once

#include <glm/vec4.hpp>
#include <osg/Drawable>
#include <osg/Texture>
#include <osg/ref_ptr>
#include <utility>

#include "scenegraph/pipeline/point_drawer.h"

namespace stillframe::scenegraph {

/// The targets of a scene, cleared to a colour.
struct PointTargets {
  osg::ref_ptr<osg::Texture> color;
  osg::ref_ptr<osg::Texture> depth;
  glm::vec4 background{0.0F};  ///< scene-linear
};

/// Puts the pixels of a drawer into the scene's targets by copying them: on a CPU a sixth of the time of a shader that
/// draws them, and nothing to be made for it. Leaves nothing of what was there, so it is the first thing drawn.
// NOLINTNEXTLINE(cppcoreguidelines-virtual-class-destructor): OSG counts references
class PointPicture : public osg::Drawable {
 public:
  /// `drawer` must outlive this in the graph.
  explicit PointPicture(const PointDrawer& drawer);

  /// Of the next frame.
  void setTargets(PointTargets targets) { targets_ = std::move(targets); }
  void drawImplementation(osg::RenderInfo& info) const override;

 protected:
  ~PointPicture() override = default;

 private:
  const PointDrawer& drawer_;
  PointTargets targets_;
};

}  // namespace stillframe::scenegraph
