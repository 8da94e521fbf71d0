// The scene as bound buffers.
#ifndef PPM_LIB_SCENE_GLSL
#define PPM_LIB_SCENE_GLSL

#include "lib/texels.glsl"
#include "shared/layout.h"

layout(binding = PPM_BIND_SCENE_CONSTANTS, scalar) uniform SceneBlock { SceneConstants scene; };
PPM_SEGMENTED_TEXELS(PPM_BIND_BVH_NODES, bvh_nodes);
PPM_SEGMENTED_TEXELS(PPM_BIND_TRIANGLE_POSITIONS, triangle_positions);
PPM_TEXELS(PPM_BIND_MATERIALS, materials);

struct TriangleCorners {
  vec3 corner0, corner1, corner2;
  uint material;
};

TriangleCorners fetch_triangle(uint slot) {
  uvec4 a = PPM_FETCH_SEGMENTED(triangle_positions, 3u * slot);
  uvec4 b = PPM_FETCH_SEGMENTED(triangle_positions, 3u * slot + 1u);
  uvec4 c = PPM_FETCH_SEGMENTED(triangle_positions, 3u * slot + 2u);
  return TriangleCorners(uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz), uintBitsToFloat(c.xyz), a.w);
}

MaterialRecord fetch_material(uint index) {
  uvec4 a = PPM_FETCH(materials, PPM_MATERIAL_TEXELS * index);
  uvec4 b = PPM_FETCH(materials, PPM_MATERIAL_TEXELS * index + 1u);
  uvec4 c = PPM_FETCH(materials, PPM_MATERIAL_TEXELS * index + 2u);
  uvec4 d = PPM_FETCH(materials, PPM_MATERIAL_TEXELS * index + 3u);
  uvec4 e = PPM_FETCH(materials, PPM_MATERIAL_TEXELS * index + 4u);
  uvec4 f = PPM_FETCH(materials, PPM_MATERIAL_TEXELS * index + 5u);
  return MaterialRecord(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.x), uintBitsToFloat(b.y),
                        uintBitsToFloat(b.z), uintBitsToFloat(b.w), uintBitsToFloat(c.xyz),
                        uintBitsToFloat(c.w), uintBitsToFloat(d.xyz), d.w, uintBitsToFloat(e.x),
                        uintBitsToFloat(e.y), uintBitsToFloat(e.z), e.w, uintBitsToFloat(f.x),
                        uintBitsToFloat(f.y), f.z, f.w);
}

#endif
