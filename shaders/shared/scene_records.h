// The scene as kernels read it: tree, triangles, materials, media, textures, lights, camera. Scalar
// block layout; sizes in bytes are asserted on the host.
#ifndef PPM_SHARED_SCENE_RECORDS_H
#define PPM_SHARED_SCENE_RECORDS_H

#include "shared/lang.h"

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
  float clearcoat, clearcoat_roughness;
  uint medium;  // 1 + index in MEDIA, 0 where nothing gets inside
  uint spare;
};  // 96

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
}  // namespace ppm::shared
#endif

#endif  // PPM_SHARED_SCENE_RECORDS_H
