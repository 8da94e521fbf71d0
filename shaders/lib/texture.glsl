// Texture lookups by hand, so that all devices filter alike and no descriptor indexing is needed.
#ifndef PPM_LIB_TEXTURE_GLSL
#define PPM_LIB_TEXTURE_GLSL

#include "lib/texels.glsl"
#include "shared/layout.h"
#include "shared/srgb.h"

PPM_TEXELS(PPM_BIND_TEXTURES, textures);
PPM_SEGMENTED_TEXELS(PPM_BIND_TEXTURE_TEXELS, texture_texels);
PPM_TEXELS(PPM_BIND_TEXTURE_USES, texture_uses);

// The colour of a texel in linear light. `first` and `sampling` are the texture's.
vec4 fetch_color(uint first, uint sampling, uint index) {
  bool halves = (sampling & PPM_TEXTURE_HALVES) != 0u;
  uvec4 quad = PPM_FETCH_SEGMENTED(texture_texels, first + (index >> (halves ? 1u : 2u)));
  uvec2 pair = (index & (halves ? 1u : 2u)) != 0u ? quad.zw : quad.xy;
  vec4 code = unpackUnorm4x8((index & 1u) != 0u ? pair.y : pair.x);
  vec3 linear = vec3(srgb_to_linear(code.r), srgb_to_linear(code.g), srgb_to_linear(code.b));
  code.rgb = (sampling & PPM_TEXTURE_SRGB) != 0u ? linear : code.rgb;
  return halves ? vec4(unpackHalf2x16(pair.x), unpackHalf2x16(pair.y)) : code;
}

// Wrap modes as in scene.hpp: 0 repeat, 1 clamp to edge, 2 mirrored repeat.
uint wrap_coordinate(int coordinate, int size, uint mode) {
  if (mode == 1u) return uint(clamp(coordinate, 0, size - 1));
  int period = mode == 2u ? 2 * size : size;
  int wrapped = coordinate % period;
  if (wrapped < 0) wrapped += period;
  return uint(wrapped < size ? wrapped : period - 1 - wrapped);
}

// Filtered after decoding, as glTF wants it.
vec4 sample_texture(uint texture_index, vec2 texcoord) {
  uvec4 record = PPM_FETCH(textures, texture_index);
  ivec2 size = ivec2(record.xy);
  uint first = record.z;
  uint sampling = record.w;
  uint mode_s = sampling & 3u;
  uint mode_t = (sampling >> 2u) & 3u;
  // Whole periods are taken off first (two, for mirrored ones), so that far coordinates keep their digits.
  vec2 periods = 2.0 * floor(0.5 * texcoord);
  if (mode_s != 1u) texcoord.x -= periods.x;
  if (mode_t != 1u) texcoord.y -= periods.y;
  vec2 position = clamp(texcoord, vec2(-4.0), vec2(4.0)) * vec2(size);
  bool nearest = (sampling & PPM_TEXTURE_NEAREST) != 0u;
  if (!nearest) position -= 0.5;
  vec2 cell = floor(position);
  vec2 f = nearest ? vec2(0.0) : position - cell;
  ivec2 low = ivec2(cell);
  uint x0 = wrap_coordinate(low.x, size.x, mode_s);
  uint x1 = wrap_coordinate(low.x + 1, size.x, mode_s);
  uint row0 = record.x * wrap_coordinate(low.y, size.y, mode_t);
  uint row1 = record.x * wrap_coordinate(low.y + 1, size.y, mode_t);
  vec4 top = mix(fetch_color(first, sampling, row0 + x0), fetch_color(first, sampling, row0 + x1), f.x);
  vec4 bottom = mix(fetch_color(first, sampling, row1 + x0), fetch_color(first, sampling, row1 + x1), f.x);
  return mix(top, bottom, f.y);
}

// Both sets of texture coordinates at a point.
struct Texcoords {
  vec2 set0, set1;
};

// A use of TEXTURE_USES.
vec4 sample_use(uint use, Texcoords texcoords) {
  uvec4 a = PPM_FETCH(texture_uses, PPM_TEXTURE_USE_TEXELS * use);
  uvec4 b = PPM_FETCH(texture_uses, PPM_TEXTURE_USE_TEXELS * use + 1u);
  vec3 uv1 = vec3((a.w & PPM_SECOND_TEXCOORD) != 0u ? texcoords.set1 : texcoords.set0, 1.0);
  vec2 place = vec2(dot(uintBitsToFloat(a.xyz), uv1), dot(uintBitsToFloat(b.xyz), uv1));
  return sample_texture(a.w & ~PPM_SECOND_TEXCOORD, place);
}

// The texture that a material uses as `which` (PPM_USE_*), or ones where it has none.
vec4 sample_use(uint first_use, uint use_mask, uint which, Texcoords texcoords) {
  if ((use_mask & which) == 0u) return vec4(1.0);
  return sample_use(first_use + uint(bitCount(use_mask & (which - 1u))), texcoords);
}

#endif
