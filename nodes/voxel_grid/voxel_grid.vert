#version 450 compatibility
#include "common.glsl"
#include "coloring.glsl"
#include "instances.glsl"
// Voxels of a grid: an instance is a voxel, of which the three sides that may face the eye are drawn, four vertices each.
// gl_Vertex only holds the bound. What is not seen leaves here with all its vertices in one place: voxels that fail the
// test, sides that face away, and sides that touch a voxel which hides them. Uniforms: words of values (voxel_values.h
// says how they lie: kind, shift, offset), R, G, B, A words, and the numbers of the voxels where u_is_listed.
const int kRgb = 1;
const int kValue = 2;
const int kAxis = 3;
const int kFloat = 0;
const int kSigned = 1;
const int kNoField = -1;
const int kAll = 0;
const int kKeys = 1;
const int kBits = 2;
const uint kSignBit = 0x80000000u;

uniform usamplerBuffer u_drawn_by;
uniform usamplerBuffer u_colored_by;
uniform usamplerBuffer u_rgba;
uniform usamplerBuffer u_list;
uniform bool u_is_listed;
uniform ivec3 u_voxels;
uniform vec3 u_cell_size;
uniform ivec3 u_drawn_form;
uniform ivec3 u_colored_form;
uniform ivec4 u_test;  // mode, first key, last key, bits
uniform vec4 u_axis;
uniform bool u_shading;
uniform float u_opacity;
flat out vec4 v_color;

uint rawOf(usamplerBuffer words, ivec3 form, int i) {
  uint word = texelFetch(words, i >> form.y).r;
  if (form.y == 0) {
    return word;
  }
  int width = 32 >> form.y;
  int at = (i & ((1 << form.y) - 1)) * width;
  return form.x == kSigned ? uint(bitfieldExtract(int(word), at, width)) : bitfieldExtract(word, at, width);
}

bool passes(int i) {
  if (u_test.x == kAll || u_drawn_form.x == kNoField) {
    return true;
  }
  uint raw = rawOf(u_drawn_by, u_drawn_form, i);
  if (u_test.x == kKeys) {
    uint key = raw;
    if (u_drawn_form.x == kFloat) {
      key = raw == kSignBit ? kSignBit : (raw & kSignBit) != 0u ? ~raw : raw | kSignBit;
    } else if (u_drawn_form.x == kSigned) {
      key = raw ^ kSignBit;
    }
    return key - uint(u_test.y) <= uint(u_test.z) - uint(u_test.y);
  }
  if (u_test.x != kBits) {
    return false;
  }
  if (u_drawn_form.x == kFloat) {
    float value = uintBitsToFloat(raw);
    if (!(abs(value) < 2147483520.0)) {
      return false;
    }
    raw = uint(int(floor(value + 0.5)) + u_drawn_form.z);
  }
  return (raw & uint(u_test.w)) != 0u;
}

uint alphaOf(int i) { return u_color_mode == kRgb ? texelFetch(u_rgba, i).r >> 24 : 255u; }

vec4 colorOf(int i, vec3 centre) {
  if (u_color_mode == kRgb) {
    return unpackUnorm4x8(texelFetch(u_rgba, i).r);
  }
  vec3 color = u_flat_color;
  if (u_color_mode == kValue) {
    uint raw = rawOf(u_colored_by, u_colored_form, i);
    color = sfValueColor(u_colored_form.x == kFloat ? uintBitsToFloat(raw) : float(int(raw - uint(u_colored_form.z))));
  } else if (u_color_mode == kAxis) {
    color = sfMapped(dot(u_axis.xyz, centre) + u_axis.w);
  }
  return vec4(color, 1.0);
}

void main() {
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  v_color = vec4(0.0);
  int i = u_is_listed ? int(texelFetch(u_list, sfInstance()).r) : sfInstance();
  uint alpha = alphaOf(i);
  if (alpha == 0u || !passes(i)) {
    return;
  }
  ivec3 cell = ivec3(i % u_voxels.x, i / u_voxels.x % u_voxels.y, i / (u_voxels.x * u_voxels.y));
  vec3 centre = (vec3(cell) + 0.5) * u_cell_size;
  vec3 centre_in_eye = vec3(gl_ModelViewMatrix * vec4(centre, 1.0));
  bool is_orthographic = gl_ProjectionMatrix[3][3] == 1.0;

  // Of the two sides across an axis the one that faces the eye, or none when the eye lies between their planes.
  int axis = gl_VertexID >> 2;
  vec3 normal_in_eye = gl_ModelViewMatrix[axis].xyz;
  float towards = dot(normal_in_eye, is_orthographic ? vec3(0.0, 0.0, 1.0) : -centre_in_eye);
  if (abs(towards) <= (is_orthographic ? 0.0 : 0.5 * u_cell_size[axis] * dot(normal_in_eye, normal_in_eye))) {
    return;
  }
  int side = towards > 0.0 ? 1 : 0;
  ivec3 beyond = cell;
  beyond[axis] += 2 * side - 1;
  if (all(greaterThanEqual(beyond, ivec3(0))) && all(lessThan(beyond, u_voxels))) {
    int neighbour = (beyond.z * u_voxels.y + beyond.y) * u_voxels.x + beyond.x;
    if (passes(neighbour) && alphaOf(neighbour) >= alpha) {
      return;
    }
  }
  ivec3 corner = cell;
  corner[axis] += side;
  corner[(axis + 1) % 3] += gl_VertexID & 1;
  corner[(axis + 2) % 3] += gl_VertexID >> 1 & 1;
  gl_Position = gl_ModelViewProjectionMatrix * vec4(vec3(corner) * u_cell_size, 1.0);

  vec4 color = colorOf(i, centre);
  if (u_shading) {
    color.rgb *= sfLight(side == 1 ? normal_in_eye : -normal_in_eye, centre_in_eye, false);
  }
  color.a *= u_opacity;
  v_color = sfOutput(color);
}
