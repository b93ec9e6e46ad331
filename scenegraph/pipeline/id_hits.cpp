#include "scenegraph/pipeline/id_hits.h"

#include <cmath>
#include <osg/Transform>

#include "scenegraph/camera/picking.h"

namespace stillframe::scenegraph {
namespace {

/// Metres along the view axis for a depth, whatever the projection: depth = (zz z + zw) / (wz z + ww), solved for -z.
double metresOf(float depth, const glm::dmat4& clip_from_eye) {
  const auto d = static_cast<double>(depth);
  return (d * clip_from_eye[3][3] - clip_from_eye[3][2]) / (d * clip_from_eye[2][3] - clip_from_eye[2][2]);
}

PickHit toHit(const IdSample& sample, const IdDrawable& drawable, const SightLine& line, double metres) {
  PickHit hit{.path = drawable.path,
              .frame = drawable.path.size() > 2 ? drawable.path[1]->getName() : "",
              .frame_from_local = osg::Matrixd::identity(),
              .instance = sample.instance,
              .primitive = sample.primitive,
              .vertex = sample.vertex,
              .off_px = std::hypot(sample.dx, sample.dy),
              .ray_in_frame = {}};
  // The scene's root, a frame's node, what hangs in that frame.
  osg::Matrixd fixed_from_frame;
  for (std::size_t i = 1; i < hit.path.size(); ++i) {
    if (osg::Transform* const transform = hit.path[i]->asTransform()) {
      transform->computeLocalToWorldMatrix(i == 1 ? fixed_from_frame : hit.frame_from_local, nullptr);
    }
  }
  const osg::Matrixd frame_from_fixed = osg::Matrixd::inverse(fixed_from_frame);
  const auto toFrame = [&](const glm::dvec3& v, double w) {
    const osg::Vec4d in_frame = osg::Vec4d(v.x, v.y, v.z, w) * frame_from_fixed;
    return glm::dvec3(in_frame.x(), in_frame.y(), in_frame.z());
  };
  hit.ray_in_frame = {toFrame(line.origin, 1.0), toFrame(line.direction, 0.0)};
  hit.point_in_frame = hit.ray_in_frame.origin + metres * hit.ray_in_frame.direction;
  return hit;
}

}  // namespace

std::vector<PickHit> toHits(std::span<const IdSample> samples, std::span<const IdDrawable> drawables,
                            const CameraView& view, int width_px, int height_px, int x_px, int y_px) {
  const PictureSize size{static_cast<double>(width_px), static_cast<double>(height_px)};
  const glm::dmat4 clip_from_eye = projection(view, size.width_px / size.height_px);
  std::vector<PickHit> hits;
  const IdSample* last = nullptr;
  for (const IdSample& sample : samples) {
    const auto line = sightLine(view, size, {x_px + sample.dx + 0.5, y_px - sample.dy + 0.5});
    const bool is_same = last != nullptr && last->drawable == sample.drawable && last->instance == sample.instance &&
                         last->primitive == sample.primitive;
    if (line && !is_same) {
      hits.push_back(toHit(sample, drawables[sample.drawable], *line, metresOf(sample.depth, clip_from_eye)));
    }
    last = &sample;
  }
  return hits;
}

}  // namespace stillframe::scenegraph
