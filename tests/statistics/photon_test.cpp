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

// Position, two channels and the count are kept to the bit. Of the third channel 16 bits remain,
// rounded: 2^-16. Directions: see PackDirection.
TEST(PhotonRecord, KeepsWhatItPromises) {
  Units units(61);
  for (int i = 0; i < 200000; ++i) {
    const Photon photon = random_photon(units);
    const Photon kept = round_trip(photon);
    ASSERT_EQ(kept.position, photon.position);
    ASSERT_EQ(kept.flux.x, photon.flux.x);
    ASSERT_EQ(kept.flux.y, photon.flux.y);
    ASSERT_LE(std::abs(kept.flux.z - photon.flux.z), photon.flux.z * 0x1p-16f);
    ASSERT_EQ(kept.events, photon.events);
    ASSERT_LT(length(cross(kept.incident, photon.incident)), 6.7e-5f);
    ASSERT_GT(dot(kept.incident, photon.incident), 0.0f);
    ASSERT_LT(length(cross(kept.normal, photon.normal)), 6.7e-5f);
    ASSERT_GT(dot(kept.normal, photon.normal), 0.0f);
  }
}

// The third channel's rounding must not favour a side, but for ties (one value in 256), which go
// up: 2^-24 of the flux at most. Cutting the bits off instead would lose 2^-17 on average. The rest
// is noise: a uniform error's deviation of at most 2^-15 / sqrt 12 over sqrt n photons, six times.
TEST(PhotonRecord, RoundsWithoutBias) {
  Units units(62);
  double before = 0.0, after = 0.0;
  const int count = 1000000;
  for (int i = 0; i < count; ++i) {
    Photon photon{};
    photon.normal = photon.incident = vec3(0, 0, 1);
    photon.flux = vec3(units.next());
    photon.events = 255u;
    before += photon.flux.z;
    after += round_trip(photon).flux.z;
  }
  EXPECT_NEAR(after / before, 1.0, 0x1p-24 + 6.0 * 0x1p-15 / std::sqrt(12.0 * count));
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

// The side: both the photon's surface and its way of arrival must look to the eye's side.
TEST(AcceptsPhoton, OnTheSideAndSurfaceThatTheEyeSees) {
  const vec3 up(0, 0, 1);
  const vec3 slant = normalize(vec3(0.6f, 0.0f, 0.8f));
  EXPECT_TRUE(accepts_photon(up, up, up));
  EXPECT_TRUE(accepts_photon(up, normalize(vec3(1, 0, 1e-3f)), slant));
  EXPECT_FALSE(accepts_photon(up, -up, up)) << "arrived from below the hit point's surface";
  EXPECT_FALSE(accepts_photon(up, up, -up)) << "on the other side of a wall";
  EXPECT_FALSE(accepts_photon(up, slant, vec3(1, 0, 0))) << "around an edge";
  EXPECT_FALSE(accepts_photon(up, vec3(1, 0, 0), up)) << "grazing exactly";
  const auto leaning = [](float cosine) {
    return vec3(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
  };
  EXPECT_TRUE(accepts_photon(up, up, leaning(0.11f)));
  EXPECT_FALSE(accepts_photon(up, up, leaning(0.09f)));
}

}  // namespace
}  // namespace ppm::shared
