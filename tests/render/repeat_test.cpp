// One scene, one set of options: one picture, to the bit, however the work was cut.
#include <cstdlib>
#include <utility>

#include "failure.hpp"
#include "small_room.hpp"

namespace ppm::test {
namespace {

constexpr unsigned kPasses = 3;

class Repeat : public RenderTest {
 protected:
  Repeat() : scene_(load(small_room())), settings_(room_settings(scene_)) {}

  Rendering render(const render::Settings& settings) const {
    return render_scene(device(), scene_, settings, kPasses);
  }

  scene::Scene scene_;
  render::Settings settings_;
};

// A picture to compare with must not be the same for trivial reasons.
void expect_lively(const render::Picture& picture) {
  const glm::dvec3 mean = window_mean(picture, {0, 0, picture.width, picture.height});
  for (int channel = 0; channel < 3; ++channel) EXPECT_GT(mean[channel], 0.1);
}

TEST_F(Repeat, SameOnEveryRun) {
  const Rendering first = render(settings_);
  expect_lively(first.picture);
  EXPECT_TRUE(same_bits(first.picture, render(settings_).picture));
}

TEST_F(Repeat, OtherSeedsMakeOtherPictures) {
  render::Settings other = settings_;
  other.seed = 1;
  EXPECT_FALSE(same_bits(render(settings_).picture, render(other).picture));
}

TEST_F(Repeat, WhateverTheDispatchTime) {
  // Kernels are cut by how long their items took before, so pieces are small from the second use
  // on.
  const auto rendered = [&](double milliseconds) {
    const char* const selector = std::getenv("PPM_TEST_DEVICE");
    gpu::Device device({.selector = selector ? selector : "",
                        .validation = true,
                        .dispatch_milliseconds = milliseconds});
    const Rendering rendering = render_scene(device, scene_, settings_, kPasses);
    std::uint64_t dispatches = 0;
    for (const auto& [kernel, time] : device.times()) dispatches += time.dispatches;
    return std::pair(rendering.picture, dispatches);
  };
  const auto [whole_picture, few] = rendered(1000.0);
  const auto [cut_picture, many] = rendered(0.2);
  EXPECT_GT(many, few) << "nothing was cut";
  EXPECT_TRUE(same_bits(whole_picture, cut_picture));
}

TEST_F(Repeat, WhateverTheTileSize) {
  const Rendering one = render(settings_);
  EXPECT_EQ(one.statistics.tiles, 1u);
  for (const std::uint64_t tile_hits : {1200u, 300u}) {
    render::Settings tiled = settings_;
    tiled.tile_hits = tile_hits;
    const Rendering many = render(tiled);
    EXPECT_GT(many.statistics.tiles, 1u);
    EXPECT_EQ(many.statistics.hit_points, one.statistics.hit_points);
    EXPECT_TRUE(same_bits(one.picture, many.picture)) << tile_hits << " hit points a tile";
  }
}

// With every choice of the initial radius: the pilot's photons have to fit, too.
TEST_F(Repeat, WhateverThePhotonCapacity) {
  for (const auto mode : {render::RadiusMode::automatic, render::RadiusMode::footprint}) {
    render::Settings roomy = settings_;
    roomy.radius_mode = mode;
    const Rendering one = render(roomy);
    render::Settings tight = roomy;
    tight.photon_capacity = 1500;
    EXPECT_GT(one.statistics.photons_stored, kPasses * 2 * tight.photon_capacity);
    EXPECT_TRUE(same_bits(one.picture, render(tight).picture))
        << "radius mode " << static_cast<int>(mode);
  }
}

// No smaller part of a pass is left to try.
TEST_F(Repeat, AsPhotonsOfOnePathThatDoNotFitAreAFailure) {
  render::Settings tiny = settings_;
  tiny.photon_capacity = 1;
  EXPECT_THROW(render(tiny), Failure);
}

TEST_F(Repeat, WhateverTheThreads) {
  const auto rendered = [&](unsigned threads) {
    Log log(Verbosity::quiet);
    const auto integrator = render::make_integrator(settings_, scene_, device(), log, threads);
    EXPECT_TRUE(integrator->prepare([] { return false; }));
    EXPECT_TRUE(integrator->advance([] { return false; }));
    return integrator->resolve();
  };
  const render::Picture one = rendered(1);
  for (const unsigned threads : {2u, 5u})
    EXPECT_TRUE(same_bits(one, rendered(threads))) << threads << " threads";
}

}  // namespace
}  // namespace ppm::test
