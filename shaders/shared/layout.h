// Every record that host and kernels, or two kernels, pass to each other. Scalar block layout;
// sizes in bytes are asserted on the host.
#ifndef PPM_SHARED_LAYOUT_H
#define PPM_SHARED_LAYOUT_H

#include "shared/lang.h"

// Invocations of a workgroup unless the device's profile says otherwise.
#define PPM_WORKGROUP_SIZE 64

PPM_NAMESPACE_BEGIN

// ---- Bounding volume hierarchy
// ------------------------------------------------------------------------

// Entries of the traversal stack; the builder keeps within it.
#define PPM_BVH_STACK 64
#define PPM_BVH_MAX_LEAF 4
#define PPM_BVH_EMPTY 0xffffffffu  // a child that is not there; its box is inverted
#define PPM_BVH_LEAF 0x80000000u   // set in references to leaves, but PPM_BVH_EMPTY

// Four children. Planes lie on the scene-wide grid of 65536 an axis, two to a word: words 0 and 1
// of box_x hold the lower planes of children 0 to 3, words 2 and 3 their upper ones, even children
// in the low halves. A reference is an inner node's index, or PPM_BVH_LEAF | (count - 1) << 29 |
// first slot, count in [1, PPM_BVH_MAX_LEAF], first < 2^29.
struct BvhNode {
  uvec4 box_x, box_y, box_z;
  uvec4 children;
};  // 64

// ---- Scene
// ----------------------------------------------------------------------------------------------

// Corners in the working frame, in leaf order. Texels: (corner0, material), (corner1, light
// probability), (corner2, spare).
#define PPM_HAS_COVERAGE 0x80000000u
struct TrianglePositions {
  vec3 corner0;
  uint material;  // PPM_HAS_COVERAGE: its alphaMode is not OPAQUE
  vec3 corner1;
  float light_probability;  // LightRecord::probability; 0 if it is no light
  vec3 corner2;
  uint spare2;
};  // 48

// Normals octahedral, 2 x 16 bits; colours 16-bit unorm (r, g in word 0; b in word 1).
struct TriangleShading {
  uint normal0, normal1, normal2;
  uint material;
  vec2 texcoord0, texcoord1;
  vec2 texcoord2;
  uvec2 color0;
  uvec2 color1;
  uvec2 color2;
};  // 64

// What few scenes need of a triangle. Tangents octahedral, 2 x 16 bits, the lowest of which is the
// handedness instead: 1 for -1.
#define PPM_DETAIL_TEXELS 3
struct TriangleDetail {
  vec2 texcoord0, texcoord1;  // of the second set, at the three corners
  vec2 texcoord2;
  uint tangent0, tangent1;
  uint tangent2;
  uint spare0, spare1, spare2;
};  // 48

// How a material uses a texture: s = dot(row_s, (u, v, 1)), t = dot(row_t, (u, v, 1)).
#define PPM_TEXTURE_USE_TEXELS 2
struct TextureUse {
  vec3 row_s;
  uint texture;  // index; bit 31: of the second set of coordinates
  vec3 row_t;
  uint spare;
};  // 32

#define PPM_SECOND_TEXCOORD 0x80000000u

// Bits of MaterialRecord::use_mask.
#define PPM_USE_BASE_COLOR 1u
#define PPM_USE_METALLIC_ROUGHNESS 2u
#define PPM_USE_NORMAL 4u
#define PPM_USE_EMISSIVE 8u
#define PPM_USE_TRANSMISSION 16u
#define PPM_USE_SPECULAR 32u
#define PPM_USE_SPECULAR_COLOR 64u
#define PPM_USE_CLEARCOAT 128u
#define PPM_USE_CLEARCOAT_ROUGHNESS 256u
#define PPM_USE_CLEARCOAT_NORMAL 512u

// Flags of a material.
#define PPM_MATERIAL_DOUBLE_SIDED 1u  // emits from both sides
#define PPM_MATERIAL_SOLID 2u         // transmission bends and attenuates; otherwise a thin sheet
#define PPM_MATERIAL_MASK 4u          // alphaMode MASK
#define PPM_MATERIAL_BLEND 8u         // alphaMode BLEND
#define PPM_MATERIAL_UNLIT 16u
#define PPM_MATERIAL_EMITS 32u  // from one side at least

#define PPM_MATERIAL_TEXELS 6
struct MaterialRecord {
  vec3 base_color;
  uint first_use;  // in TEXTURE_USES: one for each bit of use_mask, lowest bit first
  float metallic;
  float roughness;
  float transmission;
  float ior;
  vec3 specular_f0;  // of the dielectric part at normal incidence: min(this, 1) * specular
  float specular;    // idem at grazing incidence
  vec3 emission;     // radiance
  uint flags;
  float alpha, alpha_cutoff;
  float normal_scale;
  uint use_mask;  // PPM_USE_*
  float clearcoat, clearcoat_roughness, clearcoat_normal_scale;
  uint medium;  // 1 + index in MEDIA, 0 where nothing gets inside
};              // 96

// What fills a solid. Numbered from 1 by rank (shared/media.h).
#define PPM_MEDIUM_TEXELS 2
struct MediumRecord {
  vec3 absorption;  // 1 / working length
  float ior;
  float dispersion;  // 20 / Abbe number, 0 for none
  uint spare0, spare1, spare2;
};  // 32

// Bits of TextureRecord::sampling. 0-1: wrap_s, 2-3: wrap_t, as in scene.hpp.
#define PPM_TEXTURE_NEAREST 16u  // otherwise bilinear
#define PPM_TEXTURE_HALVES 32u   // two colours to a texel, linear; otherwise four, 8 bits a channel
#define PPM_TEXTURE_SRGB 64u     // the colours of 8 bits are sRGB codes
struct TextureRecord {
  uint width, height;
  uint first;  // index of the first texel
  uint sampling;
};  // 16

#define PPM_LIGHT_TRIANGLE 0u
#define PPM_LIGHT_POINT 1u
#define PPM_LIGHT_SPOT 2u
#define PPM_LIGHT_DIRECTIONAL 3u
#define PPM_LIGHT_ENVIRONMENT 4u

#define PPM_LIGHT_TEXELS 4
struct LightRecord {
  vec3 position;  // point, spot
  uint kind;
  vec3 emission;      // radiance, intensity or irradiance, working frame; environment: radiance
                      // integrated over the sphere
  float probability;  // of being chosen, all lights sum to 1
  vec3 direction;     // spot, directional: the way the light travels
  uint triangle;      // slot in leaf order; point, spot: the range as bits, working units
  float cos_inner, cos_outer;
  uint alias_threshold;  // of this record's bin: keep it if a 32-bit word is below
  uint alias;            // else take this one
};                       // 64

#define PPM_CAMERA_PERSPECTIVE 0
#define PPM_CAMERA_ORTHOGRAPHIC 1

struct SceneConstants {
  vec3 grid_origin;  // of the BVH's boxes
  uint light_count;
  vec3 grid_step;
  float total_power;     // sum of all lights' power, mean over channels, W * frame.scale^2
  vec3 bounding_centre;  // sphere around all triangles, for directional lights
  float bounding_radius;
  vec3 camera_position;
  float camera_tan_half_y;  // tan(yfov / 2); orthographic: half the height seen, working units
  vec3 camera_right;
  float camera_tan_half_x;  // idem horizontally
  vec3 camera_up;
  uint width;
  vec3 camera_forward;
  uint height;
  uint seed;
  uint max_depth;          // scattering events between light and eye at most; 0: no limit
  uint photon_bounce_cap;  // safety: scattering events after which a photon's path is cut and
                           // counted
  uint eye_bounce_cap;     // idem for eye paths
  uint camera_kind;        // PPM_CAMERA_*
  uint environment_width, environment_height;  // texels; EnvironmentShape in environment.h
  float environment_turn;
  float environment_pdf_scale;
};  // 148

// ---- Counters
// ---------------------------------------------------------------------------------------------

#define PPM_COUNTER_PATHS_OUT 0       // paths that go on, or eye paths
#define PPM_COUNTER_HITS 2            // hit points found (idem)
#define PPM_COUNTER_CONTINUE 3        // searches to be continued
#define PPM_COUNTER_PATHS_CUT 4       // paths ended by a safety cap
#define PPM_COUNTER_NON_FINITE 5      // photons or hits rejected for a NaN or infinity
#define PPM_COUNTER_CLAMPED 6         // shading-normal factors above PPM_MAX_NORMAL_FACTOR
#define PPM_COUNTER_OVERFLOW 7        // fixed-point terms or sums out of range
#define PPM_COUNTER_MAX_PIXEL_HITS 8  // most hit points of one pixel
#define PPM_COUNTER_UNDECIDED 9       // hit points for which the pilot has no radius yet
#define PPM_COUNTER_PHOTON_RAYS 10    // segments of the photon paths that have ended
#define PPM_COUNTER_EYE_RAYS \
  11                            // segments of eye paths, in dispatches that follow them for several
#define PPM_COUNTER_CROWDED 12  // hit points with too many photons in cells larger than wanted
#define PPM_COUNTER_SEARCHES 13  // that gather_slices.comp goes on with
#define PPM_COUNTER_LIGHT_VERTICES 20
#define PPM_COUNTER_CAMERA_VERTICES 21
#define PPM_COUNTER_VERTEX_PAIRS 22
#define PPM_COUNTER_COUNT 24

// ---- Batches of photon passes
// ------------------------------------------------------------------------------------------

#define PPM_BATCH_LIMIT 16   // passes of a batch
#define PPM_TRACE_ROUNDS 32  // rounds of bounces recorded at a time; an even number
#define PPM_GO_ON 0xffffffffu

// What the device decides about a batch while no host looks on, and tells when all is done. All
// zero at the beginning but go_on and the first of `alive`.
struct BatchWords {
  uint go_on;      // PPM_GO_ON: what is recorded may run. 0: something did not fit, and it must not
  uint completed;  // passes whose searches are complete
  uint clamped, overflow;            // the counters of these names after the last completed pass
  uint alive[PPM_TRACE_ROUNDS + 1];  // paths that each round begins with
  uint photons[PPM_BATCH_LIMIT];     // of each pass; more than its share: they do not fit
  uint sortable[PPM_BATCH_LIMIT];    // the same once all of the batch are known to fit
};

// What has just been done.
#define PPM_CHECK_TRACED 0u         // all paths of the batch
#define PPM_CHECK_TILE_SEARCHED 1u  // one tile, for one pass
#define PPM_CHECK_ALL_SEARCHED 2u   // the last tile, idem
struct BatchCheckPush {
  uint first, count;
  uint step;          // PPM_CHECK_*
  uint pass;          // of the batch, once searched
  uint passes;        // of the batch
  uint photon_share;  // room for the photons of one pass
  uint rounds;        // that were recorded
};

// ---- Where paths start
// -------------------------------------------------------------------------------------

struct StartMediaPush {
  uint first, count;
};

// ---- Photon pass
// ------------------------------------------------------------------------------------------

// A photon's path between two bounces. Flux is in units in which all lights together emit 1 a path.
struct PhotonPath {
  vec3 origin;
  uint path;       // index within the batch: pass of the batch * paths of each + path
  vec3 direction;  // unit, the way it travels
  uint state;      // bits 0-15: scattering events so far
  vec3 flux;
  uint skip;   // triangle slot it starts on, PPM_NO_TRIANGLE for none
  uint media;  // that it is in (shared/media.h)
};             // 52

#define PPM_NO_TRIANGLE 0xffffffffu

struct PhotonPush {
  uint first, count;
  uint pass;          // number of the batch's first pass, RNG counter
  uint paths;         // of each pass that are traced here
  uint passes;        // of the batch; paths * passes < 2^24 unless it is 1
  uint emit_first;    // number of each pass's first path here, RNG counter
  uint generate;      // 1: items are new paths; 0: items are PATHS_IN
  uint photon_share;  // photons that each pass may store
  uint path_capacity;
  uint stream;  // PPM_STREAM_*
  uint round;   // index into BatchWords::alive
};

// A round follows paths for few bounces while many are alive, lest lanes idle beside longer ones;
// for more when few are left, whose rounds would cost more than their rays.
#define PPM_FEW_PATHS 4096u
#define PPM_BOUNCES_OF_MANY 1u
#define PPM_BOUNCES_OF_FEW 4u

// ---- Path tracing
// ------------------------------------------------------------------------------------------

// A path from the camera between two events.
struct CameraPath {
  vec3 origin;
  uint pixel;             // row by row from the top left
  vec3 direction;         // unit, the way it travels
  uint state;             // PPM_PATH_*
  vec3 weight;            // of radiance that arrives here, in the pixel
  uint skip;              // triangle slot it starts on, PPM_NO_TRIANGLE for none
  vec3 radiance;          // found so far
  uint media;             // as in PhotonPath
  float pdf_solid_angle;  // with which the last event drew the direction; 0: camera or specular
  float distance;         // since the last event, working units
};                        // 72

#define PPM_PATH_EVENTS 0xffffu          // bits of state: scattering events so far
#define PPM_PATH_ONLY_SPECULAR 0x10000u  // all of them were specular
#define PPM_PATH_PASS_SHIFT 24u          // bits 24 to 31: pass of the batch
#define PPM_PATH_MOST_PASSES 256u        // of a batch

struct PathPush {
  uint first, count;
  uint pass;        // number of the batch's first pass, RNG counter
  uint path_first;  // paths of the batch that are made elsewhere: before these, pass by pass
  uint generate;    // 1: items are new paths; 0: items are PATHS_IN
  uint path_capacity;
  uint round;        // index into BatchWords::alive
  uint filter_kind;  // PPM_FILTER_*
};

// ---- Photon grid
// ------------------------------------------------------------------------------------------

// Cells of one edge length over a box. dense: cell index = x + size.x * (y + size.y * z);
// otherwise rows (y, z) are hashed into table_mask + 1 cells.
struct GridConstants {
  vec3 origin;
  float inverse_cell;
  uvec3 size;        // cells along each axis; coordinates are clamped to it
  uint table_mask;   // hashed: table size - 1, a power of two less one; dense: 0xffffffff
  uint table_first;  // first entry of the table: each pass of a batch has one of its own
};                   // 36

struct GridPush {
  uint first, count;
  GridConstants grid;
  uint photon_share;  // where the photons of each pass of the batch begin, times the pass
  uint entries;       // of each pass's table
};

// Exclusive scan of CELL_COUNT into CELL_START by serial chunks.
#define PPM_SCAN_CHUNK 512
#define PPM_SCAN_SLICE 16384  // chunks that one dispatch of the middle step takes
struct ScanPush {
  uint first, count;
  uint total;  // entries to scan; middle step: chunks
  uint slice;  // middle step: first chunk of this dispatch
};

// ---- Eye pass
// ---------------------------------------------------------------------------------------------

struct EyePath {
  vec3 origin;
  uint group;      // pixel of the tile * samples + sample
  vec3 direction;  // unit, the way it travels
  uint state;      // bits 0-15: scattering events so far
  vec3 weight;     // product of specular factors, times filter weight / samples a pixel
  uint skip;
  uint code;          // which branch was taken at each split, first split in the highest bit
  uint splits;        // bits of code in use
  float distance;     // length of the path so far, working units, from camera_distance on
  float solid_angle;  // of its pixel
  uint media;         // as in PhotonPath
};                    // 68

struct EyePush {
  uint first, count;
  uint pass;         // RNG counter, for methods that draw eye paths anew each pass
  uint tile_first;   // first pixel of the tile, in tile order
  uint samples;      // eye paths a pixel
  uint filter_kind;  // PPM_FILTER_*
  uint hit_capacity;
  uint path_capacity;
  float split_weight;  // both branches are followed while a path weighs more than this
  uint bounces;        // that this dispatch follows a path at most
};

#define PPM_FILTER_BOX 0u
#define PPM_FILTER_TENT 1u
#define PPM_FILTER_GAUSSIAN 2u

// A hit point. Four planes of 16 bytes, and a fifth in scenes with rough glass or clearcoats.
struct HitPoint {
  vec3 position;
  uint geometric_normal;  // octahedral 2 x 16; both normals on the side of the eye path
  uint shading_normal;
  uint outgoing;    // direction to where the eye path came from, octahedral 2 x 16
  uint statistics;  // index of the statistics this hit point feeds
  uint flags;       // PPM_HIT_*, bits 8-15: scattering events of the eye path before it
  vec3 weight;      // of its radiance in the pixel; emission: the radiance itself
  uint bsdf_extra;
  uvec4 bsdf;    // with bsdf_extra: the non-specular lobes, see bsdf_record.h
  uvec4 layers;  // more of them, see pack_layers
};               // 80

// Where a hit point belongs: the canonical order is by group, then by (order, code).
struct HitKey {
  uint group;    // pixel of the tile * samples + sample
  uint arrival;  // how many of its group were stored before it: arbitrary
  uint order;    // scattering events before it, times 2, plus 1 for light seen
  uint code;     // EyePath::code
};               // 16

#define PPM_HIT_EMISSION 1u  // not a hit point but light seen: weight is what it adds to the pixel
// In scenes with layers:
#define PPM_HIT_TRANSMITS 2u  // rough glass: light that arrives beyond it counts, too
#define PPM_HIT_SOLID 4u      // and it is the surface of a solid
#define PPM_HIT_BACK 8u       // seen from behind

struct EyeOrderPush {
  uint first, count;
  uint samples;  // eye paths a pixel
};

// ---- Statistics, gather, update
// ---------------------------------------------------------------------------

// Order-free sums over the photons of one pass within a hit point's disc. Integers, so that sums
// over chunks of photons, tiles or machines are exact: flux in 32.32 fixed point a channel, low
// word first.
struct GatherSum {
  uint count;             // M
  uint flux[6];           // sum of f_r * flux: r low, r high, g low, ...
  uint nearby;            // pilot only: photons in the cells around
  uint second_moment[2];  // room for an order-free second moment of luminance, 16.48 fixed point;
                          // zero today
};                        // 40

// Where a search of many photons goes on.
struct GatherCursor {
  uint hit;
  uint row;     // of its box of cells
  uint offset;  // photons already seen in that row
};              // 12

struct GatherPush {
  uint first, count;
  uint cursor_capacity;
  GridConstants grid;
};

struct UpdatePush {
  uint first, count;
  float alpha;
};

struct ResolvePush {
  uint first, count;
  uint samples;  // eye paths a pixel
  uint skip;     // hit points of each pixel that earlier dispatches have added
  float scale;   // total power / photons emitted: lambda to radiance, Eq. 13
};

// Hit points of one pixel that one dispatch of the resolve kernel adds at most.
#define PPM_RESOLVE_SLICE 8192
// Rows of cells and photons that one dispatch of a search visits at most for one hit point. On
// lavapipe all loops of the eight invocations that go in step take 65535 turns together, some two
// for each photon, and each of these may have its photons where the others have none.
#define PPM_GATHER_SLICE 2048
// Photons around a hit point above which the pilot does not look at them: one turn each, few more.
#define PPM_PILOT_CROWD 6144

// ---- Pilot: one radius per hit point
// ----------------------------------------------------------------------

// A disc with this many times the wanted photons is too large.
#define PPM_PILOT_ENOUGH 4u
struct PilotPush {
  uint first, count;
  uint round_index;      // 0: the largest radius
  uint last_round;       // 1: whoever has no radius yet gets one
  float radius;          // searched in this round
  float footprints_min;  // lower clamp of the result, in footprints
  uint wanted;           // photons wanted in a disc
  uint from_list;        // 0: items are hit points; 1: items are CONTINUE_IN
  uint coarse;           // 1: the cells are larger than those of the round
  GridConstants grid;
};

struct RadiusPush {
  uint first, count;
  float fixed_radius;  // if positive, the radius of all
  float footprints;    // else this many footprints
};

// ---- Photon map: the n-th nearest photon of each hit point
// ----------------------------------------------------------------------

// One hit point's search (shared/nearest.h). Squared distances are words: the bits of their floats.
#define PPM_NEAREST_LIST 8
struct NearestSearch {
  uint from;    // the photon looked for is no nearer than this,
  uint below;   // than which so many photons are nearer,
  uint upto;    // and no further than this; 0: not known yet
  uint within;  // photons no further than `upto`
  // Counting: three limits, and how many photons lie from `from` up to each; the rest is spare.
  // Listing: the nearest photons from `from` on.
  uint words[PPM_NEAREST_LIST];
};  // 48

// Rows of cells and photons that one dispatch of a long search visits at most for one hit point. On
// lavapipe all loops of the eight invocations that go in step take 65535 turns together, and each
// of these may have its photons where the others have none.
#define PPM_NEAREST_SLICE 2048
struct NearestPush {
  uint first, count;
  GridConstants grid;
  uint cursor_capacity;
  uint wanted;     // n
  uint max_depth;  // as in SceneConstants
};

// Beginning and deciding.
struct NearestStepPush {
  uint first, count;
  uint stride;   // hit points of SEARCH_ORDER of which one takes part
  float guess;   // of the squared radius; not positive: -guess times the one it has
  float spread;  // of that guess
  uint most;     // word of the largest squared radius
  uint wanted;
  uint round;
};

// Bins of the histogram of radii, half an octave of R^2 each, from 2^-64 on.
#define PPM_RADIUS_BINS 160

PPM_NAMESPACE_END

#ifdef __cplusplus
namespace ppm::shared {
static_assert(sizeof(BvhNode) == 64);
static_assert(sizeof(TrianglePositions) == 48);
static_assert(sizeof(TriangleShading) == 64);
static_assert(sizeof(TriangleDetail) == 16 * PPM_DETAIL_TEXELS);
static_assert(sizeof(TextureUse) == 16 * PPM_TEXTURE_USE_TEXELS);
static_assert(sizeof(MaterialRecord) == 16 * PPM_MATERIAL_TEXELS);
static_assert(sizeof(MediumRecord) == 16 * PPM_MEDIUM_TEXELS);
static_assert(sizeof(TextureRecord) == 16);
static_assert(sizeof(LightRecord) == 16 * PPM_LIGHT_TEXELS);
static_assert(sizeof(SceneConstants) == 148);
static_assert(sizeof(PhotonPath) == 52);
static_assert(sizeof(CameraPath) == 72);
static_assert(sizeof(BatchWords) == 4 * (4 + PPM_TRACE_ROUNDS + 1 + 2 * PPM_BATCH_LIMIT));
static_assert(sizeof(GridConstants) == 36);
static_assert(sizeof(EyePath) == 68);
static_assert(sizeof(HitPoint) == 80);
static_assert(sizeof(GatherSum) == 40);
static_assert(sizeof(NearestSearch) == 48);
}  // namespace ppm::shared
#endif

#endif  // PPM_SHARED_LAYOUT_H
