// Camera sub-paths of bidirectional path tracing: one invocation follows one path for a few bounces.
//
// Reads the scene, LIGHT_VERTICES, LIGHT_HEADS and PATHS_IN (or starts the tile's camera paths); writes CAMERA_VERTICES
// where the path meets surfaces with a non-specular part or light, VERTEX_PAIRS with each such vertex and each light
// vertex of the same path that may be connected to it, and PATHS_OUT with the paths that go on. Order is arbitrary.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"
#include "lib/scene_kinds.glsl"

#include "lib/bidirectional.glsl"

layout(binding = PPM_BIND_PATHS_IN, scalar) readonly buffer PathsIn { SubPath paths_in[]; };
layout(binding = PPM_BIND_PATHS_OUT, scalar) writeonly buffer PathsOut { SubPath paths_out[]; };
layout(binding = PPM_BIND_CAMERA_VERTICES, scalar) writeonly buffer CameraVertices { PathVertex camera_vertices[]; };
layout(binding = PPM_BIND_VERTEX_PAIRS, scalar) writeonly buffer VertexPairs { uvec2 vertex_pairs[]; };
PPM_TEXELS(PPM_BIND_LIGHT_VERTICES, light_vertices);
layout(binding = PPM_BIND_LIGHT_HEADS, scalar) readonly buffer LightHeads { uint light_heads[]; };

// Light tracing has no use for camera paths beyond the first surface that is not specular.
const bool kOnlySpecular = (kWays & ~PPM_BDPT_LENS) == 0u;

uint max_depth;  // as in SceneConstants

SubPath start(uint index) {
  uvec2 rest;
  uvec2 pixel = path_pixel(index, path_words(PPM_STREAM_CAMERA_PATH, index, kFilmBlock), rest);
  uint number = 0u;  // of the pixel's samples, which cover it evenly
  if (!kChains) {
    uvec2 own = pass_and_pixel(index);
    number = own.x;
    rest = random_words(RandomStream(scene.seed, PPM_STREAM_CAMERA_PATH, 0u, own.y), kShiftBlock).xy;
  }
  vec2 film = film_sample_in_sequence(read_at_run_time(push.filter_kind, index), pixel.x, pixel.y, number, rest);
  SubPath path;
  path.origin = camera_origin(scene, film);
  path.path = index;
  path.direction = camera_direction(scene, film);
  path.state = PPM_BDPT_SPECULAR;
  path.throughput = in_channel_of(index, vec3(1.0));
  path.skip = PPM_NO_TRIANGLE;
  path.media = camera_media();
  path.last = PPM_BDPT_NONE;
  path.distance = 0.0;
  bool lens = (kWays & PPM_BDPT_LENS) != 0u && read_at_run_time(scene.camera_kind, index) == PPM_CAMERA_PERSPECTIVE;
  PathMis mis = mis_camera_start(push.light_paths, lens ? pixel_solid_angle(scene, path.direction) : 0.0);
  path.d_vcm = mis.d_vcm;
  path.d_vc = mis.d_vc;
  return path;
}

uint store(SubPath path, Hit hit, uint flags, vec3 throughput) {
  uint slot = atomicAdd(counters[PPM_COUNTER_CAMERA_VERTICES], 1u);
  if (slot < push.vertex_capacity) {
    camera_vertices[slot] = PathVertex(hit.barycentric, hit.triangle, path.path, path.direction, path.state | flags,
                                       throughput, path.media, path.d_vcm, path.d_vc, PPM_BDPT_NONE, 0u);
  }
  return slot;
}

// Pairs the vertex with those of its light path that leave it within the depth.
void pair(SubPath path, uint vertex) {
  uint events = events_of(path.state);
  if (max_depth != 0u && events + 2u > max_depth) return;
  uint most = max_depth == 0u ? 0xffffu : max_depth - events - 2u;  // events before the light vertex
  uint light = light_heads[path.path];
  uint ordinal = 0u;
  bool too_deep;
  do {
    if (light >= push.vertex_capacity) return;  // none
    uint state = PPM_FETCH(light_vertices, 4u * light + 1u).w;
    ordinal = state >> PPM_BDPT_ORDINAL_SHIFT;
    too_deep = events_of(state) > most;
    if (too_deep) light = PPM_FETCH(light_vertices, 4u * light + 3u).z;
  } while (too_deep);
  uint slot = atomicAdd(counters[PPM_COUNTER_VERTEX_PAIRS], ordinal + 1u);
  do {
    if (slot < push.pair_capacity) vertex_pairs[slot] = uvec2(vertex, light);
    ++slot;
    light = PPM_FETCH(light_vertices, 4u * light + 3u).z;
  } while (light < push.vertex_capacity);
}

// The weight of light that the path meets at a triangle or, of `missed` ones, of the sky. Those that are no lights by
// themselves (unlit materials) are seen by the eye alone.
float emission_weight(SubPath path, bool missed, uint triangle, bool two_sided, float cosine, float sky_pdf) {
  bool seen = (path.state & PPM_BDPT_SPECULAR) != 0u;
  float direct_pdf, emit_pdf;
  if (missed) {
    direct_pdf = kEnvironment ? environment_probability() * sky_pdf : 0.0;
    emit_pdf = direct_pdf * disc_pdf_area() / square(scene.bounding_radius);
  } else {
    TriangleCorners corners = fetch_triangle(triangle);
    float area = 0.5 * length(cross(corners.corner1 - corners.corner0, corners.corner2 - corners.corner0));
    direct_pdf = light_probability_of(triangle) / area;
    emit_pdf = direct_pdf * cosine_hemisphere_pdf_solid_angle(cosine) * (two_sided ? 0.5 : 1.0);
  }
  if (seen) return 1.0;
  if ((kWays & PPM_BDPT_EMITTERS) == 0u || direct_pdf <= 0.0) return 0.0;
  return mis_emitter(PathMis(path.d_vcm, path.d_vc), direct_pdf, emit_pdf, kNextEventCounts);
}

// Scatters the path at the surface; false: it ends here.
bool scatter(inout SubPath path, Surface surface, MediaInterface sides) {
  uint events = events_of(path.state);
  uint block = kCameraEventBlock + kCameraEventBlocks * events;
  vec4 u = units_of(path_words(PPM_STREAM_CAMERA_PATH, path.path, block));
  vec3 wo = to_local(-path.direction, surface.shading_normal);
  BsdfSample chosen = bsdf_sample(surface.bsdf, wo, u.xyz, PPM_TRANSPORT_RADIANCE);
  if (chosen.forward_pdf_solid_angle <= 0.0) return false;
  bool specular = chosen.specular != 0u;
  if (kOnlySpecular && !specular) return false;

  bool transmitted = chosen.transmission != 0u;
  vec3 direction = normalize(to_world(chosen.wi, surface.shading_normal));
  if (specular && !transmitted) direction = reflected_direction(surface, path.direction);
  float out_ng = dot(direction, surface.geometric_normal);
  if ((out_ng > 0.0) == transmitted) return false;
  // A light path that comes from there sees another normal where this one would be below it, and never goes this way.
  bool reversible = lit_above(shading_normal_towards(surface, direction), path.direction);
  float reverse_pdf = reversible ? chosen.reverse_pdf_solid_angle : 0.0;

  // Roulette sees light as the light path does, which knows of no squared ratio of indices.
  vec3 throughput = path.throughput * chosen.weight;
  vec3 carried = transmitted ? throughput * square(surface.bsdf.eta) : throughput;
  float survival = path_survival(max_component(carried) / max_component(path.throughput), events);
  if (!(u.w < survival)) return false;

  PathMis mis = PathMis(path.d_vcm, path.d_vc);
  if (specular) {
    float jacobian = transmitted ? specular_jacobian(wo.z, chosen.wi.z, surface.bsdf.eta) : 1.0;
    mis = mis_specular(mis, abs(out_ng), chosen.forward_pdf_solid_angle, chosen.reverse_pdf_solid_angle, jacobian);
  } else {
    mis = mis_scatter(mis, abs(out_ng), chosen.forward_pdf_solid_angle, reverse_pdf, camera_connects(path.state));
    path.state &= ~PPM_BDPT_SPECULAR;
  }
  path.d_vcm = mis.d_vcm;
  path.d_vc = mis.d_vc;
  path.throughput = throughput / survival;
  path.direction = direction;
  path.origin = offset_origin(surface.position, transmitted ? -surface.geometric_normal : surface.geometric_normal);
  path.state += 1u;
  path.media = transmitted ? sides.after : sides.before;
  path.distance = 0.0;
  return true;
}

// One segment of a path and what happens at its end; false: the path is over.
bool advance(inout SubPath path) {
  uint events = events_of(path.state);
  set_coverage_key(PPM_STREAM_CAMERA_PATH, path.path, events);
  Hit hit = closest_hit(path.origin, path.direction, path.skip);
  bool missed = hit.triangle == PPM_NO_TRIANGLE;
  if (missed) hit = Hit(0.0, 0u, vec2(0.0));  // any surface
  path.throughput *= media_transmittance(path.media, hit.t);
  path.distance += hit.t;
  Surface surface = surface_at(hit, path.direction);
  Crossing crossing = cross_media(surface, path.media);
  if (!is_finite3(path.throughput) || !is_finite3(surface.position)) {
    count_event(PPM_COUNTER_NON_FINITE);
    return false;
  }
  if (max_component(path.throughput) <= 0.0) return false;
  path.skip = hit.triangle;
  if (crossing.straight && !missed) {
    path.origin = offset_origin(surface.position, -surface.geometric_normal);
    path.media = crossing.sides.after;
    return true;
  }
  show_to_channel(surface, path.throughput);
  float cosine = abs(dot(path.direction, surface.geometric_normal));
  EnvironmentSight sight = EnvironmentSight(vec3(0.0), 0.0);
  if (kEnvironment) sight = environment_towards(path.direction);
  if (!missed) {
    PathMis mis = mis_arrive(PathMis(path.d_vcm, path.d_vc), path.distance, cosine);
    path.d_vcm = mis.d_vcm;
    path.d_vc = mis.d_vc;
  }
  vec3 radiance = missed ? sight.radiance : surface.emission;
  if (max_component(radiance) > 0.0) {
    bool two_sided = (surface.flags & PPM_MATERIAL_DOUBLE_SIDED) != 0u;
    float weight = emission_weight(path, missed, hit.triangle, two_sided, cosine, sight.pdf_solid_angle);
    if (weight > 0.0) store(path, hit, PPM_BDPT_EMISSION, path.throughput * radiance * weight);
  }
  if (missed || (max_depth != 0u && events >= max_depth)) return false;
  if (!kOnlySpecular && is_non_specular(surface.bsdf)) {
    uint vertex = store(path, hit, 0u, path.throughput);
    if ((kWays & PPM_BDPT_CONNECTIONS) != 0u) pair(path, vertex);
  }
  if (events >= scene.photon_bounce_cap) {
    count_event(PPM_COUNTER_PATHS_CUT);
    return false;
  }
  return scatter(path, surface, crossing.sides);
}

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  max_depth = read_at_run_time(scene.max_depth, item);
  SubPath path;
  if (read_at_run_time(push.generate, item) != 0u) {
    path = start(item);
  } else {
    path = paths_in[item];
  }
  bool alive;
  uint bounces = read_at_run_time(push.bounces, item);
  uint bounce = 0u;
  do {
    alive = advance(path);
    ++bounce;
  } while (alive && bounce < bounces);
  atomicAdd(counters[PPM_COUNTER_EYE_RAYS], bounce);
  if (alive) {
    uint slot = atomicAdd(counters[PPM_COUNTER_PATHS_OUT], 1u);
    if (slot < push.path_capacity) paths_out[slot] = path;
  }
}
