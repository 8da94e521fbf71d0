// Texture lookups by hand, so that all devices filter alike and no descriptor indexing is needed.
#ifndef PPM_LIB_TEXTURE_GLSL
#define PPM_LIB_TEXTURE_GLSL

#include "lib/texels.glsl"
#include "shared/layout.h"

PPM_TEXELS(PPM_BIND_TEXTURES, textures);
PPM_TEXELS(PPM_BIND_TEXTURE_TEXELS, texture_texels);
PPM_TEXELS(PPM_BIND_TEXTURE_USES, texture_uses);

vec4 fetch_color(uint index) {
  uvec4 pair = PPM_FETCH(texture_texels, index / 2u);
  uvec2 halves = (index & 1u) == 0u ? pair.xy : pair.zw;
  return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y));
}

// Wrap modes as in scene.hpp: 0 repeat, 1 clamp to edge, 2 mirrored repeat.
uint wrap_coordinate(int coordinate, int size, uint mode) {
  if (mode == 1u) return uint(clamp(coordinate, 0, size - 1));
  int period = mode == 2u ? 2 * size : size;
  int wrapped = coordinate % period;
  if (wrapped < 0) wrapped += period;
  return uint(wrapped < size ? wrapped : period - 1 - wrapped);
}

vec4 sample_texture(uint texture_index, vec2 texcoord) {
  uvec4 record = PPM_FETCH(textures, texture_index);
  ivec2 size = ivec2(record.xy);
  uint mode_s = record.w & 3u;
  uint mode_t = (record.w >> 2u) & 3u;
  // Whole periods are taken off first (two, for mirrored ones), so that far coordinates keep their digits.
  vec2 periods = 2.0 * floor(0.5 * texcoord);
  if (mode_s != 1u) texcoord.x -= periods.x;
  if (mode_t != 1u) texcoord.y -= periods.y;
  vec2 position = clamp(texcoord, vec2(-4.0), vec2(4.0)) * vec2(size);
  bool nearest = (record.w & 16u) != 0u;
  if (!nearest) position -= 0.5;
  vec2 cell = floor(position);
  ivec2 low = ivec2(cell);
  uint x0 = wrap_coordinate(low.x, size.x, mode_s);
  uint y0 = wrap_coordinate(low.y, size.y, mode_t);
  if (nearest) return fetch_color(record.z + y0 * record.x + x0);
  uint x1 = wrap_coordinate(low.x + 1, size.x, mode_s);
  uint y1 = wrap_coordinate(low.y + 1, size.y, mode_t);
  vec2 f = position - cell;
  vec4 top = mix(fetch_color(record.z + y0 * record.x + x0), fetch_color(record.z + y0 * record.x + x1), f.x);
  vec4 bottom = mix(fetch_color(record.z + y1 * record.x + x0), fetch_color(record.z + y1 * record.x + x1), f.x);
  return mix(top, bottom, f.y);
}

// Both sets of texture coordinates at a point.
struct Texcoords {
  vec2 set0, set1;
};

// The texture that a material uses as `which` (PPM_USE_*), or `otherwise` where it has none.
vec4 sample_use(uint first_use, uint use_mask, uint which, Texcoords texcoords, vec4 otherwise) {
  if ((use_mask & which) == 0u) return otherwise;
  uint use = first_use + uint(bitCount(use_mask & (which - 1u)));
  uvec4 a = PPM_FETCH(texture_uses, PPM_TEXTURE_USE_TEXELS * use);
  uvec4 b = PPM_FETCH(texture_uses, PPM_TEXTURE_USE_TEXELS * use + 1u);
  vec3 uv1 = vec3((a.w & PPM_SECOND_TEXCOORD) != 0u ? texcoords.set1 : texcoords.set0, 1.0);
  vec2 place = vec2(dot(uintBitsToFloat(a.xyz), uv1), dot(uintBitsToFloat(b.xyz), uv1));
  return sample_texture(a.w & ~PPM_SECOND_TEXCOORD, place);
}

#endif
