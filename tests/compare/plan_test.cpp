// When pictures are kept, what a reference differs in, which plans are refused.
#include "plan.hpp"

#include <gtest/gtest.h>

#include <set>

#include "failure.hpp"

namespace ppm::compare {
namespace {

Plan plan_of(const std::vector<std::string>& labels) {
  Plan plan;
  for (const std::string& label : labels) plan.methods.push_back({label, {}});
  return plan;
}

TEST(ComparePlan, MomentsAreHalvesDownToA128th) {
  EXPECT_EQ(moments_of(64.0), (std::vector<double>{0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0}));
}

TEST(ComparePlan, Figure5HasThePapersPasses) {
  using Passes = std::vector<std::uint64_t>;
  EXPECT_EQ(figure5_passes(1024), (Passes{1, 16, 64, 256, 1024}));
  EXPECT_EQ(figure5_passes(100), (Passes{1, 16, 64, 100}));
  EXPECT_EQ(figure5_passes(1), (Passes{1}));
  EXPECT_EQ(figure5_passes(4096), (Passes{1, 16, 64, 256, 1024, 4096}));
}

TEST(ComparePlan, AReferenceByPhotonsHasLittleInCommonWithWhatItJudges) {
  using render::RadiusMode;
  for (const RadiusMode mode : {RadiusMode::automatic, RadiusMode::footprint, RadiusMode::fixed}) {
    for (const double alpha : {0.7, 0.6, 0.5}) {
      render::Settings settings;
      settings.radius_mode = mode;
      settings.alpha = alpha;
      const render::Settings reference = reference_settings(settings);
      EXPECT_NE(reference.alpha, settings.alpha);
      EXPECT_NE(reference.radius_mode, settings.radius_mode);
      EXPECT_EQ(reference.samples_per_pixel, 640u * 480u * 16u <= (4u << 20) ? 16u : 4u);
      EXPECT_EQ(reference.width, settings.width);
    }
  }
  render::Settings small;
  small.width = small.height = 100;
  EXPECT_EQ(reference_settings(small).samples_per_pixel, 4 * small.samples_per_pixel);
}

TEST(ComparePlan, SeedsOfReferencesAreOnesOfTheirOwn) {
  Plan plan;
  plan.first_seed = 5;
  plan.seeds = 1000;
  std::set<std::uint32_t> seeds;
  for (unsigned i = 0; i < 1000; ++i) {
    seeds.insert(plan.first_seed + i);
    seeds.insert(reference_seed(plan, i));
    seeds.insert(trial_seed(plan, i));
  }
  EXPECT_EQ(seeds.size(), 3000u);
}

TEST(ComparePlan, LabelsBecomeHarmlessNames) {
  EXPECT_EQ(directory_name("pt-mis"), "pt-mis");
  EXPECT_EQ(directory_name("ppm:alpha=0.8"), "ppm_alpha_0.8");
  EXPECT_EQ(directory_name("../../etc"), "_.._.._etc");
  EXPECT_EQ(directory_name("a b/\"<\xc3\xa4"), "a_b_____");
}

TEST(ComparePlan, RefusesWhatCannotBeTold) {
  EXPECT_NO_THROW(check_plan(plan_of({"ppm", "pt"})));
  EXPECT_THROW(check_plan(plan_of({"ppm", "ppm"})), Failure);
  Plan probe = plan_of({"ppm"});
  probe.figures.probes = {{639, 479}};
  EXPECT_NO_THROW(check_plan(probe));
  probe.figures.probes = {{640, 0}};
  EXPECT_THROW(check_plan(probe), Failure);
  Plan crop = plan_of({"ppm"});
  crop.crops = {{600, 400, 40, 80}};
  EXPECT_NO_THROW(check_plan(crop));
  crop.crops = {{600, 400, 40, 81}};
  EXPECT_THROW(check_plan(crop), Failure);
  crop.crops = {{4294967295u, 0, 2, 2}};
  EXPECT_THROW(check_plan(crop), Failure);
}

}  // namespace
}  // namespace ppm::compare
