// Closest and any hit of a ray with the scene's triangles.
//
// The includer defines `bool hit_filter(uint triangle, uint material, vec2 barycentric)`, which may refuse a hit
// (lib/coverage.glsl; `material` as TrianglePositions has it); the ray then goes on. All loops of one invocation share 65535 iterations on some drivers: one ray takes a few
// hundred, and no kernel loops over rays without bound.
#ifndef PPM_LIB_TRAVERSE_GLSL
#define PPM_LIB_TRAVERSE_GLSL

#include "lib/scene.glsl"

bool hit_filter(uint triangle, uint material, vec2 barycentric);

struct Hit {
  float t;           // distance along the unit direction, working units
  uint triangle;     // slot in leaf order, PPM_NO_TRIANGLE: nothing was hit
  vec2 barycentric;  // weights of the corners 1 and 2
};

// A ray in the units of the boxes' grid, for planes read as 1 + q / 65536. near and far offsets hold the origin, moved
// outward by more than the rounding error of the transformation, so that no box is missed: in units of 2^-24 * (65536 +
// |origin|) steps the origin is off by 2, the inverse by 3, the offset by 3, a plane's product by 2 and the difference
// by 1; the pad is 16 of them.
struct GridRay {
  vec3 inverse_direction;  // times 65536
  vec3 near_offset, far_offset;
  bvec3 backward;  // along this axis upper planes are met first
};

GridRay make_grid_ray(vec3 origin, vec3 direction) {
  vec3 o = (origin - scene.grid_origin) / scene.grid_step;
  vec3 d = direction / scene.grid_step;
  // A component of 0 becomes tiny: its planes are then met far outside any interval.
  d = mix(d, mix(vec3(1e-10), vec3(-1e-10), lessThan(d, vec3(0.0))), lessThan(abs(d), vec3(1e-10)));
  GridRay ray;
  ray.backward = lessThan(d, vec3(0.0));
  // An axis at a time: in a flat scene one has far finer planes than the others.
  vec3 pad = 9.5367431640625e-7 * (65536.0 + abs(o));
  vec3 outward = mix(pad, -pad, ray.backward);
  vec3 inverse = 1.0 / d;
  ray.near_offset = (o + 65536.0 + outward) * inverse;
  ray.far_offset = (o + 65536.0 - outward) * inverse;
  ray.inverse_direction = 65536.0 * inverse;
  return ray;
}

// Four planes, two to a word, in [1, 2): their 16 bits become the upper ones of a mantissa, which costs less than a
// conversion.
vec4 read_planes(uvec2 pairs) {
  uvec4 mantissas = uvec4(pairs.x << 7u, pairs.x >> 9u, pairs.y << 7u, pairs.y >> 9u) & 0x007fff80u;
  return uintBitsToFloat(mantissas | 0x3f800000u);
}

// Where the ray meets the four children's near and far planes of one axis. Bits of floats, compared as integers: these
// have the order of the floats where both are positive, and what is behind the origin stays below zero. Integers spare
// the drivers the care that they take over NaNs.
void meet_planes(uvec4 box, bool backward, float inverse, float near_offset, float far_offset, out ivec4 near,
                 out ivec4 far) {
  uvec2 first = backward ? box.zw : box.xy;
  uvec2 last = backward ? box.xy : box.zw;
  near = floatBitsToInt(read_planes(first) * inverse - near_offset);
  far = floatBitsToInt(read_planes(last) * inverse - far_offset);
}

const int kMissKey = 0x7f000000;  // no child that is met has as high a key

// For each child the bits of the distance at which the ray enters its box, the child's number in place of the lowest two.
ivec4 meet_children(uvec4 box_x, uvec4 box_y, uvec4 box_z, uvec4 children, GridRay ray, float t_max) {
  ivec4 near_x, near_y, near_z, far_x, far_y, far_z;
  vec3 inverse = ray.inverse_direction;
  meet_planes(box_x, ray.backward.x, inverse.x, ray.near_offset.x, ray.far_offset.x, near_x, far_x);
  meet_planes(box_y, ray.backward.y, inverse.y, ray.near_offset.y, ray.far_offset.y, near_y, far_y);
  meet_planes(box_z, ray.backward.z, inverse.z, ray.near_offset.z, ray.far_offset.z, near_z, far_z);
  ivec4 near = max(max(near_x, near_y), max(near_z, ivec4(0)));
  // Nothing is met before -1: from so far away that rounding exceeds the grid, the inverted box of a missing child is.
  ivec4 limit = mix(ivec4(floatBitsToInt(t_max)), ivec4(-1), equal(children, uvec4(PPM_BVH_EMPTY)));
  ivec4 far = min(min(far_x, far_y), min(far_z, limit));
  return mix(near & ~3 | ivec4(0, 1, 2, 3), ivec4(kMissKey), greaterThan(near, far));
}

ivec4 ascending(ivec4 k) {
  ivec2 low = min(k.xz, k.yw), high = max(k.xz, k.yw);
  int first = min(low.x, low.y), second = max(low.x, low.y), third = min(high.x, high.y);
  return ivec4(first, min(second, third), max(second, third), max(high.x, high.y));
}

uint child_of(uvec4 children, int key) {
  uvec2 pair = (key & 2) == 0 ? children.xy : children.zw;
  return (key & 1) == 0 ? pair.x : pair.y;
}

// A sheared frame in which the ray starts at the origin and runs along the third axis, t being the third coordinate:
// coordinates of a point are its dot products with the rows.
struct RayFrame {
  vec3 row_x, row_y, row_t;
};

RayFrame make_ray_frame(vec3 direction) {
  vec3 size = abs(direction);
  RayFrame frame;
  if (size.z >= max(size.x, size.y)) {
    frame.row_x = vec3(1.0, 0.0, -direction.x / direction.z);
    frame.row_y = vec3(0.0, 1.0, -direction.y / direction.z);
    frame.row_t = vec3(0.0, 0.0, 1.0 / direction.z);
  } else if (size.y >= size.x) {
    frame.row_x = vec3(0.0, -direction.z / direction.y, 1.0);
    frame.row_y = vec3(1.0, -direction.x / direction.y, 0.0);
    frame.row_t = vec3(0.0, 1.0 / direction.y, 0.0);
  } else {
    frame.row_x = vec3(-direction.y / direction.x, 1.0, 0.0);
    frame.row_y = vec3(-direction.z / direction.x, 0.0, 1.0);
    frame.row_t = vec3(1.0 / direction.x, 0.0, 0.0);
  }
  return frame;
}

vec3 to_ray_frame(RayFrame frame, vec3 origin, vec3 corner) {
  precise vec3 p = corner - origin;
  precise float x = p.x * frame.row_x.x + p.y * frame.row_x.y + p.z * frame.row_x.z;
  precise float y = p.x * frame.row_y.x + p.y * frame.row_y.y + p.z * frame.row_y.z;
  precise float t = p.x * frame.row_t.x + p.y * frame.row_t.y + p.z * frame.row_t.z;
  return vec3(x, y, t);
}

// Watertight: a corner has the same x and y for all its triangles, and with these the sign of each edge function is
// exact or zero, since rounding (without contraction) keeps the order of its two products. So the triangles of a
// closed surface cover the ray as exact ones would; zero counts as inside for both neighbours.
// Woop, Benthin, Wald: Watertight Ray/Triangle Intersection (JCGT 2013). t is a mean of the corners' t, so that even
// a sliver seen edge-on is met where it is.
bool intersect_triangle(TriangleCorners corners, vec3 origin, RayFrame frame, float t_max, out float t,
                        out vec2 barycentric) {
  vec3 a = to_ray_frame(frame, origin, corners.corner0);
  vec3 b = to_ray_frame(frame, origin, corners.corner1);
  vec3 c = to_ray_frame(frame, origin, corners.corner2);
  precise float u = c.x * a.y - c.y * a.x;
  precise float v = a.x * b.y - a.y * b.x;
  precise float w = b.x * c.y - b.y * c.x;
  float lowest = min(u, min(v, w));
  float highest = max(u, max(v, w));
  precise float area = u + v + w;
  precise float weighted = u * b.z + v * c.z + w * a.z;
  t = weighted / area;
  barycentric = vec2(u, v) / area;
  return (lowest >= 0.0 || highest <= 0.0) && area != 0.0 && t > 0.0 && t < t_max;
}

// The nearest hit closer than t_max, or with `any` the first that is found. `skip` is a triangle not to be hit: the
// one the ray starts on.
//
// Lavapipe runs eight rays in lockstep and executes the body of a loop once more for a condition that is tested at its
// top: hence do-while. It stores to an array lane by lane with a branch each for a lane that is masked: hence children
// are always written above the top of the stack, and it is the top that moves only for those that are met.
Hit traverse(vec3 origin, vec3 direction, float t_max, uint skip, const bool any) {
  Hit hit = Hit(t_max, PPM_NO_TRIANGLE, vec2(0.0));
  GridRay ray = make_grid_ray(origin, direction);
  RayFrame frame = make_ray_frame(direction);
  uint stack[PPM_BVH_STACK + 2];  // beside the entries PPM_BVH_EMPTY below them, and what is written above the top
  stack[0] = PPM_BVH_EMPTY;
  uint depth = 1u;
  uint ref = 0u;
  do {
    do {
      if ((ref & PPM_BVH_LEAF) == 0u) {
        uint below = stack[depth - 1u];  // before anything is written, lest a step wait for the stack
        uvec4 box_x = PPM_FETCH_SEGMENTED(bvh_nodes, 4u * ref);
        uvec4 box_y = PPM_FETCH_SEGMENTED(bvh_nodes, 4u * ref + 1u);
        uvec4 box_z = PPM_FETCH_SEGMENTED(bvh_nodes, 4u * ref + 2u);
        uvec4 children = PPM_FETCH_SEGMENTED(bvh_nodes, 4u * ref + 3u);
        ivec4 keys = ascending(meet_children(box_x, box_y, box_z, children, ray, hit.t));
        stack[depth] = child_of(children, keys.w);
        depth += keys.w < kMissKey ? 1u : 0u;
        stack[depth] = child_of(children, keys.z);
        depth += keys.z < kMissKey ? 1u : 0u;
        stack[depth] = child_of(children, keys.y);
        depth += keys.y < kMissKey ? 1u : 0u;
        if (keys.x < kMissKey) {
          ref = child_of(children, keys.x);
        } else {
          ref = below;
          --depth;
        }
      }
    } while ((ref & PPM_BVH_LEAF) == 0u);
    if (ref != PPM_BVH_EMPTY) {
      uint slot = ref & 0x1fffffffu;
      uint last = slot + ((ref >> 29u) & 3u);
      do {  // two at a time: while one waits for memory and its division, so does the other
        uint other = min(slot + 1u, last);
        TriangleCorners corners0 = fetch_triangle(slot), corners1 = fetch_triangle(other);
        float t0, t1;
        vec2 barycentric0, barycentric1;
        bool met0 = intersect_triangle(corners0, origin, frame, hit.t, t0, barycentric0);
        bool met1 = intersect_triangle(corners1, origin, frame, hit.t, t1, barycentric1);
        if (met0 && slot != skip && hit_filter(slot, corners0.material, barycentric0)) {
          hit = Hit(t0, slot, barycentric0);
        }
        if (met1 && t1 < hit.t && other != skip && hit_filter(other, corners1.material, barycentric1)) {
          hit = Hit(t1, other, barycentric1);
        }
        if (any && hit.triangle != PPM_NO_TRIANGLE) return hit;
        slot += 2u;
      } while (slot <= last);
      ref = stack[--depth];
    }
  } while (ref != PPM_BVH_EMPTY);
  return hit;
}

Hit closest_hit(vec3 origin, vec3 direction, uint skip) {
  return traverse(origin, direction, 1e30, skip, false);
}

// Whether anything lies closer than t_max.
bool any_hit(vec3 origin, vec3 direction, float t_max, uint skip) {
  return traverse(origin, direction, t_max, skip, true).triangle != PPM_NO_TRIANGLE;
}

#endif
