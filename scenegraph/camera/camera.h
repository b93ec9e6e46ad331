#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace stillframe::scenegraph {

/// What a field of view is held to.
inline constexpr double kMinFovRad = 1e-3;
inline constexpr double kMaxFovRad = std::numbers::pi - 1e-3;

/// Where a picture is taken from: everything the pipeline needs, in double.
struct CameraView {
  glm::dmat4 eye_from_fixed{1.0};  ///< OpenGL eye space: x right, y up, looking along -z
  bool is_orthographic = false;
  double vertical_fov_rad = 0.87266462599716477;  ///< perspective: 50 degrees
  double vertical_extent_m = 10.0;                ///< orthographic: height of the picture
  double near_m = 0.01;                           ///< perspective: nothing nearer is drawn
  double half_depth_m = 1e4;  ///< orthographic: what is drawn before and behind the eye; depth resolves 1.2e-7 of it
};

/// Right-handed look-at, safe when `up` is (nearly) along the line of sight or eye and target coincide.
[[nodiscard]] glm::dmat4 lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up);

/// Reverse-Z with the far plane at infinity, for a [0, 1] clip range: depth 1 at `near_m`, 0 at infinity.
/// `aspect` = width / height; a collapsed or non-finite aspect is taken as 1.
[[nodiscard]] glm::dmat4 reverseZInfinitePerspective(double vertical_fov_rad, double aspect, double near_m);
/// Reverse-Z orthographic over depths -half_depth_m..half_depth_m in front of and behind the eye.
[[nodiscard]] glm::dmat4 reverseZOrthographic(double vertical_extent_m, double aspect, double half_depth_m);
/// The matrix of `view` for a picture of that aspect.
[[nodiscard]] glm::dmat4 projection(const CameraView& view, double aspect);

}  // namespace stillframe::scenegraph
