// Connections: one invocation joins one of the VERTEX_PAIRS, a camera vertex and a vertex of the same sample's light
// path.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"
#include "lib/scene_kinds.glsl"

#include "lib/bidirectional.glsl"

PPM_TEXELS(PPM_BIND_CAMERA_VERTICES, camera_vertices);
PPM_TEXELS(PPM_BIND_LIGHT_VERTICES, light_vertices);
layout(binding = PPM_BIND_VERTEX_PAIRS, scalar) readonly buffer VertexPairs { uvec2 vertex_pairs[]; };

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= min(counters[PPM_COUNTER_VERTEX_PAIRS], push.pair_capacity)) return;
  uvec2 ends = vertex_pairs[item];
  Meeting camera = meeting_at(PPM_FETCH_VERTEX(camera_vertices, ends.x));
  Meeting light = meeting_at(PPM_FETCH_VERTEX(light_vertices, ends.y));
  uint path = camera.vertex.path;
  vec3 across = light.surface.position - camera.surface.position;
  float distance2 = dot(across, across);
  if (!(distance2 > 0.0)) return;
  vec3 direction = across * inversesqrt(distance2);
  Lead from_camera = lead_towards(camera, direction, false);
  Lead from_light = lead_towards(light, -direction, true);
  vec3 value = from_camera.value * from_light.value / distance2;
  if (!(max_component(value) > 0.0)) return;

  float light_pdf_area = from_camera.forward_pdf * from_light.cosine / distance2;
  float camera_pdf_area = from_light.forward_pdf * from_camera.cosine / distance2;
  value /= 1.0 + mis_others(mis_of(light.vertex), light_pdf_area, from_light.reverse_pdf, 1.0) +
           mis_others(mis_of(camera.vertex), camera_pdf_area, from_camera.reverse_pdf,
                      camera_connects(camera.vertex.state));

  set_coverage_key(PPM_STREAM_CONNECTION, path,
                   (events_of(light.vertex.state) << 16u) | events_of(camera.vertex.state));
  value *= visible_share_between(from_camera.origin, from_light.origin, camera.vertex.triangle, from_camera.media);
  if (max_component(value) > 0.0) deposit(path, value);
}
