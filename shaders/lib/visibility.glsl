// What is left of light between two points: nothing where a surface stops it, else what the media on the way leave.
// Surfaces that light does not notice (lib/media.glsl) are crossed; coverage decides by the coverage_key.
#ifndef PPM_LIB_VISIBILITY_GLSL
#define PPM_LIB_VISIBILITY_GLSL

#include "lib/media.glsl"

// Surfaces that light does not notice, on one segment: all loops of an invocation share 65535 iterations on some
// drivers.
const uint kMostStraightCrossings = 64u;

// `direction` is unit; `distance` in working units; `media` those at the origin.
vec3 visible_share(vec3 origin, vec3 direction, float distance, uint skip, uint media) {
  if (!kMedia) return any_hit(origin, direction, distance, skip) ? vec3(0.0) : vec3(1.0);
  vec3 share = vec3(1.0);
  uint crossings = 0u;
  bool goes_on;
  do {
    Hit hit = traverse(origin, direction, distance, skip, false);
    goes_on = false;
    bool met = hit.triangle != PPM_NO_TRIANGLE;
    share *= media_transmittance(media, met ? hit.t : distance);
    if (met) {
      TriangleCorners corners = fetch_triangle(hit.triangle);
      MaterialRecord material = fetch_material(corners.material & ~PPM_HAS_COVERAGE);
      vec3 normal = normalize(cross(corners.corner1 - corners.corner0, corners.corner2 - corners.corner0));
      bool front = dot(normal, direction) < 0.0;
      MediaInterface sides = media_interface(media, max(material.medium, 1u), front);
      bool noticed = material.medium == 0u || is_real_interface(sides) || (material.flags & PPM_MATERIAL_EMITS) != 0u;
      goes_on = !noticed;
      share = noticed ? vec3(0.0) : share;
      vec3 weights = corner_weights(hit.barycentric);
      vec3 position = corners.corner0 * weights.x + corners.corner1 * weights.y + corners.corner2 * weights.z;
      origin = offset_origin(position, front ? -normal : normal);
      distance -= hit.t;
      skip = hit.triangle;
      media = sides.after;
    }
    ++crossings;
  } while (goes_on && distance > 0.0 && crossings < kMostStraightCrossings);
  return goes_on && distance > 0.0 ? vec3(0.0) : share;
}

// The same up to a point.
vec3 visible_share_between(vec3 from, vec3 to, uint skip, uint media) {
  vec3 across = to - from;
  float distance = length(across);
  return visible_share(from, across / distance, distance, skip, media);
}

#endif
