// Light tracing to the lens: one invocation connects one of the LIGHT_VERTICES to the camera. What comes through goes to
// the film, or to LENS_SPLATS.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"
#include "lib/scene_kinds.glsl"

#include "lib/bidirectional.glsl"

PPM_TEXELS(PPM_BIND_LIGHT_VERTICES, light_vertices);
layout(binding = PPM_BIND_LENS_SPLATS, scalar) writeonly buffer LensSplats { LensSplat lens_splats[]; };

// Filters reach into the picture from no further away than this, in pixels.
const float kFilterMargin = 1.0;

// The pixel that is given the light which meets the film there, and how much of it: at random among those whose filter
// reaches so far.
struct Splat {
  ivec2 pixel;
  float weight;
};

Splat splat_at(vec2 film, uint path, uint events) {
  uint filter_kind = read_at_run_time(push.filter_kind, path);
  if (filter_kind == PPM_FILTER_BOX) return Splat(ivec2(floor(film)), 1.0);
  vec4 u = units_of(path_words(PPM_STREAM_LIGHT_PATH, path, kSplatBlock + events));
  FilterChoice x = choose_filter(filter_kind, film.x, u.x);
  FilterChoice y = choose_filter(filter_kind, film.y, u.y);
  return Splat(ivec2(x.pixel, y.pixel), x.weight * y.weight);
}

// Light of the vertex that comes through the lens; pixel: where it counts.
vec3 through_lens(uint item, out uint pixel) {
  pixel = 0u;
  Meeting meeting = meeting_at(PPM_FETCH_VERTEX(light_vertices, item));
  PathVertex vertex = meeting.vertex;
  uint events = events_of(vertex.state);

  vec3 to_camera = scene.camera_position - meeting.surface.position;
  float distance2 = dot(to_camera, to_camera);
  vec3 direction = to_camera * inversesqrt(distance2);
  CameraImportance importance = camera_importance_around(scene, -direction, kFilterMargin);
  Splat splat = splat_at(importance.film, vertex.path, events);
  bool on_film = importance.pdf_solid_angle > 0.0 && all(greaterThanEqual(splat.pixel, ivec2(0))) &&
                 all(lessThan(uvec2(splat.pixel), uvec2(scene.width, scene.height)));
  if (!on_film) return vec3(0.0);
  pixel = picture_pixel(uvec2(splat.pixel));
  Lead lead = lead_towards(meeting, direction, true);
  // importance * cosine at the lens = pdf_solid_angle
  vec3 value = lead.value * (importance.pdf_solid_angle * splat.weight / (distance2 * push.light_paths));
  if (!(max_component(value) > 0.0)) return vec3(0.0);
  float pdf_area = importance.pdf_solid_angle * lead.cosine / (distance2 * push.light_paths);
  value /= 1.0 + mis_others(mis_of(vertex), pdf_area, lead.reverse_pdf, 1.0);

  set_coverage_key(PPM_STREAM_CONNECTION, vertex.path, (events << 16u) | 0xffffu);
  return value * visible_share_between(lead.origin, scene.camera_position, vertex.triangle, lead.media) *
         kChannelWeight;
}

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= min(counters[PPM_COUNTER_LIGHT_VERTICES], push.vertex_capacity)) return;
  uint pixel;
  vec3 value = through_lens(item, pixel);
  if (kChains) {
    lens_splats[item] = LensSplat(is_finite3(value) ? value : vec3(0.0), pixel);
  } else if (max_component(value) > 0.0) {
    film_add(pixel, value);
  }
}
