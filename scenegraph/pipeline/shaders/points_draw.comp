#version 450
// Points into a picture of depths and numbers, a group of 1024 of them a work group: see scenegraph/raster/point_raster.h,
// whose arithmetic this repeats. Drawn twice: u_step 0 finds the nearest depth of each pixel, u_step 1 the first point
// that has it. In: positions, in the points' own frame, or rays; depths of rays; groups, those that may be seen: number,
// and passes of the first lap.
// Out: nearest, bits of reverse-Z depth; numbers, ~0 where nobody is.
layout(local_size_x = 256) in;
layout(std430, binding = 0) readonly buffer Positions { float positions[]; };
layout(std430, binding = 1) readonly buffer Depths { float depths[]; };
layout(std430, binding = 2) readonly buffer Groups { uvec2 groups[]; };
layout(std430, binding = 3) buffer Nearest { uint nearest[]; };
layout(std430, binding = 4) buffer Numbers { uint numbers[]; };
uniform int u_step;
uniform mat4 u_clip_from_points;
uniform ivec2 u_size_px;
uniform uvec2 u_group_range;   // of groups[]: first and count
uniform uint u_slice_group;    // the group that the bound buffers begin with
uniform uint u_point_count;    // of the whole cloud
uniform uint u_first_number;   // of the whole cloud
uniform uvec2 u_passes;        // of both laps of sample_order.h: first and end
uniform float u_point_size;
uniform bool u_size_in_metres;
uniform bool u_round;
uniform bool u_has_depths;
uniform float u_unit;
uniform float u_farthest;
const uint kGroup = 1024u;
const int kSubpixels = 256;

// placeInGroup() of sample_order.h.
uint placeInGroup(uint group, uint pass) {
  uint seed = group;
  seed = (seed ^ (seed >> 16)) * 0x85ebca6bu;
  seed = (seed ^ (seed >> 13)) * 0xc2b2ae35u;
  seed ^= seed >> 16;
  uint scrambled = pass + seed;
  scrambled ^= scrambled * 0x6c50b47cu;
  scrambled ^= scrambled * 0xb82f1e52u;
  scrambled ^= scrambled * 0xc7afe638u;
  scrambled ^= scrambled * 0x8d22f6e6u;
  return bitfieldReverse(scrambled << 16) >> 6 & 1023u;
}

void store(int pixel, uint depth, uint number) {
  if (u_step == 0) {
    // Whoever was here before is behind now. All who write this write the same.
    if (nearest[pixel] < depth && atomicMax(nearest[pixel], depth) < depth) {
      numbers[pixel] = ~0u;
    }
  } else if (nearest[pixel] == depth) {
    atomicMin(numbers[pixel], number);
  }
}

// Of a disc: pixels whose centres lie within `size` about the centre, in 1/256 of a pixel. First and end.
ivec2 coveredByDisc(int centre, int size, int limit) {
  int low = centre - kSubpixels / 2 - size / 2;
  return ivec2(max((low + kSubpixels - 1) >> 8, 0), min((low + size + kSubpixels - 1) >> 8, limit));
}

// Of a square: moved on to the grid of pixels.
ivec2 coveredBySquare(int centre, int size, int limit) {
  int first = ((centre + (size % 2 == 0 ? kSubpixels / 2 : 0)) >> 8) - size / 2;
  return ivec2(max(first, 0), min(first + size, limit));
}

void drawPoint(vec3 point, uint number) {
  precise vec4 clip = u_clip_from_points[0] * point.x + u_clip_from_points[1] * point.y + u_clip_from_points[2] * point.z +
                      u_clip_from_points[3];
  // Not-a-number fails every comparison.
  if (!(clip.w > 0.0 && abs(clip.x) <= clip.w && abs(clip.y) <= clip.w && clip.z > 0.0 && clip.z <= clip.w)) {
    return;
  }
  precise float per_w = 1.0 / clip.w;
  precise vec2 half_size = 0.5 * vec2(u_size_px) * float(kSubpixels);
  precise vec2 window = clip.xy * per_w * half_size + half_size;
  precise float z = clip.z * per_w;
  ivec2 centre = ivec2(window + 0.5);
  uint depth = floatBitsToUint(z);
  float scale = u_size_in_metres ? min(per_w, 1e6) : 1.0;
  float size = clamp(u_point_size * scale, 1.0, 255.0);
  if (!u_size_in_metres && !(u_point_size > 1.0)) {
    ivec2 at = min(centre >> 8, u_size_px - 1);
    store(at.y * u_size_px.x + at.x, depth, number);
    return;
  }
  if (u_round) {
    int size_256 = int(size * float(kSubpixels) + 0.5);
    ivec2 columns = coveredByDisc(centre.x, size_256, u_size_px.x);
    ivec2 rows = coveredByDisc(centre.y, size_256, u_size_px.y);
    uint reach = uint(size_256) * uint(size_256) / 4u;
    for (int row = rows.x; row < rows.y; ++row) {
      int from_y = row * kSubpixels + kSubpixels / 2 - centre.y;
      for (int column = columns.x; column < columns.y; ++column) {
        int from_x = column * kSubpixels + kSubpixels / 2 - centre.x;
        if (uint(from_x * from_x) + uint(from_y * from_y) <= reach) {
          store(row * u_size_px.x + column, depth, number);
        }
      }
    }
    return;
  }
  int size_px = int(roundEven(size));
  ivec2 columns = coveredBySquare(centre.x, size_px, u_size_px.x);
  ivec2 rows = coveredBySquare(centre.y, size_px, u_size_px.y);
  for (int row = rows.x; row < rows.y; ++row) {
    for (int column = columns.x; column < columns.y; ++column) {
      store(row * u_size_px.x + column, depth, number);
    }
  }
}

void main() {
  uint place = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (place >= u_group_range.y) {
    return;
  }
  uint group = groups[u_group_range.x + place].x;
  uint most = groups[u_group_range.x + place].y;
  bool is_whole = u_passes == uvec2(0u, 2u * kGroup);
  uint end = is_whole ? kGroup : u_passes.y;
  for (uint turn = u_passes.x + gl_LocalInvocationID.x; turn < end; turn += gl_WorkGroupSize.x) {
    uint pass = turn & (kGroup - 1u);
    if (!is_whole && (pass < most) != (turn < kGroup)) {
      continue;
    }
    uint in_group = is_whole ? pass : placeInGroup(group, pass);
    uint number = group * kGroup + in_group;
    if (number >= u_point_count) {
      continue;
    }
    uint at = (group - u_slice_group) * kGroup + in_group;
    vec3 point = vec3(positions[3u * at], positions[3u * at + 1u], positions[3u * at + 2u]);
    if (u_has_depths) {
      float depth = depths[at];
      if (!(depth > 0.0 && depth <= u_farthest && point.z > 0.0)) {
        continue;
      }
      precise vec3 along = point * (depth * u_unit);
      point = along;
    }
    drawPoint(point, u_first_number + number);
  }
}
