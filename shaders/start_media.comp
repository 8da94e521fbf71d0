// The media in which paths start: one invocation a light, the last one for the camera. Writes LIGHT_MEDIA.
//
// Outside of all solids a path is in no medium. So a ray that comes from outside the scene, straight to the light, and
// enters and leaves solids on its way like any path knows the media when it arrives. It comes from above, because
// what is open (a lake without a bottom) is mostly open below. Of a triangle it is the side of its front, at its
// centre: the media must not change across it.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"
#include "lib/scene_kinds.glsl"

#define PPM_FINDS_START_MEDIA
#include "lib/lights.glsl"
#include "lib/traverse.glsl"
#include "shared/media.h"

layout(push_constant, scalar) uniform PushBlock { StartMediaPush push; };
layout(binding = PPM_BIND_LIGHT_MEDIA, scalar) writeonly buffer LightMedia { uint light_media[]; };

// Surfaces of solids that a ray crosses at most: all loops of an invocation share 65535 iterations on some drivers.
const uint kMostCrossings = 64u;
// In no plane that people model in.
const vec3 kDown = normalize(vec3(0.146447, -0.970541, 0.191342));

uint own_triangle = PPM_NO_TRIANGLE;  // the light's, which is dealt with apart

uint medium_of(uint material) { return fetch_material(material & ~PPM_HAS_COVERAGE).medium; }

bool hit_filter(uint triangle, uint material, vec2 barycentric) {
  return triangle != own_triangle && medium_of(material) != 0u;
}

uint media_at(vec3 point) {
  uint media = PPM_MEDIA_OUTSIDE;
  float away = distance(point, scene.bounding_centre);
  if (away > scene.bounding_radius) return media;
  float left = 2.1 * scene.bounding_radius;
  vec3 origin = point - kDown * left;
  uint skip = PPM_NO_TRIANGLE;
  uint crossings = 0u;
  bool on_the_way;
  do {
    Hit hit = traverse(origin, kDown, left, skip, false);
    on_the_way = hit.triangle != PPM_NO_TRIANGLE;
    if (on_the_way) {
      TriangleCorners corners = fetch_triangle(hit.triangle);
      vec3 normal = normalize(cross(corners.corner1 - corners.corner0, corners.corner2 - corners.corner0));
      bool front = dot(normal, kDown) < 0.0;
      media = media_interface(media, medium_of(corners.material), front).after;
      vec3 weights = vec3(1.0 - hit.barycentric.x - hit.barycentric.y, hit.barycentric);
      vec3 position =
          corners.corner0 * weights.x + corners.corner1 * weights.y + corners.corner2 * weights.z;
      origin = offset_origin(position, front ? -normal : normal);
      left = dot(point - origin, kDown);
      skip = hit.triangle;
    }
    ++crossings;
  } while (on_the_way && left > 0.0 && crossings < kMostCrossings);
  return media;
}

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  vec3 point = scene.camera_position;
  uint medium = 0u;
  bool from_behind = false;
  bool placed = true;
  if (item < scene.light_count) {
    Light light = fetch_light(item);
    placed = light.record.kind == PPM_LIGHT_POINT || light.record.kind == PPM_LIGHT_SPOT;
    point = light.record.position;
    if (light.record.kind == PPM_LIGHT_TRIANGLE) {
      placed = true;
      own_triangle = light.record.triangle;
      medium = light.medium;
      vec3 normal = normalize(triangle_area_normal(light));
      from_behind = dot(normal, kDown) > 0.0;
      point = offset_origin((light.corner0 + light.corner1 + light.corner2) / 3.0, normal);
    }
  }
  uint media = PPM_MEDIA_OUTSIDE;
  if (placed) media = media_at(point);
  if (from_behind && medium != 0u) media = media_interface(media, medium, false).after;
  light_media[item] = media;
}
