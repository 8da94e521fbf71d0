// One number for every buffer the kernels see, in descriptor set 0.
//
// A number names a buffer, not a descriptor type: a kernel declares it as a storage buffer where it
// writes and as a uniform texel buffer where it only reads (1.3-2 times faster on lavapipe). The
// host derives each kernel's set layout from its SPIR-V and binds buffers by these numbers.
#ifndef PPM_SHARED_BINDINGS_H
#define PPM_SHARED_BINDINGS_H

// The scene, written by the host.
#define PPM_BIND_SCENE_CONSTANTS 0     // uniform block SceneConstants
#define PPM_BIND_BVH_NODES 1           // BvhNode, 4 texels each
#define PPM_BIND_TRIANGLE_POSITIONS 2  // TrianglePositions, 3 texels each, leaf order
#define PPM_BIND_TRIANGLE_SHADING 3    // TriangleShading, 4 texels each, leaf order
#define PPM_BIND_MATERIALS 4           // MaterialRecord, PPM_MATERIAL_TEXELS each
#define PPM_BIND_TEXTURES 5            // TextureRecord, 1 texel each
#define PPM_BIND_TEXTURE_TEXELS 6      // colours, see TextureRecord
#define PPM_BIND_LIGHTS 7              // LightRecord, PPM_LIGHT_TEXELS each

// Counters and problems that the host reads back.
#define PPM_BIND_COUNTERS 8  // uint[PPM_COUNTER_COUNT]

// Photon pass.
#define PPM_BIND_PATHS_IN 9          // PhotonPath: those to be continued
#define PPM_BIND_PATHS_OUT 10        // PhotonPath: those that go on
#define PPM_BIND_PHOTON_POSITION 11  // uvec4: position, direction
#define PPM_BIND_PHOTON_FLUX 12      // uvec4: flux and depth, surface normal
#define PPM_BIND_SORTED_POSITION 13  // the same in cell order
#define PPM_BIND_SORTED_FLUX 14

// Counting sorts: photons by grid cell, hit points by pixel.
#define PPM_BIND_CELL_COUNT 15  // uint a cell
#define PPM_BIND_CELL_START 16  // uint a cell, one more at the end
#define PPM_BIND_SCAN_SUMS 17   // uint a chunk of the scan

// Eye pass.
#define PPM_BIND_EYE_IN 18    // EyePath
#define PPM_BIND_EYE_OUT 19   // EyePath
#define PPM_BIND_HIT_KEYS 20  // HitKey of each hit point
#define PPM_BIND_ARRIVALS 21  // uint: hit points of each (pixel, sample), as they were stored
#define PPM_BIND_ORDER 22     // uint: the same in canonical order

// A tile's hit points and their statistics.
#define PPM_BIND_HITS_0 23  // HitPoint, plane 0 .. 3: one uvec4 each
#define PPM_BIND_HITS_1 24
#define PPM_BIND_HITS_2 25
#define PPM_BIND_HITS_3 26
#define PPM_BIND_SAMPLE_START \
  27  // uint: first hit point of each (pixel, sample), one more at the end
#define PPM_BIND_STATISTICS 28     // vec4: lambda, radius squared
#define PPM_BIND_PHOTON_COUNTS 29  // uint: C, all photons ever accepted
#define PPM_BIND_GATHER_SUMS 30    // GatherSum
#define PPM_BIND_CONTINUE_IN 31   // GatherCursor: searches to be continued; pilot: uint, hit points
#define PPM_BIND_CONTINUE_OUT 32  // GatherCursor
#define PPM_BIND_PIXELS 33        // vec4: radiance of each pixel of the tile
#define PPM_BIND_RADIUS_HISTOGRAM 34  // uint[PPM_RADIUS_BINS]
#define PPM_BIND_SEARCH_ORDER 35      // uint: hit points, neighbours in space together
#define PPM_BIND_HITS_4 37            // HitPoint's fifth plane, where the scene has such lobes

// Batches of photon passes.
#define PPM_BIND_BATCH 36  // BatchWords

// Counts that become dispatches (shared/dispatch_counts.h).
#define PPM_BIND_DISPATCH_WORDS 38
#define PPM_BIND_DISPATCH_COMMANDS 39

// For tests' own kernels.
#define PPM_BIND_TEST_0 40
#define PPM_BIND_TEST_1 41
#define PPM_BIND_TEST_2 42
#define PPM_BIND_TEST_3 43

// What few scenes need; written by the host.
#define PPM_BIND_TRIANGLE_DETAILS 44  // TriangleDetail, PPM_DETAIL_TEXELS each, leaf order
#define PPM_BIND_TEXTURE_USES 45      // TextureUse, PPM_TEXTURE_USE_TEXELS each
#define PPM_BIND_MEDIA 46             // MediumRecord
#define PPM_BIND_LIGHT_MEDIA 47  // uint: media that each light starts in; at the end the camera
#define PPM_BIND_ENVIRONMENT 48  // uvec4 a texel: radiance, bin of the alias table

// The film of methods that add up samples (shared/film.h).
#define PPM_BIND_FILM_CONSTANTS 49  // uniform block FilmConstants
#define PPM_BIND_FILM_RED 50        // FilmSum a pixel
#define PPM_BIND_FILM_GREEN 51
#define PPM_BIND_FILM_BLUE 52

// Bidirectional path tracing (shared/bidirectional.h); its paths are PATHS_IN and PATHS_OUT.
#define PPM_BIND_LIGHT_VERTICES 60   // PathVertex, 4 texels each
#define PPM_BIND_CAMERA_VERTICES 61  // PathVertex, 4 texels each
#define PPM_BIND_LIGHT_HEADS 62      // uint a path: its light vertex that was stored last
#define PPM_BIND_VERTEX_PAIRS 63     // uvec2: a camera and a light vertex
#define PPM_BIND_LENS_SPLATS 64      // LensSplat of each light vertex

// Markov chains (shared/markov_chain.h).
#define PPM_BIND_CHAIN_WORDS 65   // uvec4: block by block, of each chain
#define PPM_BIND_CHAIN_STARTS 66  // uint: number of the sample that each chain starts with
#define PPM_BIND_CHAINS 67        // Chain
#define PPM_BIND_SPLATS_IN 68     // LensSplat: of the chains' states
#define PPM_BIND_SPLATS_OUT 69
#define PPM_BIND_SPLAT_COUNT 70  // uint
#define PPM_BIND_LUMINANCES 71   // float: of independent samples
#define PPM_BIND_CHAIN_RED 72    // FilmSum: of each chain's proposal
#define PPM_BIND_CHAIN_GREEN 73
#define PPM_BIND_CHAIN_BLUE 74

// Photon map.
#define PPM_BIND_NEAREST 53  // NearestSearch of each hit point of a tile

#define PPM_BINDING_LIMIT 80

// Specialisation constants that the device's profile sets in every kernel that declares them
// (host/gpu/device_profile.hpp). Kernels' own ones are below.
#define PPM_SPEC_WORKGROUP_SIZE 100    // invocations of a workgroup
#define PPM_SPEC_ALTERNATE_HALVES 101  // bool: see shaders/lib/invocation.glsl
#define PPM_SPEC_SUBGROUP_SIZE 102     // see shaders/lib/subgroup.glsl

// Buffers that are cut into segments (shaders/lib/texels.glsl): the texels of a segment as a power
// of two, and the number of segments of the buffer with each number.
#define PPM_SPEC_SEGMENT_SHIFT 127
#define PPM_SPEC_SEGMENTS 128  // + binding number
#define PPM_SEGMENTS 16        // of one buffer at most

// Those that the scene decides (shaders/lib/scene_kinds.glsl).
#define PPM_SPEC_ROUGH_GLOSS 110      // bool: some material has a rough glossy lobe
#define PPM_SPEC_TEXTURES 111         // bool: some material has a texture
#define PPM_SPEC_DETAILS 112          // bool: triangles have TRIANGLE_DETAILS
#define PPM_SPEC_COVERAGE 113         // bool: some material is not opaque (alphaMode)
#define PPM_SPEC_LAYERS 114           // bool: some material is a rough glass or has a clear coat
#define PPM_SPEC_DISPERSION 115       // bool: some glass disperses
#define PPM_SPEC_MEDIA 116            // bool: some material is solid
#define PPM_SPEC_ENVIRONMENT 117      // bool: there is an environment
#define PPM_SPEC_TEXTURED_LIGHTS 118  // bool: some triangle light has a texture or coverage

#endif  // PPM_SHARED_BINDINGS_H
