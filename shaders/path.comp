// Path tracing: one invocation follows one path from the camera for a few events.
//
// Reads the scene and PATHS_IN (or starts one path for each pixel); writes PATHS_OUT with the paths that go on, and adds
// what the others have found to the film. Order is arbitrary: random numbers belong to the path, and so does the sum.
//
// At each surface with a non-specular part one light, chosen as photons choose it, is connected with the path. Light
// that the path meets by itself counts in full after camera and specular events, where no connection could have
// found it. After others it counts for nothing (pt), or both ways share it by the power heuristic (pt-mis) [Veach97].
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"
#include "lib/scene_kinds.glsl"

#include "lib/film.glsl"
#include "lib/lights.glsl"
#include "lib/media.glsl"
#include "lib/surface.glsl"
#include "lib/visibility.glsl"
#include "shared/camera.h"

layout(push_constant, scalar) uniform PushBlock { PathPush push; };
layout(binding = PPM_BIND_BATCH, scalar) buffer Batch { BatchWords batch; };
layout(binding = PPM_BIND_PATHS_IN, scalar) readonly buffer PathsIn { CameraPath paths_in[]; };
layout(binding = PPM_BIND_PATHS_OUT, scalar) writeonly buffer PathsOut { CameraPath paths_out[]; };

// Whether emitters that are met by chance share with those that are chosen.
layout(constant_id = 0) const bool kHeuristic = false;

const float kFarAway = 1e30;  // LightConnection::distance of what is infinitely far

// Random blocks of a path, by scattering events before.
const uint kScatteringBlock = 0u;
const uint kLightBlock = 0x10000u;  // two for each
const uint kChannelBlock = 0x30000u;
const uint kShiftBlock = 0x40000u;  // of the pixel
const uint kShadowCoverageBlock = kCoverageBlock + 0x10000u;

// Events from which on Russian roulette ends paths.
const uint kRouletteEvents = 3u;

uint events_of(CameraPath path) { return path.state & PPM_PATH_EVENTS; }

RandomStream random_of(CameraPath path) {
  return RandomStream(scene.seed, PPM_STREAM_PATH, push.pass + (path.state >> PPM_PATH_PASS_SHIFT), path.pixel);
}

CameraPath start(uint item) {
  uint number = push.path_first + item;
  uint pixels = scene.width * scene.height;
  uint pass = number / pixels;
  uvec2 position = pixel_position(number - pass * pixels, scene.width, scene.height);
  CameraPath path;
  path.pixel = film_pixel(position);
  path.state = PPM_PATH_ONLY_SPECULAR | (pass << PPM_PATH_PASS_SHIFT);
  uvec4 shift = random_words(RandomStream(scene.seed, PPM_STREAM_PATH, 0u, path.pixel), kShiftBlock);
  vec2 at = film_sample_in_sequence(push.filter_kind, position.x, position.y, push.pass + pass, shift.xy);
  path.origin = camera_origin(scene, at);
  path.direction = camera_direction(scene, at);
  path.weight = vec3(1.0);
  path.skip = PPM_NO_TRIANGLE;
  path.radiance = vec3(0.0);
  path.media = camera_media();
  path.pdf_solid_angle = 0.0;
  path.distance = 0.0;
  return path;
}

// The share of a way to find light that has this density, where another way has `other`.
float power_heuristic(float own, float other) {
  float ratio = other / own;
  return 1.0 / (1.0 + ratio * ratio);
}

// The share of light that the path has met. `light_pdf`: with which a connection would have found it, per solid angle.
float share_of_met(CameraPath path, float light_pdf) {
  if (path.pdf_solid_angle <= 0.0) return 1.0;
  return kHeuristic ? power_heuristic(path.pdf_solid_angle, light_pdf) : 0.0;
}

// What the surface gives off towards the path.
vec3 met_emission(CameraPath path, Surface surface, uint triangle) {
  // The eye sees what is unlit, but it lights nothing.
  if ((surface.flags & PPM_MATERIAL_UNLIT) != 0u) {
    return (path.state & PPM_PATH_ONLY_SPECULAR) != 0u ? surface.emission : vec3(0.0);
  }
  float share = 1.0;
  if (max_component(surface.emission) > 0.0 && path.pdf_solid_angle > 0.0) {
    TriangleCorners corners = fetch_triangle(triangle);
    float area = 0.5 * length(cross(corners.corner1 - corners.corner0, corners.corner2 - corners.corner0));
    float cosine = max(-dot(path.direction, surface.geometric_normal), 1e-12);
    share = share_of_met(path, light_probability_of(triangle) * square(path.distance) / (area * cosine));
  }
  return surface.emission * share;
}

vec3 met_sky(CameraPath path) {
  if (!kEnvironment) return vec3(0.0);
  EnvironmentSight sight = environment_towards(path.direction);
  return sight.radiance * share_of_met(path, environment_probability() * sight.pdf_solid_angle);
}

// Light that the surface scatters towards the path from one light.
vec3 connected_light(CameraPath path, Surface surface, MediaInterface sides, uint triangle, RandomStream random) {
  uint events = events_of(path);
  uvec4 words = random_words(random, kLightBlock + 2u * events);
  vec4 units = random_units(random, kLightBlock + 2u * events + 1u);
  Light light = fetch_light(choose_light(words.x, words.y));
  LightConnection connection = light_connect(light, surface.position, units.xy);
  bool is_triangle = light.record.kind == PPM_LIGHT_TRIANGLE;
  if (is_triangle && light.record.triangle == triangle) return vec3(0.0);  // flat: it does not light itself
  bool is_sky = kEnvironment && light.record.kind == PPM_LIGHT_ENVIRONMENT;
  if (is_sky) {
    vec3 towards_sky;
    EnvironmentSight sight = sample_environment(words.zw, units.zw, towards_sky);
    connection = environment_connect(light, towards_sky, sight);
  }
  if (kTexturedLights && is_triangle) {
    connection.radiance *= light_texture(light.record.triangle, connection.barycentric);
  }
  if (kLayers && is_triangle) {
    float coat = light_coat(light.record.triangle, connection.barycentric);
    connection.radiance *= clearcoat_transmittance(Clearcoat(coat, 0.0), connection.light_cosine);
  }

  vec3 wo = to_local(-path.direction, surface.shading_normal);
  vec3 wi = to_local(connection.direction, surface.shading_normal);
  bool through = wi.z < 0.0;
  bool same_side = dot(connection.direction, surface.geometric_normal) > 0.0;
  float light_pdf = light.record.probability * connection.pdf_solid_angle;
  if (through == same_side || !(light_pdf > 0.0)) return vec3(0.0);
  vec3 found = path.weight * connection.radiance * bsdf_eval(surface.bsdf, wo, wi) * (abs(wi.z) / light_pdf);
  if (kHeuristic && (is_triangle || is_sky)) {
    found *= power_heuristic(light_pdf, bsdf_pdf_solid_angle(surface.bsdf, wo, wi));
  }
  if (!(max_component(found) > 0.0)) return vec3(0.0);

  // Both ends off their surfaces, the far one towards this one.
  vec3 from = offset_origin(surface.position, through ? -surface.geometric_normal : surface.geometric_normal);
  vec3 direction = connection.direction;
  float distance = connection.distance;
  if (distance < kFarAway) {
    vec3 to = light.record.position;
    if (is_triangle) {
      vec3 weights = corner_weights(connection.barycentric);
      vec3 normal = normalize(triangle_area_normal(light));
      to = light.corner0 * weights.x + light.corner1 * weights.y + light.corner2 * weights.z;
      to = offset_origin(to, dot(normal, direction) < 0.0 ? normal : -normal);
    }
    distance = length(to - from);
    direction = (to - from) / distance;
  }
  if (kCoverage) coverage_key = random_words(random, kShadowCoverageBlock + events).x;
  return found * visible_share(from, direction, distance, triangle, through ? sides.after : sides.before);
}

// Scatters the path at the surface; false: it ends here.
bool scatter(inout CameraPath path, Surface surface, MediaInterface sides, uint triangle, RandomStream random) {
  uint events = events_of(path);
  vec4 u = random_units(random, kScatteringBlock + events);
  vec3 wo = to_local(-path.direction, surface.shading_normal);
  BsdfSample chosen = bsdf_sample(surface.bsdf, wo, u.xyz, PPM_TRANSPORT_RADIANCE);
  if (chosen.forward_pdf_solid_angle <= 0.0) return false;

  bool specular = chosen.specular != 0u;
  bool transmitted = chosen.transmission != 0u;
  vec3 direction = normalize(to_world(chosen.wi, surface.shading_normal));
  if (specular && !transmitted) direction = reflected_direction(surface, path.direction);
  bool same_side = dot(direction, surface.geometric_normal) > 0.0;
  if (same_side == transmitted) return false;  // through the surface by way of its interpolated normal

  path.weight *= chosen.weight;
  if (max_component(path.weight) <= 0.0) return false;
  path.media = transmitted ? sides.after : sides.before;
  if (events + 1u >= kRouletteEvents) {
    // Radiance over the squared index is what stays the same across interfaces.
    float importance = max_component(path.weight);
    if (kMedia) importance *= square(media_ior(path.media) / media_ior(camera_media()));
    if (!(u.w < importance)) return false;
    path.weight /= min(importance, 1.0);
  }
  path.direction = direction;
  path.origin = offset_origin(surface.position, transmitted ? -surface.geometric_normal : surface.geometric_normal);
  path.skip = triangle;
  path.pdf_solid_angle = specular ? 0.0 : chosen.forward_pdf_solid_angle;
  path.distance = 0.0;
  path.state = (specular ? path.state : path.state & ~PPM_PATH_ONLY_SPECULAR) + 1u;
  return true;
}

// One segment of a path and what happens at its end; false: the path is over.
bool advance(inout CameraPath path, RandomStream random) {
  uint events = events_of(path);
  if (kCoverage) {
    coverage_key = random_words(random, kCoverageBlock + events).x;
    coverage_shift = 0u;
  }
  Hit hit = closest_hit(path.origin, path.direction, path.skip);
  if (hit.triangle == PPM_NO_TRIANGLE) {
    path.radiance += path.weight * met_sky(path);
    return false;
  }
  path.weight *= media_transmittance(path.media, hit.t);
  path.distance += hit.t;
  Surface surface = surface_at(hit, path.direction);
  Crossing crossing = cross_media(surface, path.media);
  if (crossing.straight) {
    path.origin = offset_origin(surface.position, -surface.geometric_normal);
    path.skip = hit.triangle;
    path.media = crossing.sides.after;
    return true;
  }
  path.radiance += path.weight * met_emission(path, surface, hit.triangle);
  if (scene.max_depth != 0u && events >= scene.max_depth) return false;
  if (events >= scene.photon_bounce_cap) {
    count_event(PPM_COUNTER_PATHS_CUT);
    return false;
  }
  if (kDispersion) {
    if (disperses(surface)) path.weight = drawn_channel(path.weight, random_units(random, kChannelBlock + events).x);
    show_to_channel(surface, path.weight);
  }
  if (is_non_specular(surface.bsdf)) {
    path.radiance += connected_light(path, surface, crossing.sides, hit.triangle, random);
  }
  return scatter(path, surface, crossing.sides, hit.triangle, random);
}

void main() {
  uint item = item_of_invocation(push.first);
  uint paths = batch.alive[push.round];
  if (item >= paths) return;
  CameraPath path;
  if (push.generate == 0u) {
    path = paths_in[item];
  } else {
    path = start(item);
  }
  RandomStream random = random_of(path);
  bool alive;
  uint bounces = paths > PPM_FEW_PATHS ? PPM_BOUNCES_OF_MANY : PPM_BOUNCES_OF_FEW;
  do {  // tested at its end: lavapipe runs a loop's body once more, for nobody, where the test is at its top
    alive = advance(path, random);
    --bounces;
  } while (alive && bounces > 0u);
  if (alive) {
    uint slot = atomicAdd(batch.alive[push.round + 1u], 1u);
    if (slot < push.path_capacity) paths_out[slot] = path;
  } else {
    film_add(path.pixel, path.radiance);
    atomicAdd(counters[PPM_COUNTER_EYE_RAYS], events_of(path) + 1u);  // one before each event, and the last
  }
}
