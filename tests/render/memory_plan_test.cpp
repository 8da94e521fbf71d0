// What is reckoned before a rendering, against what it takes on the device.
#include <algorithm>

#include "implementation.hpp"
#include "memory_fit.hpp"
#include "scene_traits.hpp"
#include "small_room.hpp"

namespace ppm::test {
namespace {

// The plan must never fall short of what is measured; nor exceed it by more than this share and
// what small records and the tree's estimate of nodes come to.
constexpr double kShare = 1.1;
constexpr std::uint64_t kSlack = 1u << 20;

class PlannedMemory : public RenderTest, public ::testing::WithParamInterface<render::Method> {
 protected:
  PlannedMemory() : scene_(load(small_room())) {
    settings_ = small_settings(scene_, 128, 96, 20000);
    settings_.integrator = GetParam().name;
    settings_.samples_per_pixel = 4;
    settings_.map_photons = 100000;
    settings_.photon_capacity = 0;
    demand_ = {scene::SceneSize::of(scene_), render::PassLimits::of(device()), {}, false};
    demand_.limits.layered_hits = render::traits_of(scene_).layers;
  }

  struct Measured {
    Rendering rendering;
    std::uint64_t bytes;  ///< most on the device, with what it has for transfers
  };
  Measured measure(const render::Settings& settings) {
    const std::uint64_t before = device().allocated_bytes();
    device().implementation().peak_bytes = before;
    Rendering rendering = render_scene(device(), scene_, settings, 2);
    return {std::move(rendering), device().peak_bytes() - before + demand_.limits.transfer_bytes};
  }
  void expect_planned(const Measured& measured, const render::Settings& settings,
                      const std::string& what) {
    const std::uint64_t planned = demand_.plan(settings).device_peak();
    EXPECT_LE(measured.bytes, planned) << what;
    EXPECT_LE(static_cast<double>(planned), kShare * static_cast<double>(measured.bytes) + kSlack)
        << what;
  }

  scene::Scene scene_;
  render::Settings settings_;
  render::MemoryDemand demand_;
};

// With as many hit points to an eye path as the scene has, and settings for ever smaller budgets,
// which leave the picture as it is.
TEST_P(PlannedMemory, IsWhatTheDeviceGives) {
  const Measured usual = measure(settings_);
  const std::uint64_t hits = usual.rendering.statistics.hit_points;
  const double paths = 4.0 * 128 * 96;
  if (hits > 0) demand_.limits.hits_a_path = static_cast<double>(hits) / paths;
  expect_planned(usual, settings_, "as usual");

  const std::uint64_t peak = demand_.plan(settings_).peak();
  const render::MemoryFit least = render::fit_memory(demand_, settings_, {1, 0, std::nullopt});
  EXPECT_FALSE(least.fits);
  ASSERT_LT(least.plan.peak(), peak);
  for (const std::uint64_t quarters : {3u, 1u}) {
    const std::uint64_t budget =
        least.plan.peak() + (peak - least.plan.peak()) / 4 * quarters + (1u << 16);
    const render::MemoryFit fit = render::fit_memory(demand_, settings_, {budget, 0, std::nullopt});
    ASSERT_TRUE(fit.fits) << quarters;
    EXPECT_LE(fit.plan.peak(), budget);
    EXPECT_NE(render::describe_change(demand_, settings_, fit.settings), "");
    const Measured less = measure(fit.settings);
    expect_planned(less, fit.settings, std::to_string(quarters) + " quarters");
    EXPECT_LT(less.bytes, usual.bytes);
    EXPECT_TRUE(same_bits(less.rendering.picture, usual.rendering.picture)) << quarters;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, PlannedMemory, ::testing::ValuesIn(render::methods()),
                         [](const auto& test) {
                           std::string name(test.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace ppm::test
