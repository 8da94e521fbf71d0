// Light sub-paths of bidirectional path tracing: one invocation follows one path for a few bounces.
//
// Reads the scene and PATHS_IN (or starts the tile's light paths); writes LIGHT_VERTICES where the path meets surfaces
// with a non-specular part, each linked to the one before, LIGHT_HEADS with the last of each path that has ended, and
// PATHS_OUT with the paths that go on. Order in all is arbitrary: everything later is added up without regard to it.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"
#include "lib/scene_kinds.glsl"

#include "lib/bidirectional.glsl"

layout(binding = PPM_BIND_PATHS_IN, scalar) readonly buffer PathsIn { SubPath paths_in[]; };
layout(binding = PPM_BIND_PATHS_OUT, scalar) writeonly buffer PathsOut { SubPath paths_out[]; };
layout(binding = PPM_BIND_LIGHT_VERTICES, scalar) writeonly buffer LightVertices { PathVertex light_vertices[]; };
layout(binding = PPM_BIND_LIGHT_HEADS, scalar) writeonly buffer LightHeads { uint light_heads[]; };

const float kNoRange = 1e30;  // longer than any ray

SubPath emit(uint index, out float range) {
  uvec4 words = path_words(PPM_STREAM_LIGHT_PATH, index, kEmissionBlock);
  uvec4 more_words = path_words(PPM_STREAM_LIGHT_PATH, index, kEmissionBlock + 1u);
  vec4 units = units_of(more_words);
  uint chosen = choose_light(words.x, words.y);
  Light light = fetch_light(chosen);
  LightEmission emission = light_emit(light, units, unit_from_word(words.z));
  bool sky = kEnvironment && light.record.kind == PPM_LIGHT_ENVIRONMENT;
  if (sky) {
    vec3 towards_sky;
    EnvironmentSight sight = sample_environment(words.zw, units.zw, towards_sky);
    emission = environment_emit(light, towards_sky, sight, units.xy);
  }
  SubPath path;
  bool has_surface = light.record.kind == PPM_LIGHT_TRIANGLE;
  bool infinite = sky || light.record.kind == PPM_LIGHT_DIRECTIONAL;
  path.origin = has_surface ? offset_origin(emission.position, emission.normal) : emission.position;
  path.direction = emission.direction;
  path.path = index;
  path.state = infinite ? PPM_BDPT_INFINITE : 0u;
  path.throughput = emission.flux / light.record.probability;
  float cosine = has_surface ? dot(emission.direction, emission.normal) : 1.0;
  if (kTexturedLights && has_surface) path.throughput *= light_texture(light.record.triangle, emission.barycentric);
  path.skip = has_surface ? light.record.triangle : PPM_NO_TRIANGLE;
  if (kLayers && has_surface) {
    float coat = light_coat(path.skip, emission.barycentric);
    path.throughput *= clearcoat_transmittance(Clearcoat(coat, 0.0), cosine);
  }
  path.throughput = in_channel_of(index, path.throughput);
  range = light_range(light.record);
  path.media = start_media(light, chosen, emission.normal);
  path.last = PPM_BDPT_NONE;
  path.distance = 0.0;
  PathMis mis = mis_light_start(light.record.probability, emission.pdf_position_area,
                                emission.pdf_direction_solid_angle, cosine, infinite ? 1u : 0u,
                                has_surface || sky ? 1u : 0u);
  path.d_vcm = (kWays & PPM_BDPT_NEXT_EVENT) != 0u ? mis.d_vcm : 0.0;
  path.d_vc = (kWays & PPM_BDPT_EMITTERS) != 0u ? mis.d_vc : 0.0;
  return path;
}

void store(inout SubPath path, Hit hit) {
  uint slot = atomicAdd(counters[PPM_COUNTER_LIGHT_VERTICES], 1u);
  if (slot < push.vertex_capacity) {  // else the host sees the count and traces fewer paths
    light_vertices[slot] = PathVertex(hit.barycentric, hit.triangle, path.path, path.direction, path.state,
                                      path.throughput, path.media, path.d_vcm, path.d_vc, path.last, 0u);
  }
  path.last = slot;
  path.state += 1u << PPM_BDPT_ORDINAL_SHIFT;
}

// Scatters the path at the surface; false: it ends here.
bool scatter(inout SubPath path, Surface surface, MediaInterface sides) {
  uint events = events_of(path.state);
  vec4 u = units_of(path_words(PPM_STREAM_LIGHT_PATH, path.path, kLightScatteringBlock + events));
  vec3 wo = to_local(-path.direction, surface.shading_normal);
  BsdfSample chosen = bsdf_sample(surface.bsdf, wo, u.xyz, PPM_TRANSPORT_FLUX);
  if (chosen.forward_pdf_solid_angle <= 0.0) return false;

  bool transmitted = chosen.transmission != 0u;
  vec3 direction = normalize(to_world(chosen.wi, surface.shading_normal));
  if (chosen.specular != 0u && !transmitted) direction = reflected_direction(surface, path.direction);
  float out_ng = dot(direction, surface.geometric_normal);
  if ((out_ng > 0.0) == transmitted) return false;  // through the surface by way of its interpolated normal
  if (!lit_above(shading_normal_towards(surface, direction), path.direction)) return false;  // as the eye sees it

  float factor = shading_normal_factor(wo.z, dot(path.direction, surface.geometric_normal),
                                       dot(direction, surface.shading_normal), out_ng);
  if (factor > PPM_MAX_NORMAL_FACTOR) {
    factor = PPM_MAX_NORMAL_FACTOR;
    count_event(PPM_COUNTER_CLAMPED);
  }
  vec3 throughput = path.throughput * chosen.weight * factor;
  float survival = path_survival(max_component(throughput) / max_component(path.throughput), events);
  if (!(u.w < survival)) return false;

  PathMis mis = PathMis(path.d_vcm, path.d_vc);
  if (chosen.specular != 0u) {
    float jacobian = transmitted ? specular_jacobian(wo.z, chosen.wi.z, surface.bsdf.eta) : 1.0;
    mis = mis_specular(mis, abs(out_ng), chosen.forward_pdf_solid_angle, chosen.reverse_pdf_solid_angle, jacobian);
  } else {
    // Of light paths d_vcm holds only what counts.
    mis = mis_scatter(mis, abs(out_ng), chosen.forward_pdf_solid_angle, chosen.reverse_pdf_solid_angle, 1.0);
    mis.d_vcm *= kConnectionsCount;
  }
  path.d_vcm = mis.d_vcm;
  path.d_vc = mis.d_vc;
  path.throughput = throughput / survival;
  path.direction = direction;
  path.origin = offset_origin(surface.position, transmitted ? -surface.geometric_normal : surface.geometric_normal);
  path.state = (path.state & ~PPM_BDPT_INFINITE) + 1u;
  path.media = transmitted ? sides.after : sides.before;
  path.distance = 0.0;
  return true;
}

// One segment of a path and what happens at its end; false: the path is over.
// `range`: of the light that the segment starts at, in working units.
bool advance(inout SubPath path, float range) {
  uint events = events_of(path.state);
  set_coverage_key(PPM_STREAM_LIGHT_PATH, path.path, events);
  Hit hit = closest_hit(path.origin, path.direction, path.skip);
  if (hit.triangle == PPM_NO_TRIANGLE) return false;
  path.throughput *= media_transmittance(path.media, hit.t) * range_window(hit.t, range);
  path.distance += hit.t;
  Surface surface = surface_at(hit, path.direction);
  Crossing crossing = cross_media(surface, path.media);
  if (!is_finite3(path.throughput) || !is_finite3(surface.position)) {
    count_event(PPM_COUNTER_NON_FINITE);
    return false;
  }
  if (max_component(path.throughput) <= 0.0) return false;
  path.skip = hit.triangle;
  if (crossing.straight) {
    path.origin = offset_origin(surface.position, -surface.geometric_normal);
    path.media = crossing.sides.after;
    return true;
  }
  show_to_channel(surface, path.throughput);
  float distance = (path.state & PPM_BDPT_INFINITE) != 0u ? 1.0 : path.distance;
  PathMis mis = mis_arrive(PathMis(path.d_vcm, path.d_vc), distance, abs(dot(path.direction, surface.geometric_normal)));
  path.d_vcm = mis.d_vcm;
  path.d_vc = mis.d_vc;
  if (is_non_specular(surface.bsdf)) store(path, hit);
  if (scene.max_depth != 0u && events + 2u > scene.max_depth) return false;  // no vertex further on could count
  if (events >= scene.photon_bounce_cap) {
    count_event(PPM_COUNTER_PATHS_CUT);
    return false;
  }
  return scatter(path, surface, crossing.sides);
}

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  SubPath path;
  float range = kNoRange;
  if (read_at_run_time(push.generate, item) != 0u) {
    path = emit(item, range);
  } else {
    path = paths_in[item];
  }
  bool alive;
  uint bounces = read_at_run_time(push.bounces, item);
  uint bounce = 0u;
  do {
    alive = advance(path, range);
    range = kNoRange;  // all but the first segment
    ++bounce;
  } while (alive && bounce < bounces);
  atomicAdd(counters[PPM_COUNTER_PHOTON_RAYS], bounce);
  if (alive) {
    uint slot = atomicAdd(counters[PPM_COUNTER_PATHS_OUT], 1u);
    if (slot < push.path_capacity) paths_out[slot] = path;
  } else {
    light_heads[path.path] = path.last;
  }
}
