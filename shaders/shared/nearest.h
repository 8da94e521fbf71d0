// Which photon is the n-th nearest that counts at a hit point [HOJ08 Eq. 1], found by counting.
//
// Counts are integers, so that neither the order of photons nor their division into grids and
// dispatches matters, and the result is the very distance that a sort would give. Squares of
// distances are handled as the words of their floats, which order as the numbers do. Each round
// counts the photons up to three limits and keeps the interval that holds the n-th; once few are
// wanted of an interval they are listed.
#ifndef PPM_SHARED_NEAREST_H
#define PPM_SHARED_NEAREST_H

#include "shared/layout.h"

PPM_NAMESPACE_BEGIN

// The word of a squared distance. Below 2^-40 (a millionth of the working frame, about what
// positions are rounded to) all count as that: a disc has an area.
#define PPM_NEAREST_LEAST 0x2b800000u
PPM_FN uint nearest_word(float distance2) {
  return max(floatBitsToUint(distance2), PPM_NEAREST_LEAST);
}

// Whether the next photons are to be listed rather than counted.
PPM_FN bool nearest_lists(NearestSearch search, uint wanted) {
  return search.upto != 0u && wanted - search.below <= uint(PPM_NEAREST_LIST);
}

// No photon further than this matters to the round.
PPM_FN uint nearest_reach(NearestSearch search, uint wanted) {
  return nearest_lists(search, wanted) ? search.upto : search.words[2];
}

// What a round starts with.
PPM_FN void nearest_clear(PPM_INOUT(NearestSearch) search, uint wanted) {
  if (nearest_lists(search, wanted)) {
    for (uint i = 0u; i < uint(PPM_NEAREST_LIST); ++i) search.words[i] = 0xffffffffu;
  } else {
    for (uint i = 3u; i < 6u; ++i) search.words[i] = 0u;
  }
}

PPM_FN uint nearest_limit(float distance2, uint least, uint most) {
  return clamp(floatBitsToUint(distance2), least, most);
}

// A search that knows nothing; the square of the radius is likely to lie within a factor of
// `spread` around `guess`. most: the word of the largest there is, at least that of `guess`.
PPM_FN NearestSearch nearest_begin(float guess, float spread, uint most) {
  NearestSearch search;
  search.from = PPM_NEAREST_LEAST;
  search.below = 0u;
  search.upto = 0u;
  search.within = 0u;
  search.words[0] = nearest_limit(guess / spread, search.from, most);
  search.words[1] = nearest_limit(guess, search.from, most);
  search.words[2] = nearest_limit(guess * spread, search.from, most);
  for (uint i = 3u; i < uint(PPM_NEAREST_LIST); ++i) search.words[i] = 0u;
  return search;
}

// Limits beyond what has been counted, where fewer than wanted were found so far.
PPM_FN void nearest_grow(PPM_INOUT(NearestSearch) search, uint wanted, uint most, uint round) {
  float reached = uintBitsToFloat(search.from);
  float known = float(search.below);
  // On a surface the number grows as the square of the radius does; what was counted tells how fast
  // but for its own deviation, which is the square root. Where light ends it tells nothing: later
  // rounds take longer strides.
  float margin = search.below == 0u ? 4.0f : 1.0f + 2.0f / sqrt(known) + 0.25f * float(round);
  float growth = search.below == 0u ? 16.0f : clamp(float(wanted) / known, 1.0f, 64.0f);
  search.words[0] = nearest_limit(reached * max(growth / margin, 1.0f), search.from, most);
  search.words[1] = nearest_limit(reached * growth, search.from, most);
  search.words[2] = nearest_limit(reached * growth * margin, search.from, most);
}

// Limits within the interval that holds the wanted photon.
PPM_FN void nearest_narrow(PPM_INOUT(NearestSearch) search, uint wanted, uint round) {
  uint last = search.upto - 1u;
  if (round % 4u == 3u) {  // sure to end, wherever photons lie
    uint quarter = (last - search.from) / 4u;
    search.words[0] = search.from + quarter;
    search.words[1] = search.from + 2u * quarter;
    search.words[2] = last - quarter;
    return;
  }
  // As if photons were spread evenly: their number up to a place is then binomial. The aim is to
  // leave half a list below the wanted one.
  float begin = uintBitsToFloat(search.from), end = uintBitsToFloat(search.upto);
  float inside = float(search.within - search.below), place = float(wanted - search.below);
  float deviation = sqrt(max(place * (1.0f - place / inside), 0.0f));
  float step = max(1.5f * deviation, 0.5f * float(PPM_NEAREST_LIST));
  float aim = place - 0.5f - 0.5f * float(PPM_NEAREST_LIST);
  float scale = (end - begin) / inside;
  search.words[0] = nearest_limit(begin + scale * max(aim - step, 0.0f), search.from, last);
  search.words[1] = nearest_limit(begin + scale * clamp(aim, 0.0f, inside), search.from, last);
  search.words[2] = nearest_limit(begin + scale * min(aim + step, inside), search.from, last);
}

// What a round's counts tell. Returns the word of the n-th nearest photon's squared distance once
// it is known, or `most` where fewer than `wanted` are nearer than that; 0: another round must be
// made. round: how many were made before.
PPM_FN uint nearest_decide(PPM_INOUT(NearestSearch) search, uint wanted, uint most, uint round) {
  if (nearest_lists(search, wanted)) return search.words[wanted - search.below - 1u];
  uint below = search.below;
  for (uint i = 0u; i < 3u; ++i) {
    uint limit = search.words[i], count = below + search.words[3u + i];
    if (count < wanted) {
      search.from = limit + 1u;
      search.below = count;
    } else if (search.upto == 0u || limit < search.upto) {
      search.upto = limit;
      search.within = count;
    }
  }
  if (search.upto == 0u) {
    if (search.from > most) return most;
    nearest_grow(search, wanted, most, round);
  } else {
    if (search.from >= search.upto) return search.upto;  // only photons at one distance are left
    if (!nearest_lists(search, wanted)) nearest_narrow(search, wanted, round);
  }
  nearest_clear(search, wanted);
  return 0u;
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_NEAREST_H
