#version 450 compatibility
#include "common.glsl"
#include "flat_depth.glsl"
// Lines of the reference grid, behind other lines in its plane and before all else there. In: v_color, as it is written;
// v_plane, normal and distance of the plane in eye space.
const float kPixels = 2.5;  // how far from their middle lines of usual width cover pixels, and some
const vec2 kLeastLineShare = vec2(0.5, 1e-2);
in vec4 v_color;
flat in vec4 v_plane;

// How depth changes over the plane, per pixel: it does so evenly. A line does not tell by its own derivatives.
float planeSlope() {
  bool is_perspective = gl_ProjectionMatrix[2][3] != 0.0;
  vec2 scale = vec2(gl_ProjectionMatrix[0][0], gl_ProjectionMatrix[1][1]);
  vec2 slope = is_perspective ? gl_ProjectionMatrix[3][2] * v_plane.xy / (scale * v_plane.w)
                              : gl_ProjectionMatrix[2][2] * v_plane.xy / (scale * v_plane.z);
  vec2 of_pixel = 2.0 / u_viewport_height_px * vec2(scale.x / scale.y, 1.0);
  // A depth buffer that is reversed takes depth from 0 to 1 as it is, one that is not from -1 to 1.
  slope = abs(slope) * of_pixel * (sfIsDepthReversed() ? 1.0 : 0.5);
  return min(max(slope.x, slope.y), 1.0);
}

void main() {
  gl_FragDepth = sfStepBack(kPixels * planeSlope(), kLeastLineShare, u_depth_step);
  gl_FragColor = v_color;
}
