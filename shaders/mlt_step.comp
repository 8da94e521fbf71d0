// Markov chains of bidirectional samples: one invocation decides about one chain's proposal, whose light the sampler has
// added up in CHAIN_RED, _GREEN and _BLUE and in LENS_SPLATS. Adds proposal and current state to the film by what they
// count, and moves the chain: CHAIN_WORDS, CHAINS, SPLATS_IN to SPLATS_OUT. Of independent samples it writes LUMINANCES.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "lib/invocation.glsl"

#define PPM_WRITES_CHAINS
#include "lib/film.glsl"
#include "shared/bidirectional.h"
#include "shared/camera.h"
#include "shared/markov_chain.h"

layout(push_constant, scalar) uniform PushBlock { ChainPush push; };
#include "lib/path_words.glsl"

PPM_TEXELS(PPM_BIND_LIGHT_VERTICES, light_vertices);
PPM_TEXELS(PPM_BIND_LENS_SPLATS, lens_splats);
PPM_TEXELS(PPM_BIND_SPLATS_IN, splats_in);
layout(binding = PPM_BIND_LIGHT_HEADS, scalar) readonly buffer LightHeads { uint light_heads[]; };
layout(binding = PPM_BIND_CHAINS, scalar) buffer Chains { Chain chains[]; };
layout(binding = PPM_BIND_SPLATS_OUT, scalar) writeonly buffer SplatsOut { LensSplat splats_out[]; };
layout(binding = PPM_BIND_SPLAT_COUNT, scalar) buffer SplatCount { uint splat_count; };
layout(binding = PPM_BIND_LUMINANCES, scalar) writeonly buffer Luminances { float luminances[]; };
layout(binding = PPM_BIND_CHAIN_RED, scalar) buffer ChainRed { FilmSum chain_red[]; };
layout(binding = PPM_BIND_CHAIN_GREEN, scalar) buffer ChainGreen { FilmSum chain_green[]; };
layout(binding = PPM_BIND_CHAIN_BLUE, scalar) buffer ChainBlue { FilmSum chain_blue[]; };

float value_of(FilmSum sum) {
  return float(sum.low) + 4294967296.0 * (float(sum.high) + 4294967296.0 * float(sum.top));
}

// What the camera path's ways have brought; the sums begin anew.
vec3 take_value(uint path) {
  vec3 value = vec3(value_of(chain_red[path]), value_of(chain_green[path]), value_of(chain_blue[path])) / film.scale;
  chain_red[path] = chain_green[path] = chain_blue[path] = FilmSum(0u, 0u, 0u);
  return value;
}

LensSplat splat_from(uvec4 texel) { return LensSplat(uintBitsToFloat(texel.xyz), texel.w); }

// The next light vertex of the path, from `vertex` on, through which light came; PPM_BDPT_NONE if there is none.
uint next_splat(uint vertex) {
  if (vertex == PPM_BDPT_NONE) return vertex;
  bool dark;
  do {
    dark = max_component(splat_from(PPM_FETCH(lens_splats, vertex)).value) <= 0.0;
    if (dark) vertex = PPM_FETCH(light_vertices, 4u * vertex + 3u).z;
  } while (dark && vertex != PPM_BDPT_NONE);
  return vertex;
}
uint after(uint vertex) { return next_splat(PPM_FETCH(light_vertices, 4u * vertex + 3u).z); }

void add(uint pixel, vec3 value, float weight) {
  if (weight > 0.0 && max_component(value) > 0.0) film_add(pixel, value * weight);
}

void keep(uint slot, LensSplat splat) {
  if (slot < push.splat_capacity) splats_out[slot] = splat;
}

void main() {
  uint path = item_of_invocation(push.first);
  if (path >= push.first + push.count) return;
  uint chain = push.first_path + path;
  Chain proposal;
  proposal.value = take_value(path);
  proposal.luminance = mean_component(proposal.value);
  proposal.splat_count = 0u;
  uint first = next_splat(light_heads[path]);
  for (uint vertex = first; vertex != PPM_BDPT_NONE; vertex = after(vertex)) {
    proposal.luminance += mean_component(splat_from(PPM_FETCH(lens_splats, vertex)).value);
    proposal.splat_count += 1u;
  }
  if (push.phase == PPM_CHAINS_SAMPLE) {
    luminances[chain] = proposal.luminance;
    return;
  }
  proposal.pixel = 0u;
  uvec2 unused;
  uvec2 pixel = path_pixel(path, path_words(PPM_STREAM_CAMERA_PATH, path, 0u), unused);
  proposal.pixel = pixel.y * scene.width + pixel.x;
  proposal.large_sum = proposal.large_compensation = 0.0;
  proposal.large_steps = 0u;

  bool accepted = true;
  Chain current = proposal;
  current.splat_count = 0u;
  float current_weight = 0.0, proposal_weight = 0.0;
  if (push.phase == PPM_CHAINS_MUTATE) {
    current = chains[chain];
    uvec2 choice = chain_choice(chain);
    float large = unit_from_word(choice.x) < PPM_CHAIN_LARGE ? 1.0 : 0.0;
    float acceptance = chain_acceptance(current.luminance, proposal.luminance);
    accepted = unit_from_word(choice.y) < acceptance;
    current_weight = chain_weight(1.0 - acceptance, 0.0, current.luminance, push.normalisation);
    proposal_weight = chain_weight(acceptance, large, proposal.luminance, push.normalisation);
    precise float term = large * proposal.luminance - current.large_compensation;
    precise float sum = current.large_sum + term;
    precise float compensation = (sum - current.large_sum) - term;
    proposal.large_sum = current.large_sum = sum;
    proposal.large_compensation = current.large_compensation = compensation;
    proposal.large_steps = current.large_steps = current.large_steps + uint(large);
  }
  uint kept = accepted ? proposal.splat_count : current.splat_count;
  uint slot = kept > 0u ? atomicAdd(splat_count, kept) : 0u;
  uint next = slot;
  add(proposal.pixel, proposal.value, proposal_weight);
  for (uint vertex = first; vertex != PPM_BDPT_NONE; vertex = after(vertex)) {
    LensSplat splat = splat_from(PPM_FETCH(lens_splats, vertex));
    add(splat.pixel, splat.value, proposal_weight);
    if (accepted) keep(next++, splat);
  }
  add(current.pixel, current.value, current_weight);
  for (uint i = 0u; i < current.splat_count; ++i) {
    LensSplat splat = splat_from(PPM_FETCH(splats_in, current.splats + i));
    add(splat.pixel, splat.value, current_weight);
    if (!accepted) keep(next++, splat);
  }
  if (accepted) {
    for (uint block = 0u; block < PPM_CHAIN_BLOCKS; ++block) {
      bool light = block < PPM_CHAIN_LIGHT_BLOCKS;
      uint stream = light ? PPM_STREAM_LIGHT_PATH : PPM_STREAM_CAMERA_PATH;
      chain_words[block * push.chains + chain] =
          proposed_words(stream, chain, light ? block : block - PPM_CHAIN_LIGHT_BLOCKS);
    }
    current = proposal;
  }
  current.splats = slot;
  chains[chain] = current;
}
