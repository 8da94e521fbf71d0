// Which media a path is in, where solids nest, touch and overlap: the priority stack of Schmidt and
// Budge: Simple Nested Dielectrics in Ray Traced Images (JGT 2002).
//
// Media are numbered from 1, the lower number outranking the higher; 0 is the air outside all. A
// path's media are one word: up to PPM_MEDIA_DEPTH numbers of a byte each, in order, the best rank
// in the low byte, 0 where there is none. The low byte is the medium that light travels in: where
// solids overlap it is the one of the best rank that counts. A medium may be in the word more than
// once: overlapping solids of one material are one solid.
#ifndef PPM_SHARED_MEDIA_H
#define PPM_SHARED_MEDIA_H

#include "shared/lang.h"

PPM_NAMESPACE_BEGIN

#define PPM_MEDIA_OUTSIDE 0u
#define PPM_MEDIA_DEPTH 4
#define PPM_MOST_MEDIA 255

// The medium that counts, 0 in air.
PPM_FN uint media_current(uint media) {
  return media & 0xffu;
}

// The media after entering a solid of `medium`. A fifth is dropped, the worst: light hardly gets
// there.
PPM_FN uint media_after_entering(uint media, uint medium) {
  uint a = media & 0xffu;
  uint b = (media >> 8u) & 0xffu;
  uint c = (media >> 16u) & 0xffu;
  uint d = media >> 24u;
  // Everything that is of a worse rank, or not there, moves up by a byte.
  uint keep = a != 0u && a <= medium ? 1u : 0u;
  keep += b != 0u && b <= medium ? 1u : 0u;
  keep += c != 0u && c <= medium ? 1u : 0u;
  keep += d != 0u && d <= medium ? 1u : 0u;
  if (keep == 4u) return media;
  uint below = (1u << (8u * keep)) - 1u;
  uint above = keep == 3u ? 0u : (media & ~below) << 8u;
  return (media & below) | (medium << (8u * keep)) | above;
}

PPM_FN bool media_contain(uint media, uint medium) {
  return (media & 0xffu) == medium || ((media >> 8u) & 0xffu) == medium ||
         ((media >> 16u) & 0xffu) == medium || (media >> 24u) == medium;
}

// The media after leaving a solid of `medium`: one of its entries goes. Nothing happens where there
// is none.
PPM_FN uint media_after_leaving(uint media, uint medium) {
  uint place = 4u;
  if ((media >> 24u) == medium) place = 3u;
  if (((media >> 16u) & 0xffu) == medium) place = 2u;
  if (((media >> 8u) & 0xffu) == medium) place = 1u;
  if ((media & 0xffu) == medium) place = 0u;
  if (place == 4u) return media;
  uint below = (1u << (8u * place)) - 1u;
  uint rest = place == 3u ? 0u : (media >> (8u * place + 8u)) << (8u * place);
  return (media & below) | rest;
}

// The two sides of a solid's surface that a path meets: `before` on its own side, `after` beyond.
struct MediaInterface {
  uint before, after;
};

// `front`: the path comes from outside of the solid. One that leaves a solid which it never entered
// (a surface that is not closed, a light that stands in it unnoticed, a fifth medium) is taken to
// have been in it.
PPM_FN MediaInterface media_interface(uint media, uint medium, bool front) {
  MediaInterface result;
  result.before = media;
  result.after = media_after_leaving(media, medium);
  if (front) result.after = media_after_entering(media, medium);
  if (!front && !media_contain(media, medium)) {
    result.before = media_after_entering(media, medium);
    result.after = media;
  }
  return result;
}

// Whether light notices the surface. It does not where a medium of a better rank, or the same one,
// is on both sides: there it goes straight on.
PPM_FN bool is_real_interface(MediaInterface sides) {
  return media_current(sides.before) != media_current(sides.after);
}

PPM_NAMESPACE_END

#endif  // PPM_SHARED_MEDIA_H
