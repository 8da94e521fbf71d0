// shared/photon.h: what survives the record, and which photons count.
#include "shared/photon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "chi_squared.hpp"

namespace ppm::shared {
namespace {

using statistics::Units;

Photon random_photon(Units& units) {
  Photon photon;
  photon.position = units.next3() * 2.0f - vec3(1.0f);
  photon.incident = units.direction();
  const float scale = std::exp2(60.0f * units.next() - 30.0f);
  photon.flux = units.next3() * scale;
  photon.normal = units.direction();
  photon.events = static_cast<uint>(units.next() * 256.0f);
  return photon;
}

Photon round_trip(const Photon& photon) {
  return unpack_photon(pack_photon_position(photon), pack_photon_flux(photon));
}

// Position and count are kept to the bit. Channels are rounded to 16 bits of the largest, which has
// its highest bit set: by half of 2^-15 of it, or by that much once where it is 65535.5 and more.
// Directions: see PackDirection.
TEST(PhotonRecord, KeepsWhatItPromises) {
  Units units(61);
  for (int i = 0; i < 200000; ++i) {
    const Photon photon = random_photon(units);
    const Photon kept = round_trip(photon);
    ASSERT_EQ(kept.position, photon.position);
    const float largest = max_component(photon.flux);
    for (int c = 0; c < 3; ++c) {
      ASSERT_LE(std::abs(kept.flux[c] - photon.flux[c]), largest * 0x1.0001p-16f);
    }
    ASSERT_EQ(kept.events, photon.events);
    ASSERT_LT(length(cross(kept.incident, photon.incident)), 6.7e-5f);
    ASSERT_GT(dot(kept.incident, photon.incident), 0.0f);
    ASSERT_LT(length(cross(kept.normal, photon.normal)), 6.7e-5f);
    ASSERT_GT(dot(kept.normal, photon.normal), 0.0f);
  }
}

// Rounding must not favour a side. Cutting bits off instead would lose 2^-17 on average. What is
// left is noise: a uniform error's deviation of at most 2^-15 / sqrt 12 over sqrt n photons, six
// times; ties and the largest mantissa, one value in 2^16 each and half a step, are some 2^-32.
TEST(PhotonRecord, RoundsWithoutBias) {
  Units units(62);
  vec3 scale(1.0f, 0.3f, 0.01f);
  double before[3] = {}, after[3] = {};
  const int count = 1000000;
  for (int i = 0; i < count; ++i) {
    Photon photon{};
    photon.normal = photon.incident = vec3(0, 0, 1);
    photon.flux = scale * units.next3();
    photon.flux.x = 0.5f + 0.5f * photon.flux.x;
    photon.events = 255u;
    const vec3 kept = round_trip(photon).flux;
    for (int c = 0; c < 3; ++c) {
      before[c] += photon.flux[c];
      after[c] += kept[c];
    }
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(after[c] / count, before[c] / count, 6.0 * 0x1p-16 / std::sqrt(12.0 * count));
  }
}

TEST(PhotonRecord, EventsSaturate) {
  Photon photon{};
  photon.normal = photon.incident = vec3(0, 0, 1);
  photon.flux = vec3(0.0f);
  for (const uint events : {0u, 1u, 254u, 255u, 256u, 1000u, 0xffffffffu}) {
    photon.events = events;
    EXPECT_EQ(round_trip(photon).events, events < 255u ? events : 255u);
    EXPECT_EQ(round_trip(photon).flux.z, 0.0f);
  }
}

bool accepts(vec3 hit_normal, vec3 incident, vec3 photon_normal) {
  return accepts_packed_photon(hit_normal, pack_direction(incident), pack_direction(photon_normal));
}

// The side: both the photon's surface and its way of arrival must look to the eye's side.
TEST(AcceptsPhoton, OnTheSideAndSurfaceThatTheEyeSees) {
  const vec3 up(0, 0, 1);
  const vec3 slant = normalize(vec3(0.6f, 0.0f, 0.8f));
  EXPECT_TRUE(accepts(up, up, up));
  EXPECT_TRUE(accepts(up, normalize(vec3(1, 0, 1e-3f)), slant));
  EXPECT_FALSE(accepts(up, -up, up)) << "arrived from below the hit point's surface";
  EXPECT_FALSE(accepts(up, up, -up)) << "on the other side of a wall";
  EXPECT_FALSE(accepts(up, slant, vec3(1, 0, 0))) << "around an edge";
  EXPECT_FALSE(accepts(up, vec3(1, 0, 0), up)) << "grazing exactly";
  const auto leaning = [](float cosine) {
    return vec3(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
  };
  EXPECT_TRUE(accepts(up, up, leaning(0.11f)));
  EXPECT_FALSE(accepts(up, up, leaning(0.09f)));
}

// Photons told by their surface's front, as scenes with layers keep them. A glass plate: its upper
// face looks up, its lower one down, and they may be closer than a disc.
TEST(AcceptsPhoton, OfTheSameFaceWhereLightComesThrough) {
  const vec3 up(0, 0, 1), down(0, 0, -1);
  const vec3 slant = normalize(vec3(0.6f, 0.0f, 0.8f));
  const auto accepts_of = [](uint flags, vec3 hit_normal, vec3 incident, vec3 front) {
    return accepts_packed_photon_of_layers(hit_normal, flags, pack_direction(incident),
                                           pack_direction(front));
  };
  const uint solid = PPM_HIT_TRANSMITS | PPM_HIT_SOLID;
  // The upper face from above.
  EXPECT_TRUE(accepts_of(solid, up, slant, up));
  EXPECT_TRUE(accepts_of(solid, up, -slant, up)) << "from inside";
  EXPECT_FALSE(accepts_of(solid, up, slant, down)) << "from inside on the lower face";
  EXPECT_FALSE(accepts_of(solid, up, -slant, down)) << "from below on the lower face";
  // The same from inside.
  EXPECT_TRUE(accepts_of(solid | PPM_HIT_BACK, down, slant, up));
  EXPECT_TRUE(accepts_of(solid | PPM_HIT_BACK, down, -slant, up));
  EXPECT_FALSE(accepts_of(solid | PPM_HIT_BACK, down, -slant, down));
  // A thin sheet has no inside: its triangles may be turned either way.
  for (const vec3& front : {up, down}) {
    EXPECT_TRUE(accepts_of(PPM_HIT_TRANSMITS, up, slant, front));
    EXPECT_TRUE(accepts_of(PPM_HIT_TRANSMITS, up, -slant, front));
  }
  // Opaque ones reflect what falls on the side that is seen, as without layers.
  for (const uint flags : {0u, uint{PPM_HIT_BACK}}) {
    for (const vec3& front : {up, down}) {
      EXPECT_TRUE(accepts_of(flags, up, slant, front));
      EXPECT_FALSE(accepts_of(flags, up, -slant, front));
    }
  }
  EXPECT_FALSE(accepts_of(solid, up, slant, vec3(1, 0, 0))) << "around an edge";
  EXPECT_FALSE(accepts_of(solid, up, -slant, vec3(-0.999f, 0, 0.05f))) << "around an edge";
}

}  // namespace
}  // namespace ppm::shared
