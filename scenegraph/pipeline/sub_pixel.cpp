#include "scenegraph/pipeline/sub_pixel.h"

#include <glm/geometric.hpp>
#include <utility>

namespace stillframe::scenegraph {
namespace {

/// The bits of `index` behind the binary point, the lowest first.
double radicalInverse(int index) {
  double value = 0.0;
  double digit = 0.5;
  for (auto bits = static_cast<unsigned>(index); bits != 0; bits >>= 1U, digit *= 0.5) {
    value += (bits & 1U) != 0 ? digit : 0.0;
  }
  return value;
}

glm::dvec2 hammersley(int index, int count) {
  return {(index + 0.5) / count - 0.5, radicalInverse(index) + 0.5 / count - 0.5};
}

}  // namespace

glm::dvec2 subPixelShift(int index, int count) {
  int nearest = 0;
  for (int i = 1; i < count; ++i) {
    nearest = glm::length(hammersley(i, count)) < glm::length(hammersley(nearest, count)) ? i : nearest;
  }
  // Depth is read from the last frame: it changes places with the nearest.
  const int last = count - 1;
  return hammersley(index == last ? nearest : index == nearest ? last : index, count);
}

glm::dmat4 shiftedByPixels(const glm::dmat4& clip_from_eye, const glm::dvec2& shift_px, int width_px, int height_px) {
  glm::dmat4 shifted = clip_from_eye;
  for (int column = 0; column < 4; ++column) {
    // Sampling to the right of the middle moves the picture to the left.
    shifted[column][0] -= 2.0 * shift_px.x / width_px * clip_from_eye[column][3];
    shifted[column][1] -= 2.0 * shift_px.y / height_px * clip_from_eye[column][3];
  }
  return shifted;
}

}  // namespace stillframe::scenegraph
