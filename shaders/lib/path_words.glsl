// The random words of a path: a function of its number, or of a Markov chain's state. The includer declares `push`, with
// pass, first_path, phase and chains.
#ifndef PPM_LIB_PATH_WORDS_GLSL
#define PPM_LIB_PATH_WORDS_GLSL

#include "lib/scene.glsl"
#include "shared/markov_chain.h"

#ifdef PPM_WRITES_CHAINS
const bool kChains = true;
#else
layout(constant_id = 1) const bool kChains = false;
#endif

#ifdef PPM_WRITES_CHAINS  // the kernel that moves them
layout(binding = PPM_BIND_CHAIN_WORDS, scalar) buffer ChainWords { uvec4 chain_words[]; };
#define PPM_CHAIN_WORDS(index) chain_words[index]
#else
PPM_TEXELS(PPM_BIND_CHAIN_WORDS, chain_words);
#define PPM_CHAIN_WORDS(index) PPM_FETCH(chain_words, index)
#endif
PPM_TEXELS(PPM_BIND_CHAIN_STARTS, chain_starts);

// Whether a chain's proposal is a large step (x), and what decides about it (y).
uvec2 chain_choice(uint chain) {
  return random_words(RandomStream(scene.seed, PPM_STREAM_CHAIN, push.pass, chain), 0u).xy;
}
bool is_large_step(uint chain) { return unit_from_word(chain_choice(chain).x) < PPM_CHAIN_LARGE; }

// Where a chain's state keeps a block, PPM_CHAIN_BLOCKS if it does not.
uint chain_slot(uint stream, uint block) {
  bool light = stream == PPM_STREAM_LIGHT_PATH;
  bool kept = light ? block < PPM_CHAIN_LIGHT_BLOCKS
                    : stream == PPM_STREAM_CAMERA_PATH && block < PPM_CHAIN_CAMERA_BLOCKS;
  return kept ? (light ? block : PPM_CHAIN_LIGHT_BLOCKS + block) : PPM_CHAIN_BLOCKS;
}

uvec4 proposed_words(uint stream, uint chain, uint block) {
  if (push.phase != PPM_CHAINS_MUTATE) {
    uint number = chain;
    if (push.phase == PPM_CHAINS_START) number = PPM_FETCH(chain_starts, chain / 4u)[chain % 4u];
    return random_words(RandomStream(scene.seed, stream, PPM_CHAINS_BOOTSTRAP, number), block);
  }
  uvec4 fresh = random_words(RandomStream(scene.seed, stream, push.pass, chain), block);
  uint slot = chain_slot(stream, block);
  if (slot == PPM_CHAIN_BLOCKS || is_large_step(chain)) return fresh;
  return mutate_words(PPM_CHAIN_WORDS(slot * push.chains + chain), fresh);
}

uvec4 path_words(uint stream, uint path, uint block) {
  uint number = push.first_path + path;
  if (kChains) return proposed_words(stream, number, block);
  return random_words(RandomStream(scene.seed, stream, push.pass, number), block);
}

// The pixel that a camera path belongs to. Of chains, two words are a place within the whole picture; `rest` is what is
// left of them, a place within the pixel.
uvec2 path_pixel(uint path, uvec4 words, out uvec2 rest) {
  uvec2 pixel = uvec2(0u);
  rest = words.xy;
  if (kChains) {
    umulExtended(words.xy, uvec2(scene.width, scene.height), pixel, rest);
  } else {
    pixel = pixel_position(push.first_path + path, scene.width, scene.height);
  }
  return pixel;
}

#endif
