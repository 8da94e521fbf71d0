// Every record that passes hand on, from the host to kernels or from kernel to kernel; what they
// know of the scene is in scene_records.h. Scalar block layout; sizes in bytes are asserted on the
// host.
#ifndef PPM_SHARED_LAYOUT_H
#define PPM_SHARED_LAYOUT_H

#include "shared/lang.h"
#include "shared/scene_records.h"

// Invocations of a workgroup unless the device's profile says otherwise.
#define PPM_WORKGROUP_SIZE 64

PPM_NAMESPACE_BEGIN

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
