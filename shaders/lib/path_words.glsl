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

// Of samples of pixels: the pass that a path belongs to and the number of its pixel. A quotient of numbers below 2^24,
// wrong by one at most before it is put right: integers are divided one lane after the other on lavapipe.
uvec2 pass_and_pixel(uint path) {
  uint number = push.first_path + path;
#ifdef PPM_WRITES_CHAINS
  return uvec2(push.pass, number);
#else
  uint pixels = scene.width * scene.height;
  uint pass = min(uint(int(float(int(number)) / float(int(pixels)))), push.passes - 1u);
  if (pass * pixels > number) pass -= 1u;
  if (pass + 1u < push.passes && (pass + 1u) * pixels <= number) pass += 1u;
  return uvec2(push.pass + pass, number - pass * pixels);
#endif
}

uvec4 path_words(uint stream, uint path, uint block) {
  if (kChains) return proposed_words(stream, push.first_path + path, block);
  uvec2 number = pass_and_pixel(path);
  return random_words(RandomStream(scene.seed, stream, number.x, number.y), block);
}

// The pixel that a camera path belongs to. Of chains, two words are a place within the whole picture; `rest` is what is
// left of them, a place within the pixel.
uvec2 path_pixel(uint path, uvec4 words, out uvec2 rest) {
  uvec2 pixel = uvec2(0u);
  rest = words.xy;
  if (kChains) {
    umulExtended(words.xy, uvec2(scene.width, scene.height), pixel, rest);
  } else {
    pixel = pixel_position(pass_and_pixel(path).y, scene.width, scene.height);
  }
  return pixel;
}

#endif
