// Photon tracing pass [HOJ08 section 3.1]: one invocation follows one path for a few bounces.
//
// Reads the scene and PATHS_IN (or starts new paths at the lights); writes photons where the path meets surfaces with
// a non-specular part, and PATHS_OUT with the paths that go on. Order in both is arbitrary: random numbers
// belong to the path, and everything later sums without regard to order.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"
#include "lib/scene_kinds.glsl"

#include "lib/counters.glsl"
#include "lib/lights.glsl"
#include "lib/media.glsl"
#include "lib/surface.glsl"
#include "shared/photon.h"

layout(push_constant, scalar) uniform PushBlock { PhotonPush push; };
layout(binding = PPM_BIND_BATCH, scalar) buffer Batch { BatchWords batch; };
layout(binding = PPM_BIND_PATHS_IN, scalar) readonly buffer PathsIn { PhotonPath paths_in[]; };
layout(binding = PPM_BIND_PATHS_OUT, scalar) writeonly buffer PathsOut { PhotonPath paths_out[]; };
layout(binding = PPM_BIND_PHOTON_POSITION, scalar) writeonly buffer PhotonPositions { uvec4 photon_position[]; };
layout(binding = PPM_BIND_PHOTON_FLUX, scalar) writeonly buffer PhotonFluxes { uvec4 photon_flux[]; };

const float kNoRange = 1e30;  // longer than any ray
// Photons leave their lights with 1 in the mean over channels and photons; those of coloured lights with up to 3 in one.
const float kUsualFlux = 2.0;

// Random blocks of a path: 0 and 1 start it, 2 + n is its n-th scattering, to which a channel may have to be drawn.
const uint kFirstScatteringBlock = 2u;
const uint kFirstChannelBlock = 0x10000u;

// Which pass of the batch a path belongs to: a quotient of numbers below 2^24, wrong by one at most before it is put
// right. Integers are divided one lane after the other on lavapipe.
uint pass_of(uint path) {
  uint pass = min(uint(int(float(int(path)) / float(int(push.paths)))), push.passes - 1u);
  if (pass * push.paths > path) pass -= 1u;
  if (pass + 1u < push.passes && (pass + 1u) * push.paths <= path) pass += 1u;
  return pass;
}

uint own_pass;  // of the path this invocation follows

PhotonPath emit(uint index, RandomStream random, out float range) {
  uvec4 words = random_words(random, 0u);
  vec4 units = random_units(random, 1u);
  uint chosen = choose_light(words.x, words.y);
  Light light = fetch_light(chosen);
  LightEmission emission = light_emit(light, units, unit_from_word(words.z));
  if (kEnvironment && light.record.kind == PPM_LIGHT_ENVIRONMENT) {
    vec3 towards_sky;
    EnvironmentSight sight = sample_environment(words.zw, units.zw, towards_sky);
    emission = environment_emit(light, towards_sky, sight, units.xy);
  }
  PhotonPath path;
  bool has_surface = light.record.kind == PPM_LIGHT_TRIANGLE;
  path.origin = has_surface ? offset_origin(emission.position, emission.normal) : emission.position;
  path.direction = emission.direction;
  path.path = index;
  path.state = 0u;
  path.flux = emission.flux / (light.record.probability * scene.total_power);
  if (kTexturedLights && has_surface) path.flux *= light_texture(light.record.triangle, emission.barycentric);
  path.skip = has_surface ? light.record.triangle : PPM_NO_TRIANGLE;
  if (kLayers && has_surface) {
    float coat = light_coat(path.skip, emission.barycentric);
    path.flux *= clearcoat_transmittance(Clearcoat(coat, 0.0), dot(emission.direction, emission.normal));
  }
  range = light_range(light.record);
  path.media = start_media(light, chosen, emission.normal);
  return path;
}

void store(PhotonPath path, vec3 flux, Surface surface, uint events) {
  uint slot = atomicAdd(batch.photons[own_pass], 1u);
  if (slot >= push.photon_share) return;  // batch_check.comp sees the count
  slot += own_pass * push.photon_share;
  // Light from both sides may count at a hit point of rough glass, which must know which face it fell on.
  vec3 normal = kLayers && !surface.front ? -surface.geometric_normal : surface.geometric_normal;
  Photon photon = Photon(surface.position, -path.direction, flux, normal, events);
  photon_position[slot] = pack_photon_position(photon);
  photon_flux[slot] = pack_photon_flux(photon);
}

// Scatters the path at the surface; false: it ends here.
bool scatter(inout PhotonPath path, Surface surface, MediaInterface sides, uint events, RandomStream random) {
  vec4 u = random_units(random, kFirstScatteringBlock + events);
  if (kDispersion) {
    if (disperses(surface)) path.flux = drawn_channel(path.flux, random_units(random, kFirstChannelBlock + events).x);
    show_to_channel(surface, path.flux);
  }
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
  vec3 flux = path.flux * chosen.weight * factor;

  // Russian roulette that keeps fluxes nearly equal, as pbrt-v4 has it, but lets go first of
  // what the factors of several events have piled up on a path: else few photons of great flux show as discs.
  float survival = min(1.0, max_component(flux) / min(max_component(path.flux), kUsualFlux));
  if (!(u.w < survival)) return false;
  path.flux = flux / survival;
  path.direction = direction;
  path.origin = offset_origin(surface.position,
                              transmitted ? -surface.geometric_normal : surface.geometric_normal);
  path.state = events + 1u;
  path.media = transmitted ? sides.after : sides.before;
  return true;
}

// One segment of a path and what happens at its end; false: the path is over.
// `range`: of the light that the segment starts at, in working units.
bool advance(inout PhotonPath path, RandomStream random, float range) {
  if (kCoverage) {
    coverage_key = random_words(random, kCoverageBlock + (path.state & 0xffffu)).x;
    coverage_shift = 0u;
  }
  Hit hit = closest_hit(path.origin, path.direction, path.skip);
  if (hit.triangle == PPM_NO_TRIANGLE) return false;
  path.flux *= media_transmittance(path.media, hit.t) * range_window(hit.t, range);
  Surface surface = surface_at(hit, path.direction);
  Crossing crossing = cross_media(surface, path.media);
  if (!is_finite3(path.flux) || !is_finite3(surface.position)) {
    count_event(PPM_COUNTER_NON_FINITE);
    return false;
  }
  if (max_component(path.flux) <= 0.0) return false;
  if (crossing.straight) {
    path.origin = offset_origin(surface.position, -surface.geometric_normal);
    path.skip = hit.triangle;
    path.media = crossing.sides.after;
    return true;
  }
  uint events = path.state & 0xffffu;
  if (is_non_specular(surface.bsdf)) {
    // Eye paths and photons are stopped by the same share of the area: what they meet there is lit by all the light, of
    // which only that share is stored.
    float covered = kCoverage ? coverage_at(hit.triangle, surface.material, hit.barycentric) : 1.0;
    store(path, path.flux / covered, surface, events);
  }
  if (scene.max_depth != 0u && events + 2u > scene.max_depth) return false;  // no photon further on could count
  if (events >= scene.photon_bounce_cap) {
    count_event(PPM_COUNTER_PATHS_CUT);
    return false;
  }
  path.skip = hit.triangle;
  return scatter(path, surface, crossing.sides, events, random);
}

void main() {
  uint item = item_of_invocation(push.first);
  uint paths = batch.alive[push.round];
  if (item >= paths) return;
  PhotonPath path;
  path.path = item;
  if (push.generate == 0u) path = paths_in[item];
  own_pass = pass_of(path.path);
  uint number = push.emit_first + path.path - own_pass * push.paths;
  RandomStream random = RandomStream(scene.seed, push.stream, push.pass + own_pass, number);
  float range = kNoRange;
  if (push.generate != 0u) path = emit(item, random, range);
  bool alive;
  uint bounces = paths > PPM_FEW_PATHS ? PPM_BOUNCES_OF_MANY : PPM_BOUNCES_OF_FEW;
  do {  // tested at its end: lavapipe runs a loop's body once more, for nobody, where the test is at its top
    alive = advance(path, random, range);
    range = kNoRange;  // all but the first segment
    --bounces;
  } while (alive && bounces > 0u);
  if (alive) {
    uint slot = atomicAdd(batch.alive[push.round + 1u], 1u);
    if (slot < push.path_capacity) paths_out[slot] = path;
  } else {
    atomicAdd(counters[PPM_COUNTER_PHOTON_RAYS], (path.state & 0xffffu) + 1u);  // one before each event, and the last
  }
}
