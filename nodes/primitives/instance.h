#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "scenegraph/settings.h"
#include "tf/rigid_transform.h"

namespace stillframe::nodes {

/// One copy of a mesh, in the layout of the shader's texels.
struct Instance {
  std::array<float, 12> local_from_mesh{};  ///< three rows of four, relative to the origin of the InstancedMesh
  float rgb = 0.0F;                         ///< 0xrrggbb, sRGB
  float alpha = 1.0F;
  float taper = 1.0F;  ///< below 1: radius at z = +0.5; above 1: 2 - radius at z = -0.5; of a frustum's unit radius
  float id = 0.0F;     ///< the caller's, exact below 2^24; not drawn
};
static_assert(sizeof(Instance) == 64);

/// A mesh scaled along its own axes, then placed. Positions beyond 1e18 m of the origin, NaN and infinities give a copy
/// of no extent, which is not seen. Colours are clamped to 0..1; NaN is 0.
[[nodiscard]] Instance makeInstance(const tf::RigidTransform& frame_from_mesh, const glm::dvec3& scale,
                                    const glm::dvec3& origin_in_frame, const scenegraph::Color& color);

}  // namespace stillframe::nodes
