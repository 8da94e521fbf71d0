// What the kernels of bidirectional path tracing share: random numbers of a path, its vertices, where its light goes.
#ifndef PPM_LIB_BIDIRECTIONAL_GLSL
#define PPM_LIB_BIDIRECTIONAL_GLSL

#include "lib/film.glsl"
#include "lib/lights.glsl"
#include "lib/surface.glsl"
#include "lib/visibility.glsl"
#include "shared/bidirectional.h"
#include "shared/camera.h"
#include "shared/random.h"

layout(push_constant, scalar) uniform PushBlock { BidirectionalPush push; };

layout(constant_id = 0) const uint kWays = PPM_BDPT_ALL;  // in which paths meet
const float kNextEventCounts = (kWays & PPM_BDPT_NEXT_EVENT) != 0u ? 1.0 : 0.0;
const float kConnectionsCount = (kWays & PPM_BDPT_CONNECTIONS) != 0u ? 1.0 : 0.0;

// ---- Random numbers
// Whatever chance decides about a path it asks of path_words: a block of four words, by number.

// Light paths: two blocks start them, then one for each scattering event.
const uint kEmissionBlock = 0u;
const uint kLightScatteringBlock = 2u;
// Camera paths: one block places them on the film, then three for each event: scattering, next event, its sky.
const uint kFilmBlock = 0u;
const uint kCameraEventBlock = 1u;
const uint kCameraEventBlocks = 3u;
// Which pixel a lens splat goes to, by events; where the sequence of a pixel's film places starts.
const uint kSplatBlock = 0x40000000u;
const uint kShiftBlock = 0x50000000u;

#include "lib/path_words.glsl"

vec4 units_of(uvec4 words) {
  return vec4(unit_from_word(words.x), unit_from_word(words.y), unit_from_word(words.z), unit_from_word(words.w));
}

void set_coverage_key(uint stream, uint path, uint block) {
  if (!kCoverage) return;
  coverage_key = path_words(stream, path, kCoverageBlock + block).x;
  coverage_shift = 0u;
}

// Where colours may be bent apart all of a sample is of one channel, and counts three times.
vec3 in_channel_of(uint path, vec3 value) {
  if (!kDispersion) return value;
  return in_channel(value, index_from_word(path_words(PPM_STREAM_CAMERA_PATH, path, kFilmBlock).z, 3u));
}
const float kChannelWeight = kDispersion ? 3.0 : 1.0;

// ---- Where light goes

uint picture_pixel(uvec2 position) { return position.y * scene.width + position.x; }

// Adds to the pixel that the camera path came from. Of chains it is the sample's own sum: what it counts in the picture
// is not known before all of it is.
void deposit(uint path, vec3 value) {
  uint target = path;
  if (!kChains) target = picture_pixel(pixel_position(pass_and_pixel(path).y, scene.width, scene.height));
  film_add(target, value * kChannelWeight);
}

// ---- Vertices

PathVertex vertex_from(uvec4 a, uvec4 b, uvec4 c, uvec4 d) {
  return PathVertex(uintBitsToFloat(a.xy), a.z, a.w, uintBitsToFloat(b.xyz), b.w, uintBitsToFloat(c.xyz), c.w,
                    uintBitsToFloat(d.x), uintBitsToFloat(d.y), d.z, d.w);
}
#define PPM_FETCH_VERTEX(plane, index)                                                     \
  vertex_from(PPM_FETCH(plane, 4u * (index)), PPM_FETCH(plane, 4u * (index) + 1u),         \
              PPM_FETCH(plane, 4u * (index) + 2u), PPM_FETCH(plane, 4u * (index) + 3u))

uint events_of(uint state) { return state & 0xffffu; }

// A vertex with its surface.
struct Meeting {
  PathVertex vertex;
  Surface surface;
  MediaInterface sides;
};

Meeting meeting_at(PathVertex vertex) {
  Meeting meeting;
  meeting.vertex = vertex;
  meeting.surface = surface_at(Hit(0.0, vertex.triangle, vertex.barycentric), vertex.direction);
  meeting.sides = cross_media(meeting.surface, vertex.media).sides;
  show_to_channel(meeting.surface, vertex.throughput);
  return meeting;
}

// A vertex as it shows in a direction: what a path would carry that left it that way.
struct Lead {
  vec3 value;                       // throughput * f * |cosine|
  float forward_pdf, reverse_pdf;   // per solid angle: of the direction, and of the one it came from
  float cosine;                     // |cosine| with the geometric normal
  vec3 origin;                      // of the ray
  uint media;                       // that it starts in
};

Lead lead_towards(Meeting meeting, vec3 direction, bool light) {
  Surface surface = meeting.surface;
  vec3 arrival = meeting.vertex.direction;
  // About the normal that this path sees, and about that which one sees that comes from the other side.
  vec3 own_wo = to_local(-arrival, surface.shading_normal);
  vec3 own_wi = to_local(direction, surface.shading_normal);
  vec3 other_normal = shading_normal_towards(surface, direction);
  vec3 other_wo = to_local(-arrival, other_normal);
  vec3 other_wi = to_local(direction, other_normal);

  vec3 wo = light ? other_wo : own_wo;  // f_r is about the eye's
  vec3 wi = light ? other_wi : own_wi;
  float out_ng = dot(direction, surface.geometric_normal);
  bool through = wi.z < 0.0;
  bool sound = wo.z > 0.0 && wi.z != 0.0 && (out_ng > 0.0) != through;
  Lead lead;
  lead.value = sound ? meeting.vertex.throughput * bsdf_eval(surface.bsdf, wo, wi) : vec3(0.0);
  if (light) {
    // |cosine| * shading_normal_factor, where the cosine that this divides by falls out
    if (through) lead.value *= square(surface.bsdf.eta);
    float factor = merge_normal_factor(wo.z, dot(arrival, surface.geometric_normal));
    if (factor > PPM_MAX_NORMAL_FACTOR && max_component(lead.value) > 0.0) count_event(PPM_COUNTER_CLAMPED);
    lead.value *= abs(out_ng) * min(factor, PPM_MAX_NORMAL_FACTOR);
  } else {
    lead.value *= abs(wi.z);
  }
  lead.forward_pdf = bsdf_pdf_solid_angle(surface.bsdf, own_wo, own_wi);
  lead.reverse_pdf = other_wo.z > 0.0 ? bsdf_reverse_pdf_solid_angle(surface.bsdf, other_wo, other_wi) : 0.0;
  lead.cosine = abs(out_ng);
  lead.origin = offset_origin(surface.position, out_ng > 0.0 ? surface.geometric_normal : -surface.geometric_normal);
  lead.media = through ? meeting.sides.after : meeting.sides.before;
  return lead;
}

PathMis mis_of(PathVertex vertex) { return PathMis(vertex.d_vcm, vertex.d_vc); }

// Whether the way counts in which a camera vertex is left to the light path and the one before is connected to it: the
// lens, for the first, has been told already.
float camera_connects(uint state) { return events_of(state) == 0u ? 1.0 : kConnectionsCount; }

#endif
