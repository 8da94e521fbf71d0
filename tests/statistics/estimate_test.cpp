// shared/ppm.h against the paper's equations as they are printed, in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "chi_squared.hpp"
#include "shared/ppm.h"

namespace ppm::shared {
namespace {

using glm::dvec3;
using statistics::Units;
constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 0x1p-24;

// The hit point of the paper's section 3.1: it stores N, R and tau [HOJ08 Eqs. 5-13].
struct PaperHitPoint {
  double n = 0.0;
  double radius = 1.0;
  dvec3 tau{0.0};

  void update(double alpha, double m, dvec3 tau_m) {
    if (n + m == 0.0) return;
    const double density = (n + m) / (kPi * radius * radius);                         // Eq. 5
    const double n_hat = n + alpha * m;                                               // Eq. 7
    const double shrink = radius - radius * std::sqrt((n + alpha * m) / (n + m));     // Eq. 8
    const double radius_hat = radius - shrink;                                        // Eq. 9
    EXPECT_NEAR(kPi * radius_hat * radius_hat * density / n_hat, 1.0, 1e-12);         // Eq. 6
    tau = (tau + tau_m) * (kPi * radius_hat * radius_hat) / (kPi * radius * radius);  // Eq. 12
    n = n_hat;
    radius = radius_hat;
  }

  dvec3 radiance(double emitted) const {
    return tau / (kPi * radius * radius * emitted);
  }  // Eq. 13
};

struct Pass {
  uint photons;
  vec3 flux;
};

// From deserts to crowds, in one sequence: 0, 1, a few, thousands, a million photons.
std::vector<Pass> random_passes(Units& units, int count) {
  std::vector<Pass> passes;
  for (int i = 0; i < count; ++i) {
    const float kind = units.next();
    const float most = kind < 0.3f ? 1.0f : kind < 0.6f ? 10.0f : kind < 0.95f ? 5000.0f : 1e6f;
    const uint photons = static_cast<uint>(units.next() * (most + 1.0f));
    passes.push_back({photons, units.next3() * (0.8f * static_cast<float>(photons))});
  }
  return passes;
}

void expect_relative(double value, double expected, double tolerance) {
  ASSERT_NEAR(value, expected, tolerance * std::abs(expected));
}

// In one pass R^2 is rounded at most 6 times (two conversions, two sums, a product, a quotient and
// the product with the old R^2, of which some cancel), lambda twice, plus what R^2 has gathered.
// Rounding errors add up to less than their number; the bound is the worst case, not the typical.
TEST(UpdateEstimate, FollowsThePaper) {
  Units units(41);
  for (const float alpha : {0.1f, 0.5f, 0.7f, 2.0f / 3.0f, 0.99f}) {
    for (int sequence = 0; sequence < 20; ++sequence) {
      Estimate estimate{vec3(0.0f), 0.25f * (units.next() + 0.01f), 0u};
      PaperHitPoint paper;
      paper.radius = std::sqrt(double(estimate.radius2));
      double emitted = 0.0;
      double passes_done = 0.0;
      for (const Pass& pass : random_passes(units, 100)) {
        estimate = update_estimate(estimate, alpha, pass.photons, pass.flux);
        paper.update(alpha, pass.photons, dvec3(pass.flux));
        emitted += 100000.0;
        passes_done += 1.0;
        const double tolerance = 7.0 * kRounding * passes_done;
        expect_relative(estimate.radius2, paper.radius * paper.radius, tolerance);
        expect_relative(accumulated_photons(estimate, alpha), paper.n, 3.0 * kRounding);
        for (int c = 0; c < 3; ++c) {
          expect_relative(accumulated_flux(estimate)[c], paper.tau[c], 2.0 * tolerance);
          expect_relative(radiance(estimate, static_cast<float>(1.0 / emitted))[c],
                          paper.radiance(emitted)[c], 2.0 * tolerance);
        }
        if (HasFatalFailure()) return;
      }
    }
  }
}

// Eqs. 9 and 12 scale R^2 and tau alike: tau / (pi R^2) is the sum of tau_M / (pi R^2) at the
// radius that each pass searched. In the paper's own variables, hence to double precision.
TEST(UpdateEstimate, TelescopesAsTheIdentitySays) {
  Units units(42);
  for (const float alpha : {0.3f, 0.7f, 0.95f}) {
    PaperHitPoint paper;
    Estimate estimate{vec3(0.0f), 1.0f, 0u};
    dvec3 telescoped(0.0), searched(0.0);
    for (const Pass& pass : random_passes(units, 200)) {
      telescoped += dvec3(pass.flux) / (kPi * paper.radius * paper.radius);
      if (pass.photons > 0u) searched += dvec3(pass.flux) / (kPi * double(estimate.radius2));
      paper.update(alpha, pass.photons, dvec3(pass.flux));
      estimate = update_estimate(estimate, alpha, pass.photons, pass.flux);
    }
    for (int c = 0; c < 3; ++c) {
      expect_relative(paper.tau[c] / (kPi * paper.radius * paper.radius), telescoped[c], 1e-12);
      expect_relative(estimate.lambda[c], searched[c], 200.0 * 2.0 * kRounding);
    }
  }
}

// From N = 0 Eq. 7 adds up to alpha times all photons ever accepted.
TEST(UpdateEstimate, CountsEveryPhotonOnce) {
  Units units(43);
  Estimate estimate{vec3(0.0f), 1.0f, 0u};
  std::uint64_t total = 0;
  double n = 0.0;
  for (const Pass& pass : random_passes(units, 300)) {
    estimate = update_estimate(estimate, 0.7f, pass.photons, pass.flux);
    total += pass.photons;
    n += double(0.7f) * pass.photons;
    ASSERT_EQ(estimate.count, total);
  }
  expect_relative(double(0.7f) * static_cast<double>(total), n, 1e-12);
}

TEST(UpdateEstimate, NoPhotonsChangeNothingAtAll) {
  const Estimate states[] = {{vec3(0.0f), 0.1f, 0u}, {vec3(0.1f, 3.3f, 1e-20f), 1e-9f, 12345u}};
  for (const Estimate& before : states) {
    const Estimate after = update_estimate(before, 0.7f, 0u, vec3(0.0f));
    EXPECT_EQ(std::memcmp(&before, &after, sizeof before), 0);
  }
}

// N grows and R shrinks with every photon [HOJ08 section 4.1: N^ > N].
TEST(UpdateEstimate, GrowsInCountAndShrinksInRadius) {
  Units units(44);
  for (const float alpha : {0.05f, 0.7f, 0.99f}) {
    Estimate estimate{vec3(0.0f), 1.0f, 0u};
    for (int i = 0; i < 1000; ++i) {
      const uint photons = 1u + static_cast<uint>(units.next() * 50.0f);
      const Estimate next = update_estimate(estimate, alpha, photons, vec3(1.0f));
      ASSERT_GT(next.count, estimate.count);
      ASSERT_GT(accumulated_photons(next, alpha), accumulated_photons(estimate, alpha));
      ASSERT_LT(next.radius2, estimate.radius2);
      ASSERT_GT(next.radius2, 0.0f);
      estimate = next;
    }
  }
}

// A count that began again from 0 would make the next radius jump by alpha.
TEST(UpdateEstimate, CountStaysAtItsLargest) {
  const Estimate almost{vec3(1.0f), 1.0f, 0xfffffff0u};
  const Estimate full = update_estimate(almost, 0.7f, 100u, vec3(0.0f));
  EXPECT_EQ(full.count, 0xffffffffu);
  const Estimate after = update_estimate(full, 0.7f, 100u, vec3(0.0f));
  EXPECT_EQ(after.count, 0xffffffffu);
  EXPECT_GT(after.radius2, 0.999f);
}

// With M photons in every pass the ratio of pass i is alpha (i + 1) / (alpha i + 1), whatever M;
// the product is a quotient of gamma functions, which falls as i^(alpha - 1).
TEST(UpdateEstimate, ShrinksByTheClosedFormUnderConstantLight) {
  const double alpha = 0.7f;
  const int passes = 1000;
  for (const uint photons : {1u, 37u}) {
    Estimate estimate{vec3(0.0f), 1.0f, 0u};
    for (int i = 0; i < passes; ++i) {
      estimate = update_estimate(estimate, float(alpha), photons, vec3(1.0f));
    }
    const double closed = std::exp(std::lgamma(passes + 1.0) + std::lgamma(1.0 / alpha) -
                                   std::lgamma(passes + 1.0 / alpha));
    expect_relative(estimate.radius2, closed, 7.0 * kRounding * passes);
    expect_relative(closed, std::tgamma(1.0 / alpha) * std::pow(passes, 1.0 - 1.0 / alpha), 1e-3);
  }
}

TEST(ShrinkRatio, LiesBetweenAlphaAndOne) {
  for (const float alpha : {0.01f, 0.7f, 0.999f}) {
    EXPECT_NEAR(shrink_ratio(alpha, 0u, 5u), alpha, 2e-7 * alpha);  // the first photons: N = 0
    EXPECT_LE(shrink_ratio(alpha, 4000000000u, 1u), 1.0f);
    EXPECT_GE(shrink_ratio(alpha, 1u, 4000000000u), alpha * (1.0f - 2e-7f));
  }
}

}  // namespace
}  // namespace ppm::shared
