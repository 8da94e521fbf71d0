// Ray tracing pass [HOJ08 section 3.1]: one invocation follows one eye path for one segment.
//
// Reads the scene and EYE_IN (or starts the eye paths of a tile's pixels); stages a hit point where the path meets a
// surface with a non-specular part, and a record of light seen where it meets an emitter; writes EYE_OUT with the
// paths that specular reflection and transmission, both at glass, make of it. The order of all three is
// arbitrary; keys that follow from the path alone put hit points into canonical order afterwards.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#include "lib/counters.glsl"
#include "lib/lights.glsl"
#include "lib/surface.glsl"
#include "shared/camera.h"

layout(push_constant, scalar) uniform PushBlock { EyePush push; };
layout(binding = PPM_BIND_EYE_IN, scalar) readonly buffer EyeIn { EyePath eye_in[]; };
layout(binding = PPM_BIND_EYE_OUT, scalar) writeonly buffer EyeOut { EyePath eye_out[]; };
layout(binding = PPM_BIND_STAGED_HITS, scalar) writeonly buffer StagedHits { HitPoint staged_hits[]; };
layout(binding = PPM_BIND_STAGED_KEYS, scalar) writeonly buffer StagedKeys { StagedKey staged_keys[]; };

bool hit_filter(uint triangle, vec2 barycentric) { return true; }

const float kLeastFootprint = 1e-15;
const uint kMaxSplits = 32u;  // bits of EyePath::code; later splits take one branch at random

// Random blocks of an eye path: 0 places it on the film, 1 + n is its n-th specular event.
RandomStream random_of(uint pixel, uint sample_index) {
  return RandomStream(scene.seed, PPM_STREAM_EYE, push.pass,
                      (push.tile_first + pixel) * push.samples + sample_index);
}

EyePath start(uint item) {
  EyePath path;
  path.pixel = item / push.samples;
  path.sample_index = item % push.samples;
  uvec2 position = pixel_position(push.tile_first + path.pixel, scene.width, scene.height);
  vec4 u = random_units(random_of(path.pixel, path.sample_index), 0u);
  // One shift for all samples of the pixel.
  u.z = random_units(random_of(path.pixel, 0u), 0u).w;
  vec2 film = film_sample(push.filter_kind, position.x, position.y, path.sample_index, push.samples, u.xyz);
  path.origin = scene.camera_position;
  path.direction = camera_direction(scene, film);
  path.state = 0u;
  path.weight = vec3(1.0);
  path.skip = PPM_NO_TRIANGLE;
  path.code = 0u;
  path.splits = 0u;
  path.distance = 0.0;
  return path;
}

void stage(EyePath path, HitPoint hit, float footprint) {
  if (!is_finite3(hit.weight) || !is_finite3(hit.position)) {
    count_event(PPM_COUNTER_NON_FINITE);
    return;
  }
  uint slot = atomicAdd(counters[PPM_COUNTER_HITS], 1u);
  if (slot >= push.hit_capacity) return;  // the host sees the count and takes a smaller tile
  uint events = path.state & 0xffffu;
  bool light = (hit.flags & PPM_HIT_EMISSION) != 0u;
  staged_hits[slot] = hit;
  staged_keys[slot] = StagedKey(path.pixel * push.samples + path.sample_index, 2u * events + (light ? 1u : 0u),
                                path.code, footprint);
}

void stage_light(EyePath path, vec3 position, vec3 radiance) {
  if (max_component(radiance) <= 0.0) return;
  HitPoint hit = HitPoint(position, 0u, 0u, 0u, 0u, PPM_HIT_EMISSION,
                          path.weight * radiance / float(push.samples), 0u, uvec4(0u));
  stage(path, hit, 0.0);
}

void stage_hit_point(EyePath path, Surface surface) {
  uint events = path.state & 0xffffu;
  HitPoint hit;
  hit.position = surface.position;
  hit.geometric_normal = pack_direction(surface.geometric_normal);
  hit.shading_normal = pack_direction(surface.shading_normal);
  hit.outgoing = pack_direction(-path.direction);
  hit.statistics = 0u;
  hit.flags = min(events, 255u) << 8u;
  hit.weight = path.weight / float(push.samples);
  pack_bsdf(surface.bsdf, hit.bsdf, hit.bsdf_extra);
  float cosine = dot(path.direction, surface.geometric_normal);
  // Never 0, which would mark it as light seen: pixels may be smaller than single precision can square.
  uvec2 pixel = pixel_position(push.tile_first + path.pixel, scene.width, scene.height);
  float solid_angle = pixel_solid_angle(scene, camera_direction(scene, vec2(pixel) + 0.5));
  stage(path, hit, max(footprint_radius(solid_angle, path.distance, cosine), kLeastFootprint));
}

// Passes a branch on. Branches that weigh little survive in proportion to their weight (Russian roulette).
void branch_on(EyePath path, float u) {
  float weight = max_component(path.weight);
  if (weight <= 0.0) return;
  if (weight < push.split_weight) {
    if (u * push.split_weight >= weight) return;
    path.weight *= push.split_weight / weight;
  }
  uint slot = atomicAdd(counters[PPM_COUNTER_PATHS_OUT], 1u);
  if (slot < push.path_capacity) eye_out[slot] = path;
}

void scatter(EyePath path, Surface surface, uint triangle) {
  vec3 wo = to_local(-path.direction, surface.shading_normal);
  SpecularLobes lobes = specular_lobes(surface.bsdf, wo.z);
  // Radiance is divided by the squared ratio of indices where it crosses an interface.
  lobes.transmitted /= square(surface.bsdf.eta);
  float reflected = mean_component(path.weight * lobes.reflected);
  float transmitted = mean_component(path.weight * lobes.transmitted);
  if (reflected + transmitted <= 0.0) return;

  uint events = path.state & 0xffffu;
  vec4 u = random_units(random_of(path.pixel, path.sample_index), 1u + events);
  bool both = reflected > 0.0 && transmitted > 0.0;
  bool split = both && path.splits < kMaxSplits && max_component(path.weight) > push.split_weight;
  bool only_reflected = !split && u.x * (reflected + transmitted) < reflected;

  if (split || only_reflected) {
    EyePath child = path;
    float probability = split ? 1.0 : reflected / (reflected + transmitted);
    child.weight = path.weight * lobes.reflected / probability;
    child.direction = reflected_direction(surface, path.direction);
    child.origin = offset_origin(surface.position, surface.geometric_normal);
    child.state = (path.state & 0xffff0000u) | (events + 1u);
    child.skip = triangle;
    child.splits = path.splits + (split ? 1u : 0u);
    branch_on(child, u.y);
  }
  if (!only_reflected) {
    EyePath child = path;
    float probability = split ? 1.0 : transmitted / (reflected + transmitted);
    child.weight = path.weight * lobes.transmitted / probability;
    vec3 wi = specular_transmission(surface.bsdf, wo, lobes.cos_transmitted);
    child.direction = normalize(to_world(wi, surface.shading_normal));
    child.origin = offset_origin(surface.position, -surface.geometric_normal);
    child.state = transmitted_state(surface, path.state, events + 1u);
    child.skip = triangle;
    if (split) {
      child.code |= 0x80000000u >> path.splits;
      child.splits = path.splits + 1u;
    }
    if (dot(child.direction, surface.geometric_normal) < 0.0) branch_on(child, u.z);
  }
}

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  EyePath path;
  if (push.generate != 0u) {
    path = start(item);
  } else {
    path = eye_in[item];
  }
  Hit hit = closest_hit(path.origin, path.direction, path.skip);
  if (hit.triangle == PPM_NO_TRIANGLE) {
    stage_light(path, vec3(0.0), miss_radiance(path.direction));
    return;
  }
  path.weight *= medium_transmittance(path.state, hit.t);
  path.distance += hit.t;
  Surface surface = surface_at(hit, path.direction);
  stage_light(path, surface.position, surface.emission);

  uint events = path.state & 0xffffu;
  if (scene.max_depth != 0u && events >= scene.max_depth) return;
  if (is_non_specular(surface.bsdf)) stage_hit_point(path, surface);
  if (events >= scene.eye_bounce_cap) {
    count_event(PPM_COUNTER_PATHS_CUT);
    return;
  }
  scatter(path, surface, hit.triangle);
}
