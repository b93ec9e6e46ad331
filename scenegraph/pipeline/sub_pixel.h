#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

namespace stillframe::scenegraph {

/// Where in a pixel frame `index` of `count` samples it, in pixels from its middle: within a half each way. The points
/// of Hammersley, whose mean is the middle when `count` is a power of two; the last one is the nearest to it.
[[nodiscard]] glm::dvec2 subPixelShift(int index, int count);

/// The projection of a picture whose pixels sample `shift_px` beside their middles.
[[nodiscard]] glm::dmat4 shiftedByPixels(const glm::dmat4& clip_from_eye, const glm::dvec2& shift_px, int width_px,
                                         int height_px);

}  // namespace stillframe::scenegraph
