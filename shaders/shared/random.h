// Random numbers: Philox4x32-10, counter based, and the one function that every random decision
// asks.
//
// Salmon, Moraes, Dror, Shaw: Parallel Random Numbers: As Easy as 1, 2, 3 (SC 2011). Known answers
// of the authors' library are a test.
#ifndef PPM_SHARED_RANDOM_H
#define PPM_SHARED_RANDOM_H

#include "shared/lang.h"

PPM_NAMESPACE_BEGIN

// Streams: who draws. A decision is named by (seed, stream, pass, path, dimension) and by nothing
// else.
#define PPM_STREAM_EYE 1u
#define PPM_STREAM_PHOTON 2u
#define PPM_STREAM_PILOT 3u
#define PPM_STREAM_PATH 4u
#define PPM_STREAM_LIGHT_PATH 16u
#define PPM_STREAM_CAMERA_PATH 17u
#define PPM_STREAM_CONNECTION 18u
#define PPM_STREAM_CHAIN 19u

PPM_FN uvec4 philox_4x32_10(uvec4 counter, uvec2 key) {
  for (int round_index = 0; round_index < 10; ++round_index) {
    uint high0, low0, high1, low1;
    umulExtended(0xD2511F53u, counter.x, high0, low0);
    umulExtended(0xCD9E8D57u, counter.z, high1, low1);
    counter = uvec4(high1 ^ counter.y ^ key.x, low1, high0 ^ counter.w ^ key.y, low0);
    key = uvec2(key.x + 0x9E3779B9u, key.y + 0xBB67AE85u);
  }
  return counter;
}

struct RandomStream {
  uint seed;
  uint stream;  // PPM_STREAM_*
  uint pass;
  uint path;
};

// Four random words for dimensions 4 * block .. 4 * block + 3 of a path.
PPM_FN uvec4 random_words(RandomStream stream, uint block) {
  return philox_4x32_10(uvec4(stream.path, stream.pass, block, 0u),
                        uvec2(stream.seed, stream.stream));
}

// A word from two: for decisions that are named by more than a block. Rounds of multiplication and
// shift with full avalanche (lowbias32 of Wellons's hash prospector).
PPM_FN uint hash_word(uint x) {
  x = (x ^ (x >> 16u)) * 0x7feb352du;
  x = (x ^ (x >> 15u)) * 0x846ca68bu;
  return x ^ (x >> 16u);
}
PPM_FN uint hash_words(uint key, uint number) {
  return hash_word(key ^ hash_word(number + 0x9e3779b9u));
}

// Uniform in [0, 1): 24 bits, so that 1 is never reached.
PPM_FN float unit_from_word(uint word) {
  return float(word >> 8u) * 5.9604644775390625e-8f;
}

PPM_FN vec4 random_units(RandomStream stream, uint block) {
  uvec4 words = random_words(stream, block);
  return vec4(unit_from_word(words.x), unit_from_word(words.y), unit_from_word(words.z),
              unit_from_word(words.w));
}

// Uniform integer in [0, count) from a whole 32-bit word.
PPM_FN uint index_from_word(uint word, uint count) {
  uint high, low;
  umulExtended(word, count, high, low);
  return high;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_RANDOM_H
