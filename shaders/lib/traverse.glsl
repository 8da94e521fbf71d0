// Closest and any hit of a ray with the scene's triangles.
//
// The includer defines `bool hit_filter(uint triangle, vec2 barycentric)`, which may refuse a hit (cut-outs);
// the ray then goes on. All loops of one invocation share 65535 iterations on some drivers: one ray takes a few
// hundred, and no kernel loops over rays without bound.
#ifndef PPM_LIB_TRAVERSE_GLSL
#define PPM_LIB_TRAVERSE_GLSL

#include "lib/scene.glsl"

bool hit_filter(uint triangle, vec2 barycentric);

struct Hit {
  float t;           // distance along the unit direction, working units
  uint triangle;     // slot in leaf order, PPM_NO_TRIANGLE: nothing was hit
  vec2 barycentric;  // weights of the corners 1 and 2
};

// A ray in the units of the boxes' grid. near and far offsets hold the origin, moved outward by more than the
// rounding error of the transformation, so that no box is missed.
struct GridRay {
  vec3 inverse_direction;
  vec3 near_offset, far_offset;
  uvec3 near_shift, far_shift;  // which half of a word holds the plane met first
};

GridRay make_grid_ray(vec3 origin, vec3 direction) {
  vec3 o = (origin - scene.grid_origin) / scene.grid_step;
  vec3 d = direction / scene.grid_step;
  // A component of 0 becomes tiny: its planes are then met far outside any interval.
  d = mix(d, mix(vec3(1e-10), vec3(-1e-10), lessThan(d, vec3(0.0))), lessThan(abs(d), vec3(1e-10)));
  GridRay ray;
  ray.inverse_direction = 1.0 / d;
  float pad = 9.5367431640625e-7 * (65536.0 + max(abs(o.x), max(abs(o.y), abs(o.z))));
  vec3 outward = mix(vec3(pad), vec3(-pad), lessThan(d, vec3(0.0)));
  ray.near_offset = (o + outward) * ray.inverse_direction;
  ray.far_offset = (o - outward) * ray.inverse_direction;
  ray.near_shift = mix(uvec3(0u), uvec3(16u), lessThan(d, vec3(0.0)));
  ray.far_shift = uvec3(16u) - ray.near_shift;
  return ray;
}

// Edge functions about the ray's origin, computed alike (and without contraction) for both triangles of an edge, so
// that their signs agree and no ray passes between; zero counts as inside for both.
// Woop, Benthin, Wald: Watertight Ray/Triangle Intersection (JCGT 2013), in the form of signed volumes.
bool intersect_triangle(TriangleCorners corners, vec3 origin, vec3 direction, float t_max, out float t,
                        out vec2 barycentric) {
  precise vec3 a = corners.corner0 - origin;
  precise vec3 b = corners.corner1 - origin;
  precise vec3 c = corners.corner2 - origin;
  precise vec3 edge0 = c - a;
  precise vec3 edge1 = a - b;
  precise vec3 edge2 = b - c;
  precise vec3 sum0 = c + a;
  precise vec3 sum1 = a + b;
  precise vec3 sum2 = b + c;
  precise vec3 cross0 = sum0.yzx * edge0.zxy - sum0.zxy * edge0.yzx;
  precise vec3 cross1 = sum1.yzx * edge1.zxy - sum1.zxy * edge1.yzx;
  precise vec3 cross2 = sum2.yzx * edge2.zxy - sum2.zxy * edge2.yzx;
  precise float u = cross0.x * direction.x + cross0.y * direction.y + cross0.z * direction.z;
  precise float v = cross1.x * direction.x + cross1.y * direction.y + cross1.z * direction.z;
  precise float w = cross2.x * direction.x + cross2.y * direction.y + cross2.z * direction.z;
  float lowest = min(u, min(v, w));
  float highest = max(u, max(v, w));
  precise vec3 normal = edge0.yzx * edge1.zxy - edge0.zxy * edge1.yzx;
  precise float denominator = normal.x * direction.x + normal.y * direction.y + normal.z * direction.z;
  precise float numerator = normal.x * a.x + normal.y * a.y + normal.z * a.z;
  precise float volume = u + v + w;
  t = numerator / denominator;
  barycentric = vec2(u, v) / volume;
  return (lowest >= 0.0 || highest <= 0.0) && denominator != 0.0 && volume != 0.0 && t > 0.0 && t < t_max;
}

void order_pair(inout float t0, inout uint ref0, inout float t1, inout uint ref1) {
  bool swapped = t1 < t0;
  float t = swapped ? t1 : t0;
  uint ref = swapped ? ref1 : ref0;
  t1 = swapped ? t0 : t1;
  ref1 = swapped ? ref0 : ref1;
  t0 = t;
  ref0 = ref;
}

// The nearest hit closer than t_max, or with `any` the first that is found. `skip` is a triangle not to be hit: the
// one the ray starts on.
Hit traverse(vec3 origin, vec3 direction, float t_max, uint skip, const bool any) {
  const float kMiss = 3e38;
  Hit hit = Hit(t_max, PPM_NO_TRIANGLE, vec2(0.0));
  GridRay ray = make_grid_ray(origin, direction);
  uint stack[PPM_BVH_STACK];
  uint depth = 0u;
  uint ref = 0u;
  while (ref != PPM_BVH_EMPTY) {
    while ((ref & PPM_BVH_LEAF) == 0u) {
      uvec4 box_x = PPM_FETCH(bvh_nodes, 4u * ref);
      uvec4 box_y = PPM_FETCH(bvh_nodes, 4u * ref + 1u);
      uvec4 box_z = PPM_FETCH(bvh_nodes, 4u * ref + 2u);
      uvec4 children = PPM_FETCH(bvh_nodes, 4u * ref + 3u);
      vec4 near_x = vec4((box_x >> ray.near_shift.x) & 0xffffu) * ray.inverse_direction.x - ray.near_offset.x;
      vec4 near_y = vec4((box_y >> ray.near_shift.y) & 0xffffu) * ray.inverse_direction.y - ray.near_offset.y;
      vec4 near_z = vec4((box_z >> ray.near_shift.z) & 0xffffu) * ray.inverse_direction.z - ray.near_offset.z;
      vec4 far_x = vec4((box_x >> ray.far_shift.x) & 0xffffu) * ray.inverse_direction.x - ray.far_offset.x;
      vec4 far_y = vec4((box_y >> ray.far_shift.y) & 0xffffu) * ray.inverse_direction.y - ray.far_offset.y;
      vec4 far_z = vec4((box_z >> ray.far_shift.z) & 0xffffu) * ray.inverse_direction.z - ray.far_offset.z;
      vec4 t_near = max(max(near_x, near_y), max(near_z, vec4(0.0)));
      vec4 t_far = min(min(far_x, far_y), min(far_z, vec4(hit.t)));
      vec4 t = mix(vec4(kMiss), t_near, lessThanEqual(t_near, t_far));

      order_pair(t.x, children.x, t.y, children.y);
      order_pair(t.z, children.z, t.w, children.w);
      order_pair(t.x, children.x, t.z, children.z);
      order_pair(t.y, children.y, t.w, children.w);
      order_pair(t.y, children.y, t.z, children.z);
      if (t.w < kMiss) stack[depth++] = children.w;
      if (t.z < kMiss) stack[depth++] = children.z;
      if (t.y < kMiss) stack[depth++] = children.y;
      if (t.x < kMiss) {
        ref = children.x;
      } else {
        ref = depth > 0u ? stack[--depth] : PPM_BVH_EMPTY;
      }
    }
    if (ref != PPM_BVH_EMPTY) {
      uint slot = ref & 0x1fffffffu;
      uint end = slot + ((ref >> 29u) & 3u) + 1u;
      for (; slot < end; ++slot) {
        float t;
        vec2 barycentric;
        if (slot != skip &&
            intersect_triangle(fetch_triangle(slot), origin, direction, hit.t, t, barycentric) &&
            hit_filter(slot, barycentric)) {
          hit = Hit(t, slot, barycentric);
          if (any) return hit;
        }
      }
      ref = depth > 0u ? stack[--depth] : PPM_BVH_EMPTY;
    }
  }
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
