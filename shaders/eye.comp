// Ray tracing pass [HOJ08 section 3.1]: one invocation follows one eye path for a few segments.
//
// Reads the scene and EYE_IN (or starts the eye paths of a tile's pixels); stores a hit point (HITS, STATISTICS) where
// the path meets a surface with a non-specular part, and a record of light seen where it meets an emitter; follows one
// of the paths that specular reflection and transmission, both at glass, make of it, and writes the other to EYE_OUT.
// The order of all is arbitrary; HIT_KEYS, which follow from the path alone, put hit points into canonical order
// afterwards. CELL_COUNT counts those of each (pixel, sample).
//
// With kSurfaces it stores records for surfaces.comp instead: of the surface where each path ends, the first that is
// not specular alone. HITS_0 has its position and geometric normal, HITS_1 the shading normal and the path's length,
// HITS_2 the weight, HITS_3 the albedo.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"
#include "lib/scene_kinds.glsl"

#include "lib/albedo.glsl"
#include "lib/counters.glsl"
#include "lib/lights.glsl"
#include "lib/media.glsl"
#include "lib/surface.glsl"
#include "shared/bsdf_record.h"
#include "shared/camera.h"

layout(push_constant, scalar) uniform PushBlock { EyePush push; };
layout(binding = PPM_BIND_EYE_IN, scalar) readonly buffer EyeIn { EyePath eye_in[]; };
layout(binding = PPM_BIND_EYE_OUT, scalar) writeonly buffer EyeOut { EyePath eye_out[]; };
layout(binding = PPM_BIND_HITS_0, scalar) writeonly buffer Hits0 { uvec4 hits_0[]; };
layout(binding = PPM_BIND_HITS_1, scalar) writeonly buffer Hits1 { uvec4 hits_1[]; };
layout(binding = PPM_BIND_HITS_2, scalar) writeonly buffer Hits2 { uvec4 hits_2[]; };
layout(binding = PPM_BIND_HITS_3, scalar) writeonly buffer Hits3 { uvec4 hits_3[]; };
layout(binding = PPM_BIND_HITS_4, scalar) writeonly buffer Hits4 { uvec4 hits_4[]; };
layout(binding = PPM_BIND_STATISTICS, scalar) writeonly buffer Statistics { vec4 statistics[]; };
layout(binding = PPM_BIND_HIT_KEYS, scalar) writeonly buffer HitKeys { HitKey hit_keys[]; };
layout(binding = PPM_BIND_CELL_COUNT, scalar) buffer Counts { uint counts[]; };

// Whether invocations start the eye paths of the tile, rather than going on with those of EYE_IN.
layout(constant_id = 0) const bool kGenerate = false;
layout(constant_id = 1) const bool kSurfaces = false;

const float kLeastFootprint = 1e-15;
const uint kMaxSplits = 32u;  // bits of EyePath::code; later splits take one branch at random

// Random blocks of an eye path: 0 places it on the film, 1 + n is its n-th specular event.
RandomStream random_of(uint group) {
  return RandomStream(scene.seed, PPM_STREAM_EYE, push.pass, push.tile_first * push.samples + group);
}

EyePath start(uint group) {
  uint pixel = group / push.samples;
  uint sample_index = group - pixel * push.samples;
  uvec2 position = pixel_position(push.tile_first + pixel, scene.width, scene.height);
  vec4 u = random_units(random_of(group), 0u);
  // One shift for all samples of the pixel.
  u.z = random_units(random_of(pixel * push.samples), 0u).w;
  vec2 film = film_sample(push.filter_kind, position.x, position.y, sample_index, push.samples, u.xyz);
  EyePath path;
  path.origin = camera_origin(scene, film);
  path.group = group;
  path.direction = camera_direction(scene, film);
  path.state = 0u;
  path.media = camera_media();
  path.weight = vec3(1.0);
  path.skip = PPM_NO_TRIANGLE;
  path.code = 0u;
  path.splits = 0u;
  path.distance = kSurfaces ? 0.0 : camera_distance(scene);
  path.solid_angle = pixel_solid_angle(scene, camera_direction(scene, vec2(position) + 0.5));
  return path;
}

// The records a path leaves where it ends a segment: a hit point, light seen, or both. One loop for either, since
// lavapipe runs the code of every branch. `records` are those the path has left in this dispatch.
void stage(EyePath path, Surface surface, vec3 radiance, bool is_hit_point, bool is_light, inout uint records) {
  uint events = path.state & 0xffffu;
  uint packed_geometric = pack_direction(surface.geometric_normal);
  uvec2 packed_directions = uvec2(pack_direction(surface.shading_normal), pack_direction(-path.direction));
  uvec4 bsdf;
  uint bsdf_extra;
  pack_bsdf(surface.bsdf, bsdf, bsdf_extra);
  uvec4 layers;
  uint flags = min(events, 255u) << 8u;
  if (kLayers) {
    layers = pack_layers(surface.bsdf);
    uint glass = surface.bsdf.thin_ior > 0.0 ? PPM_HIT_TRANSMITS : PPM_HIT_TRANSMITS | PPM_HIT_SOLID;
    flags |= (has_rough_glass(surface.bsdf) ? glass : 0u) | (surface.front ? 0u : PPM_HIT_BACK);
  }
  float cosine = dot(path.direction, surface.geometric_normal);
  // Never 0, which would mark it as light seen: pixels may be smaller than single precision can square.
  float footprint = max(footprint_radius(path.solid_angle, path.distance, cosine), kLeastFootprint);
  vec3 weight = path.weight / float(push.samples);

  uint last = is_light ? 2u : 1u;
  for (uint kind = is_hit_point ? 0u : 1u; kind < last; ++kind) {
    bool light = kind == 1u;
    vec3 value = light ? weight * radiance : weight;
    if (!is_finite3(value) || !is_finite3(surface.position)) {
      count_event(PPM_COUNTER_NON_FINITE);
      continue;
    }
    // No other path of its sample is about while the first is.
    uint arrival = records++;
    if (!kGenerate) arrival = atomicAdd(counts[path.group], 1u);
    uint slot = atomicAdd(counters[PPM_COUNTER_HITS], 1u);
    if (slot >= push.hit_capacity) continue;  // the host sees the count and traces again
    hits_0[slot] = uvec4(floatBitsToUint(surface.position), light ? 0u : packed_geometric);
    hits_1[slot] = uvec4(packed_directions, slot, light ? PPM_HIT_EMISSION : flags);
    hits_2[slot] = uvec4(floatBitsToUint(value), light ? 0u : bsdf_extra);
    hits_3[slot] = light ? uvec4(0u) : bsdf;
    if (kLayers) hits_4[slot] = light ? uvec4(0u) : layers;
    // Until the first radius is found its place holds the footprint; light seen has none and is never searched.
    statistics[slot] = vec4(0.0, 0.0, 0.0, light ? 0.0 : square(footprint));
    hit_keys[slot] = HitKey(path.group, arrival, 2u * events + kind, path.code);
  }
}

// Whether a path that looks for surfaces ends at this one: it has more than specular lobes, or none at all.
bool ends_at(Surface surface, vec3 direction) {
  SpecularLobes lobes = specular_lobes(surface.bsdf, -dot(direction, surface.shading_normal));
  return is_non_specular(surface.bsdf) || max_component(lobes.reflected + lobes.transmitted) <= 0.0;
}

// The record of that surface. Weights are of radiance over the squared index, which glass leaves at 1 or below.
void stage_surface(EyePath path, Surface surface, inout uint records) {
  vec3 weight = path.weight / float(push.samples);
  if (kMedia) weight *= square(media_ior(path.media) / media_ior(camera_media()));
  if (!is_finite3(weight) || !is_finite3(surface.position)) {
    count_event(PPM_COUNTER_NON_FINITE);
    return;
  }
  uint arrival = records++;
  if (!kGenerate) arrival = atomicAdd(counts[path.group], 1u);
  uint slot = atomicAdd(counters[PPM_COUNTER_HITS], 1u);
  if (slot >= push.hit_capacity) return;  // the host sees the count and traces again
  hits_0[slot] = uvec4(floatBitsToUint(surface.position), pack_direction(surface.geometric_normal));
  hits_1[slot] = uvec4(pack_direction(surface.shading_normal), floatBitsToUint(path.distance), 0u, 0u);
  hits_2[slot] = uvec4(floatBitsToUint(weight), 0u);
  hits_3[slot] = uvec4(floatBitsToUint(albedo_of(surface.bsdf)), 0u);
  hit_keys[slot] = HitKey(path.group, arrival, 2u * (path.state & 0xffffu), path.code);
}

// A branch that specular reflection or transmission makes of a path.
struct Branch {
  vec3 weight;
  bool exists;
};

// Branches that weigh little survive in proportion to their weight (Russian roulette).
Branch make_branch(vec3 weight, bool exists, float u) {
  float largest = max_component(weight);
  bool light = largest < push.split_weight;
  bool survives = largest > 0.0 && (!light || u * push.split_weight < largest);
  return Branch(weight * (light ? push.split_weight / largest : 1.0), exists && survives);
}

// What becomes of a path at a surface, with as few branches as can be: lavapipe runs the code of all.
struct Scattering {
  Branch reflected, transmitted;
  bool split;
  bool straight;  // not scattered at all: transmitted as it is
  MediaInterface sides;
  vec3 transmitted_direction;
};

Scattering scatter(EyePath path, Surface surface, Crossing crossing, bool goes_on) {
  vec3 wo = to_local(-path.direction, surface.shading_normal);
  SpecularLobes lobes = specular_lobes(surface.bsdf, wo.z);
  // Radiance is divided by the squared ratio of indices where it crosses an interface.
  lobes.transmitted /= square(surface.bsdf.eta);
  float reflected = mean_component(path.weight * lobes.reflected);
  float transmitted = mean_component(path.weight * lobes.transmitted);
  goes_on = goes_on && reflected + transmitted > 0.0;

  uint events = path.state & 0xffffu;
  vec4 u = random_units(random_of(path.group), 1u + events);
  bool both = reflected > 0.0 && transmitted > 0.0;
  Scattering result;
  result.split = both && path.splits < kMaxSplits && max_component(path.weight) > push.split_weight;
  bool only_reflected = !result.split && u.x * (reflected + transmitted) < reflected;
  float reflection = result.split ? 1.0 : reflected / (reflected + transmitted);
  float transmission = result.split ? 1.0 : transmitted / (reflected + transmitted);
  result.reflected =
      make_branch(path.weight * lobes.reflected / reflection, goes_on && (result.split || only_reflected), u.y);
  vec3 wi = specular_transmission(surface.bsdf, wo, lobes.cos_transmitted);
  result.transmitted_direction = normalize(to_world(wi, surface.shading_normal));
  bool through = dot(result.transmitted_direction, surface.geometric_normal) < 0.0;
  result.transmitted =
      make_branch(path.weight * lobes.transmitted / transmission, goes_on && !only_reflected && through, u.z);
  result.sides = crossing.sides;
  result.straight = crossing.straight;
  if (crossing.straight) {
    result.transmitted = Branch(path.weight, true);
    result.transmitted_direction = path.direction;
    result.split = false;
  }
  return result;
}

EyePath take_branch(EyePath path, Surface surface, Scattering scattering, uint triangle, bool transmitted) {
  path.state += scattering.straight ? 0u : 1u;
  path.origin = offset_origin(surface.position, transmitted ? -surface.geometric_normal : surface.geometric_normal);
  path.direction =
      transmitted ? scattering.transmitted_direction : reflected_direction(surface, path.direction);
  path.media = transmitted ? scattering.sides.after : scattering.sides.before;
  path.weight = transmitted ? scattering.transmitted.weight : scattering.reflected.weight;
  path.skip = triangle;
  path.code |= transmitted && scattering.split ? 0x80000000u >> path.splits : 0u;
  path.splits += scattering.split ? 1u : 0u;
  return path;
}

void queue(EyePath path) {
  uint slot = atomicAdd(counters[PPM_COUNTER_PATHS_OUT], 1u);
  if (slot < push.path_capacity) eye_out[slot] = path;
}

// A path that meets what bends its colours apart starts its segment anew in each channel that it carries. Once its
// code is full it goes on in one of them, drawn by weight.
void queue_channels(EyePath path) {
  bool full = path.splits + 2u > kMaxSplits;
  vec4 u = random_units(random_of(path.group), 1u + (path.state & 0xffffu));
  vec3 weight = full ? drawn_channel(path.weight, u.w) : path.weight;
  uint channel = 0u;
  do {
    EyePath part = path;
    part.weight = in_channel(weight, channel);
    part.code |= full ? 0u : (channel << 30u) >> path.splits;
    part.splits += full ? 0u : 2u;
    if (max_component(part.weight) > 0.0) queue(part);
  } while (++channel < 3u);
}

// The samples of a pixel share a key and are strata, so that a veil hides its share of them but for one. Nor does a
// path's code count: a segment that starts anew must meet what it met before.
void set_coverage_key(EyePath path) {
  uint pixel = path.group / push.samples;
  uint events = path.state & 0xffffu;
  coverage_key = random_words(random_of(pixel * push.samples), kCoverageBlock + events).x;
  coverage_shift = (path.group - pixel * push.samples) * (0xffffffffu / push.samples);
}

// One segment of a path and what happens at its end; of the branches, the reflected is followed if there is one, else
// the transmitted, but none when it is the `last` segment here: whatever is not followed is queued. False: it is over.
bool advance(inout EyePath path, bool last, inout uint records) {
  if (kCoverage) set_coverage_key(path);
  Hit hit = closest_hit(path.origin, path.direction, path.skip);
  uint events = path.state & 0xffffu;
  bool missed = hit.triangle == PPM_NO_TRIANGLE;
  if (missed) hit = Hit(0.0, 0u, vec2(0.0));  // any surface
  bool in_depth = !missed && (scene.max_depth == 0u || events < scene.max_depth);
  Surface surface = surface_at(hit, path.direction);
  Crossing crossing = cross_media(surface, path.media);
  crossing.straight = crossing.straight && !missed;
  in_depth = in_depth && !crossing.straight;
  if (kDispersion) {
    if (!missed && disperses(surface) && channel_of(path.weight) == PPM_ALL_CHANNELS &&
        max_component(path.weight) > 0.0) {
      queue_channels(path);
      return false;
    }
    show_to_channel(surface, path.weight);
  }
  path.weight *= media_transmittance(path.media, hit.t);
  path.distance += hit.t;
  vec3 radiance = missed ? miss_radiance(path.direction) : surface.emission;
  bool ends = false;
  if (kSurfaces) {
    ends = !missed && !crossing.straight && ends_at(surface, path.direction);
    if (ends) stage_surface(path, surface, records);
  } else {
    stage(path, surface, radiance, in_depth && is_non_specular(surface.bsdf), max_component(radiance) > 0.0, records);
  }
  bool cut = in_depth && events >= scene.eye_bounce_cap;
  if (cut) count_event(PPM_COUNTER_PATHS_CUT);

  Scattering scattering = scatter(path, surface, crossing, in_depth && !cut && !ends);
  bool reflected = scattering.reflected.exists;
  bool transmitted = scattering.transmitted.exists;
  bool follow = !last && (reflected || transmitted);
  uint end = transmitted && (last || reflected) ? 2u : 1u;
  for (uint branch = reflected && last ? 0u : 1u; branch < end; ++branch) {
    queue(take_branch(path, surface, scattering, hit.triangle, branch == 1u));
  }
  path = take_branch(path, surface, scattering, hit.triangle, !reflected);
  return follow;
}

void main() {
  uint item = item_of_invocation(push.first);
  if (item >= push.first + push.count) return;
  uint records = 0u;
  if (kGenerate) {
    EyePath path = start(item);
    advance(path, true, records);
    counts[item] = records;
  } else {
    EyePath path = eye_in[item];
    uint bounce = 0u;
    bool alive;
    do {  // lavapipe runs the body of a loop that is tested at its head once more, with no lane in it
      ++bounce;
      alive = advance(path, bounce == push.bounces, records);
    } while (alive);
    if (push.bounces > 1u) atomicAdd(counters[PPM_COUNTER_EYE_RAYS], bounce);
  }
}
