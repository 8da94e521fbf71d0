// shared/media.h against sorted lists of numbers, which have no limit.
#include "shared/media.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "chi_squared.hpp"

namespace ppm::shared {
namespace {

using List = std::vector<uint>;

uint word_of(const List& list) {
  uint word = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(list.size(), PPM_MEDIA_DEPTH); ++i) {
    word |= list[i] << (8 * i);
  }
  return word;
}

// Every walk of entering and leaving that four media allow, the numbers at both ends of a byte too.
TEST(Media, AreASortedList) {
  statistics::Units units(401);
  const List numbers{1, 2, 127, 128, 254, 255};
  List inside;
  uint media = PPM_MEDIA_OUTSIDE;
  int deepest = 0;
  for (int step = 0; step < 200000; ++step) {
    const uint medium = numbers[units.word() % numbers.size()];
    const bool leave = inside.size() == PPM_MEDIA_DEPTH || units.next() < 0.5f;
    const auto at = std::find(inside.begin(), inside.end(), medium);
    ASSERT_EQ(media_contain(media, medium), at != inside.end());
    if (leave) {
      media = media_after_leaving(media, medium);
      if (at != inside.end()) inside.erase(at);
    } else {
      media = media_after_entering(media, medium);
      inside.insert(std::upper_bound(inside.begin(), inside.end(), medium), medium);
    }
    deepest = std::max(deepest, static_cast<int>(inside.size()));
    ASSERT_EQ(media, word_of(inside));
    ASSERT_EQ(media_current(media), inside.empty() ? PPM_MEDIA_OUTSIDE : inside.front());
  }
  EXPECT_EQ(deepest, PPM_MEDIA_DEPTH);
}

TEST(Media, TheWorstOfFiveIsDropped) {
  EXPECT_EQ(media_after_entering(word_of({2, 3, 5, 7}), 4), word_of({2, 3, 4, 5}));
  EXPECT_EQ(media_after_entering(word_of({2, 3, 5, 7}), 1), word_of({1, 2, 3, 5}));
  EXPECT_EQ(media_after_entering(word_of({2, 3, 5, 7}), 255), word_of({2, 3, 5, 7}));
  EXPECT_EQ(media_after_entering(word_of({2, 3, 5, 7}), 7), word_of({2, 3, 5, 7}));
}

struct Crossing {
  const char* what;
  List media;
  uint medium;
  bool front;
  List before, after;
  bool real;
};

TEST(Media, Interfaces) {
  const std::vector<Crossing> crossings{
      {"air to glass", {}, 1, true, {}, {1}, true},
      {"glass to air", {1}, 1, false, {1}, {}, true},
      {"into an outranked liquid", {1}, 2, true, {1}, {1, 2}, false},
      {"glass to the liquid that overlaps it", {1, 2}, 1, false, {1, 2}, {2}, true},
      {"liquid to glass", {2}, 1, true, {2}, {1, 2}, true},
      {"out of an outranked liquid", {1, 2}, 2, false, {1, 2}, {1}, false},
      {"two spheres of one glass", {1}, 1, true, {1}, {1, 1}, false},
      {"out of the first", {1, 1}, 1, false, {1, 1}, {1}, false},
      {"a bubble with its normals turned in", {1}, 1, false, {1}, {}, true},
      {"out of the bubble", {}, 1, true, {}, {1}, true},
      {"out of what was never entered", {}, 3, false, {3}, {}, true},
      {"the same within an outranking medium", {1}, 3, false, {1, 3}, {1}, false},
  };
  for (const Crossing& row : crossings) {
    const MediaInterface sides = media_interface(word_of(row.media), row.medium, row.front);
    EXPECT_EQ(sides.before, word_of(row.before)) << row.what;
    EXPECT_EQ(sides.after, word_of(row.after)) << row.what;
    EXPECT_EQ(is_real_interface(sides), row.real) << row.what;
  }
}

// Whatever is crossed comes back the same way, which is what makes photons and eye paths agree.
TEST(Media, InterfacesAreSymmetric) {
  statistics::Units units(402);
  for (int i = 0; i < 20000; ++i) {
    List list;
    for (uint n = units.word() % 4; n > 0; --n) list.push_back(1 + units.word() % 5);
    std::sort(list.begin(), list.end());
    const uint medium = 1 + units.word() % 5;
    const MediaInterface there = media_interface(word_of(list), medium, true);
    const MediaInterface back = media_interface(there.after, medium, false);
    ASSERT_EQ(back.before, there.after);
    ASSERT_EQ(back.after, there.before);
    ASSERT_EQ(is_real_interface(back), is_real_interface(there));
  }
}

}  // namespace
}  // namespace ppm::shared
