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
  // An axis at a time: in a flat scene one has far finer planes than the others.
  vec3 pad = 9.5367431640625e-7 * (65536.0 + abs(o));
  vec3 outward = mix(pad, -pad, lessThan(d, vec3(0.0)));
  ray.near_offset = (o + outward) * ray.inverse_direction;
  ray.far_offset = (o - outward) * ray.inverse_direction;
  ray.near_shift = mix(uvec3(0u), uvec3(16u), lessThan(d, vec3(0.0)));
  ray.far_shift = uvec3(16u) - ray.near_shift;
  return ray;
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
  RayFrame frame = make_ray_frame(direction);
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
      // From so far away that rounding exceeds the grid, the inverted box of a missing child is met too.
      t = mix(t, vec4(kMiss), equal(children, uvec4(PPM_BVH_EMPTY)));

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
            intersect_triangle(fetch_triangle(slot), origin, frame, hit.t, t, barycentric) &&
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
