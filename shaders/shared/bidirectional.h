// Bidirectional path tracing [Veach97 chapters 8 and 10]: what its kernels pass to each other, and
// the weights of multiple importance sampling.
//
// A light path and a camera path of each sample meet in every way they can: the camera path hits an
// emitter; its vertices see a point of a light (next event); they see the light path's vertices
// (connections); the lens sees those. One path of light may come about in all of these ways; each
// counts with the balance heuristic's weight, its density over the sum of all densities, so that
// the weights of all ways sum to one.
//
// The sums are carried along both paths by the recursion of SmallVCM's author, Georgiev:
// Implementing Vertex Connection and Merging (2012). Of a vertex, with p the density with which it
// was sampled from the vertex before and g that vertex's reverse density factor, d_vcm is 1 / p up
// to the conversion to area, d_vc the sum over all ways that end further back. Densities leave out
// roulette and coverage: weights may be any function of the path alone.
#ifndef PPM_SHARED_BIDIRECTIONAL_H
#define PPM_SHARED_BIDIRECTIONAL_H

#include "shared/geometry.h"
#include "shared/layout.h"

PPM_NAMESPACE_BEGIN

// ---- Records
// --------------------------------------------------------------------------------------------

// Ways in which light and camera paths meet. Emitters that the camera sees directly or through
// specular surfaces alone are always counted.
#define PPM_BDPT_EMITTERS 1u     // the camera path hits an emitter
#define PPM_BDPT_NEXT_EVENT 2u   // a camera vertex sees a point of a light
#define PPM_BDPT_CONNECTIONS 4u  // a camera vertex sees a light vertex
#define PPM_BDPT_LENS 8u         // the lens sees a light vertex
#define PPM_BDPT_ALL 15u

// Bits of the states below; the lower 16 are scattering events so far.
#define PPM_BDPT_INFINITE 0x10000u  // light path: on the first segment from infinitely far away
#define PPM_BDPT_SPECULAR 0x20000u  // camera path: all its vertices so far are specular
#define PPM_BDPT_EMISSION 0x40000u  // a record not of a vertex but of light that was hit
#define PPM_BDPT_ORDINAL_SHIFT 20   // light vertex: how many of its path were stored before it
#define PPM_BDPT_NONE 0xffffffffu   // no vertex

// Of a sub-path, while it is followed.
struct SubPath {
  vec3 origin;
  uint path;        // index within the tile
  vec3 direction;   // unit, the way it travels
  uint state;       // PPM_BDPT_*
  vec3 throughput;  // light: flux over the density of its start; camera: weight
  uint skip;        // triangle slot it starts on, PPM_NO_TRIANGLE for none
  uint media;       // that it is in (shared/media.h)
  uint last;        // light: vertex stored last, PPM_BDPT_NONE
  float d_vcm, d_vc;
  float distance;  // since its last scattering event
};                 // 68

// A non-specular surface point of a sub-path, as the path met it. The surface is looked up anew.
struct PathVertex {
  vec2 barycentric;
  uint triangle;
  uint path;        // index within the tile
  vec3 direction;   // unit, the way the path travelled when it arrived
  uint state;       // PPM_BDPT_*
  vec3 throughput;  // before scattering here; light that was hit: what it adds to the pixel
  uint media;       // on the side it came from
  float d_vcm, d_vc;
  uint previous;  // light: the vertex of its path that was stored before, PPM_BDPT_NONE
  uint spare;
};  // 64

// What a light path adds to a pixel through the lens, where it is not added to the film at once.
struct LensSplat {
  vec3 value;
  uint pixel;
};  // 16

struct BidirectionalPush {
  uint first, count;
  uint pass;        // RNG counter: of the first pass, or the chains' step
  uint passes;      // that are sampled together; passes * pixels < 2^24 unless it is 1
  uint first_path;  // the tile's first among their paths, which go through the pixels by number,
                    // pass by pass, or through the chains
  uint generate;    // 1: items are new paths; 0: items are PATHS_IN
  uint bounces;     // that this dispatch follows a path at most
  uint vertex_capacity, path_capacity, pair_capacity;
  uint filter_kind;   // PPM_FILTER_*
  float light_paths;  // n_L: light paths for each sample of every pixel
  uint phase;         // PPM_CHAINS_*, of Markov chains
  uint chains;        // idem, all of them
};                    // 56

// Roulette: the probability with which a path goes on whose throughput an event has multiplied by
// `ratio`. Light that is caught between surfaces which absorb nothing gets out or is given up.
#define PPM_BDPT_PATIENCE 24u  // events
PPM_FN float path_survival(float ratio, uint events) {
  return min(ratio, events < PPM_BDPT_PATIENCE ? 1.0f : 0.9f);
}

// ---- Weights
// --------------------------------------------------------------------------------------------

struct PathMis {
  float d_vcm, d_vc;
};

// A light path's start. `cosine`: at a light that has a surface; `infinite`: 1 if it is infinitely
// far away; `hittable`: 0 for deltas, which no path meets by chance.
PPM_FN PathMis mis_light_start(float probability, float pdf_position_area,
                               float pdf_direction_solid_angle, float cosine, uint infinite,
                               uint hittable) {
  PathMis mis;
  // p_dir / p_emit: what next event estimation has to choose besides the light is the point, or
  // for what is infinitely far away the direction.
  mis.d_vcm = 1.0f / (infinite == 1u ? pdf_position_area : pdf_direction_solid_angle);
  mis.d_vc = hittable == 1u ? cosine / (probability * pdf_position_area * pdf_direction_solid_angle)
                            : 0.0f;
  return mis;
}

// pixel_solid_angle: 0 where no light path can come through the lens.
PPM_FN PathMis mis_camera_start(float light_paths, float pixel_solid_angle) {
  PathMis mis;
  mis.d_vcm = light_paths * pixel_solid_angle;
  mis.d_vc = 0.0f;
  return mis;
}

// Arrival at a surface. cosine: with the geometric normal; distance: 1 on the first segment from
// infinitely far away.
PPM_FN PathMis mis_arrive(PathMis mis, float distance, float cosine) {
  float per_area = 1.0f / max(cosine, 1e-12f);
  mis.d_vcm *= distance * distance * per_area;
  mis.d_vc *= per_area;
  return mis;
}

// A non-specular event. cosine: of the direction it leaves in, with the geometric normal. Both
// densities per solid angle. connects: 1 where the way in which this vertex and the one before were
// connected counts, else 0.
PPM_FN PathMis mis_scatter(PathMis mis, float cosine, float forward_pdf, float reverse_pdf,
                           float connects) {
  PathMis next;
  next.d_vcm = 1.0f / forward_pdf;
  next.d_vc = cosine / forward_pdf * (mis.d_vc * reverse_pdf + connects * mis.d_vcm);
  return next;
}

// A specular event, of which both densities are probabilities. `jacobian`: density of solid angles
// on the way back, over that on the way out (specular_jacobian).
PPM_FN PathMis mis_specular(PathMis mis, float cosine, float forward, float reverse,
                            float jacobian) {
  PathMis next;
  next.d_vcm = 0.0f;
  next.d_vc = mis.d_vc * cosine * (reverse / forward) * jacobian;
  return next;
}

// Refraction: n_o^2 cos_o dw_o = n_i^2 cos_i dw_i, the cosines with the shading normal.
PPM_FN float specular_jacobian(float cos_in, float cos_out, float eta) {
  return abs(cos_in) / max(abs(cos_out) * eta * eta, 1e-12f);
}

// The densities of all other ways over that of the one at hand, summed on one side of it.
// pdf_area: with which the other side's path would have sampled this vertex.
PPM_FN float mis_others(PathMis mis, float pdf_area, float reverse_pdf, float connects) {
  return pdf_area * (connects * mis.d_vcm + mis.d_vc * reverse_pdf);
}

// The camera path hits an emitter. direct_pdf, emit_pdf: of choosing this point (of the sky: this
// direction) of this light, and of starting this light path.
PPM_FN float mis_emitter(PathMis mis, float direct_pdf, float emit_pdf, float next_event) {
  return 1.0f / (1.0f + next_event * direct_pdf * mis.d_vcm + emit_pdf * mis.d_vc);
}

PPM_NAMESPACE_END

#ifdef __cplusplus
namespace ppm::shared {
static_assert(sizeof(SubPath) == 68);
static_assert(sizeof(PathVertex) == 64);
static_assert(sizeof(LensSplat) == 16);
static_assert(sizeof(BidirectionalPush) == 56);
}  // namespace ppm::shared
#endif

#endif  // PPM_SHARED_BIDIRECTIONAL_H
