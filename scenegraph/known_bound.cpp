#include "scenegraph/known_bound.h"

#include <osg/ref_ptr>

namespace stillframe::scenegraph {
namespace {

struct KnownBound : osg::Drawable::ComputeBoundingBoxCallback {
  explicit KnownBound(const osg::BoundingBox& known) : bound(known) {}
  [[nodiscard]] osg::BoundingBox computeBound(const osg::Drawable& /*of*/) const override { return bound; }
  osg::BoundingBox bound;
};

}  // namespace

void setKnownBound(osg::Geometry& geometry, const osg::BoundingBox& bound) {
  const osg::ref_ptr<KnownBound> known = new KnownBound{bound};
  geometry.dirtyBound();
  geometry.setComputeBoundingBoxCallback(known);
  (void)geometry.getBound();  // keeps it
  geometry.setComputeBoundingBoxCallback(nullptr);
}

}  // namespace stillframe::scenegraph
