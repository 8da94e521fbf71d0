// Metropolis light transport in primary sample space [Kelemen et al. 2002]: Markov chains of the
// random numbers that bidirectional samples are made of.
//
// A state is the words that a sample asks for (PPM_CHAIN_BLOCKS blocks of four; those that it asks
// for beyond are drawn afresh each time, which is a symmetric proposal, too). A mutation moves each
// word a little, on a circle, or, with probability PPM_CHAIN_LARGE, draws all anew: a large step,
// whose samples are independent and tell the mean luminance b.
#ifndef PPM_SHARED_MARKOV_CHAIN_H
#define PPM_SHARED_MARKOV_CHAIN_H

#include "shared/geometry.h"
#include "shared/layout.h"
#include "shared/random.h"

PPM_NAMESPACE_BEGIN

// Blocks of light paths, then of camera paths: their starts and ten scattering events.
#define PPM_CHAIN_LIGHT_BLOCKS 12u
#define PPM_CHAIN_CAMERA_BLOCKS 31u
#define PPM_CHAIN_BLOCKS 43u
#define PPM_CHAIN_LARGE 0.3f

// What a path's words are.
#define PPM_CHAINS_SAMPLE 0u  // of an independent sample, by its number
#define PPM_CHAINS_START 1u   // of the sample that the chain starts with
#define PPM_CHAINS_MUTATE 2u  // of the chain's proposal

// Pass of the samples that chains may start with.
#define PPM_CHAINS_BOOTSTRAP 0xffffffffu

// A chain's current state but for its words.
struct Chain {
  vec3 value;  // what its camera path brings to the pixel
  uint pixel;
  float luminance;  // of the value and all splats, mean over channels
  uint splats, splat_count;
  // Sum over its large steps' luminances, compensated, and how many there were.
  float large_sum, large_compensation;
  uint large_steps;
};  // 40

struct ChainPush {
  uint first, count;
  uint pass;        // number of the step, RNG counter
  uint first_path;  // first chain of the tile
  uint phase;       // PPM_CHAINS_*
  uint chains;      // all
  uint splat_capacity;
  float normalisation;  // b
};                      // 32

// `word` moved by a distance between 2^-10 and 2^-6 of the circle, small ones more often: equally
// many in each octave, and as many to either side. fresh: uniform.
PPM_FN uint mutate_word(uint word, uint fresh) {
  float u = unit_from_word(fresh);
  uint distance = uint(67108864.0f * exp(-2.77258872f * u));  // 2^26 .. 2^22
  return (fresh & 1u) != 0u ? word + distance : word - distance;
}

PPM_FN uvec4 mutate_words(uvec4 words, uvec4 fresh) {
  return uvec4(mutate_word(words.x, fresh.x), mutate_word(words.y, fresh.y),
               mutate_word(words.z, fresh.z), mutate_word(words.w, fresh.w));
}

// The probability with which a proposal is accepted.
PPM_FN float chain_acceptance(float current, float proposed) {
  return current > 0.0f ? min(1.0f, proposed / current) : 1.0f;
}

// What a state of this luminance counts in the picture when it has been the chain's with
// probability `share`; a large step's proposal also stands for itself. In states that both large
// steps and the chain find the two are weighed by the balance heuristic.
PPM_FN float chain_weight(float share, float large, float luminance, float normalisation) {
  return luminance > 0.0f ? (share + large) / (luminance / normalisation + PPM_CHAIN_LARGE) : 0.0f;
}

PPM_NAMESPACE_END

#ifdef __cplusplus
namespace ppm::shared {
static_assert(sizeof(Chain) == 40);
static_assert(sizeof(ChainPush) == 32);
}  // namespace ppm::shared
#endif

#endif  // PPM_SHARED_MARKOV_CHAIN_H
