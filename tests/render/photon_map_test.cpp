// Classic photon mapping: closed forms, progressive photon mapping, and its own rules.
//
// In even light the n nearest photons over the area they reach exceed their density by a factor of
// n / (n - 1) in the mean, since pi r^2 times the density is the n-th arrival of a Poisson process:
// a gamma variable, whose inverse has the mean 1 / (n - 1). The closed forms are multiplied by it.
#include <cmath>
#include <numbers>

#include "failure.hpp"
#include "plate.hpp"
#include "small_room.hpp"

namespace ppm::test {
namespace {

constexpr double kSigmas = 5.0;  // of 8 seeds: Student's t with 7 degrees, 0.16 %
constexpr unsigned kSeeds = 8;

bool never() {
  return false;
}

double excess(double nearest) {
  return nearest / (nearest - 1.0);
}

using PhotonMap = RenderTest;

TEST_F(PhotonMap, EvenLightOnAPlate) {
  const glm::dvec3 albedo(0.8, 0.5, 0.3), color(0.9, 0.8, 1.0);
  PlateView view;
  view.eye = {0.1, 0.3, -0.05};
  view.integrator = "pm";
  view.radius = 0.2;  // the plate ends 0.3 outside of what is seen
  GltfWriter writer;
  writer.mesh(plate(0.0f, 0.8f), writer.material(lambert(albedo)));
  view.add_camera(writer);
  writer.directional_light({0.0, -1.0, 0.0}, color, 4.0);
  const scene::Scene scene = load(writer);
  // The deviation of a single estimate is about 1 / sqrt(n - 2) of it: of the mean of 8 times 144
  // discs that hardly overlap 2 % at most.
  for (const std::uint32_t nearest : {4u, 20u}) {
    view.nearest = nearest;
    const render::Settings settings = view.settings(scene, 1);
    const Estimate estimate = replicate(device(), scene, settings, 1, kSeeds, whole(settings));
    const glm::dvec3 expected = 4.0 * color * albedo / std::numbers::pi * excess(nearest);
    EXPECT_TRUE(agrees(estimate, expected, kSigmas, 1e-4 * expected)) << "n = " << nearest;
    EXPECT_LT(estimate.standard_error.x, 0.02 * expected.x) << "n = " << nearest;
  }
}

TEST_F(PhotonMap, PointLightOverAPlate) {
  const glm::dvec3 albedo(0.8, 0.5, 0.3), position(-0.1, 0.5, 0.2);
  PlateView view;
  view.eye = {0.1, 0.3, -0.05};
  view.integrator = "pm";
  view.radius = 0.06;  // twice the usual distance of the 100th
  view.passes = 2;
  GltfWriter writer;
  writer.mesh(plate(0.0f, 0.8f), writer.material(lambert(albedo)));
  view.add_camera(writer);
  writer.point_light(position, glm::dvec3(1.0), 3.0);
  const auto irradiance = [&](glm::dvec2 p) {
    const glm::dvec3 to_light = position - glm::dvec3(p.x, 0.0, p.y);
    const double d2 = glm::dot(to_light, to_light);
    return glm::dvec3(3.0 * to_light.y / (d2 * std::sqrt(d2)));
  };
  expect_irradiance(device(), writer, view, albedo * excess(view.nearest), irradiance, 1, 0.0);
}

// The furnace of furnace_test.cpp, whose bias it derives.
TEST_F(PhotonMap, Furnace) {
  const glm::dvec3 emission(0.5, 1.0, 0.25), albedo(0.3, 0.8, 0.1);
  GltfWriter writer;
  writer.mesh(inside_out(icosphere(4, Shading::flat)),
              writer.material(with_emission(lambert(albedo), emission)));
  writer.camera("inside", {0.1, 0.0, 0.2}, {0.3, 0.2, -1.0}, 2.0);
  const scene::Scene scene = load(writer);
  render::Settings settings = small_settings(scene, 16, 16, 20000);
  settings.integrator = "pm";
  settings.nearest = 50;
  settings.map_photons = 60000;
  const Estimate estimate = replicate(device(), scene, settings, 2, kSeeds, whole(settings));
  const glm::dvec3 reflected = emission * albedo / (1.0 - albedo);
  const double radius2 = 4.0 * settings.nearest / 40000.0;  // pi r^2 / 4 pi = n / photons
  EXPECT_TRUE(agrees(estimate, emission + reflected * excess(settings.nearest), kSigmas,
                     (0.004 + radius2 / 4.0) * reflected));
}

// Fewer than n: what there is within the largest radius, without bias.
TEST_F(PhotonMap, FewerPhotonsThanWanted) {
  const glm::dvec3 albedo(0.8, 0.5, 0.3);
  PlateView view;
  view.eye = {0.1, 0.3, -0.05};
  view.integrator = "pm";
  view.radius = 0.1;
  view.photons = 5000;
  view.nearest = 1000;
  GltfWriter writer;
  writer.mesh(plate(0.0f, 0.8f), writer.material(lambert(albedo)));
  view.add_camera(writer);
  writer.directional_light({0.0, -1.0, 0.0}, glm::dvec3(1.0), 4.0);
  expect_irradiance(
      device(), writer, view, albedo, [](glm::dvec2) { return glm::dvec3(4.0); }, 1, 0.0);
  // That is the radius, which is as found, not as it would be shrunk.
  const scene::Scene scene = load(writer);
  const auto statistics = render_scene(device(), scene, view.settings(scene, 0), 1).statistics;
  EXPECT_NEAR(statistics.nearest_radius_min, view.radius, 1e-4 * view.radius);
  EXPECT_NEAR(statistics.nearest_radius_max, view.radius, 1e-4 * view.radius);
}

class PhotonMapOfRoom : public RenderTest {
 protected:
  PhotonMapOfRoom() : scene_(load(small_room())), settings_(room_settings(scene_)) {
    settings_.integrator = "pm";
    settings_.nearest = 60;
    settings_.photons_per_pass = 8000;
    settings_.map_photons = 50000;
  }

  Rendering render(const render::Settings& settings, unsigned passes = 3) const {
    return render_scene(device(), scene_, settings, passes);
  }

  scene::Scene scene_;
  render::Settings settings_;
};

// One of everything, by both methods, with discs of about one size: edges of the room are as dark
// in both. What is left of their difference is that n nearest reach less far where there is more
// light, 3 % at most.
TEST_F(PhotonMapOfRoom, AgreesWithProgressivePhotonMapping) {
  const Window window = whole(settings_);
  const Estimate found = replicate(device(), scene_, settings_, 2, 6, window);
  const Rendering one = render(settings_, 2);
  render::Settings progressive = settings_;
  progressive.integrator = "ppm";
  progressive.radius_mode = render::RadiusMode::fixed;
  progressive.radius = one.statistics.nearest_radius_median;
  progressive.alpha = 0.999;
  const Estimate expected = replicate(device(), scene_, progressive, 2, 6, window);
  for (int channel = 0; channel < 3; ++channel) {
    const double mean = expected.mean[channel] * excess(settings_.nearest);
    const double error =
        std::hypot(found.standard_error[channel], expected.standard_error[channel]);
    EXPECT_NEAR(found.mean[channel], mean, kSigmas * error + 0.03 * mean);
    EXPECT_LT(error, 0.03 * mean);
  }
}

TEST_F(PhotonMapOfRoom, SameBitsHoweverTheWorkIsCut) {
  const Rendering whole_work = render(settings_);
  EXPECT_GT(window_mean(whole_work.picture, whole(settings_)).x, 0.1);
  EXPECT_TRUE(same_bits(whole_work.picture, render(settings_).picture)) << "once more";
  render::Settings cut = settings_;
  cut.tile_hits = 700;
  EXPECT_TRUE(same_bits(whole_work.picture, render(cut).picture)) << "small tiles";
  cut = settings_;
  cut.photon_capacity = 7001;  // in chunks of paths, and in several grids
  EXPECT_TRUE(same_bits(whole_work.picture, render(cut).picture)) << "few photons at a time";
  cut = settings_;
  cut.seed = 1;
  EXPECT_FALSE(same_bits(whole_work.picture, render(cut).picture)) << "another seed";
}

TEST_F(PhotonMapOfRoom, PicturesOnTheWayLeaveNoTrace) {
  Log log(Verbosity::quiet);
  const auto integrator = render::make_integrator(settings_, scene_, device(), log, 2);
  ASSERT_TRUE(integrator->prepare(never));
  const render::Picture dark = integrator->resolve();
  for (int pass = 0; pass < 3; ++pass) {
    ASSERT_TRUE(integrator->advance(never));
    const render::Picture picture = integrator->resolve();
    EXPECT_TRUE(same_bits(picture, integrator->resolve()));
    EXPECT_FALSE(same_bits(picture, dark));
  }
  EXPECT_TRUE(same_bits(integrator->resolve(), render(settings_).picture));
}

// A pass of which not all photons fit is cut, where a map of another number of photons a pass and
// in other chunks is cut, too; and then the method is complete.
TEST_F(PhotonMapOfRoom, IsCompleteOnceItIsFull) {
  settings_.photons_per_pass = 30000;
  settings_.map_photons = 20000;
  std::vector<render::Picture> pictures;
  for (const std::uint64_t photon_capacity : {1u << 19, 3001u}) {
    settings_.photon_capacity = photon_capacity;
    Log log(Verbosity::quiet);
    const auto integrator = render::make_integrator(settings_, scene_, device(), log, 2);
    ASSERT_TRUE(integrator->prepare(never));
    EXPECT_FALSE(integrator->complete());
    // Interrupted anywhere, also when parts of what is cut have been added, it starts afresh.
    int polls = 0;
    for (int most = 0; !integrator->advance([&] { return ++polls > most; }); most += 3) polls = 0;
    EXPECT_TRUE(integrator->complete());
    const render::Statistics statistics = integrator->statistics();
    EXPECT_EQ(statistics.map_photons, statistics.photons_stored);
    EXPECT_LE(statistics.map_photons, 20000u);
    EXPECT_GE(statistics.map_photons, 19900u);
    EXPECT_LT(statistics.photons_emitted, 20000u);
    pictures.push_back(integrator->resolve());
    EXPECT_GT(integrator->statistics().nearest_radius_median, 0.0);
  }
  EXPECT_TRUE(same_bits(pictures[0], pictures[1]));
  // The light is that of a map that is not full.
  settings_.photon_capacity = 1u << 19;
  settings_.map_photons = 2000000;
  settings_.photons_per_pass = 6000;
  const glm::dvec3 full = window_mean(pictures[0], whole(settings_));
  const glm::dvec3 other = window_mean(render(settings_, 2).picture, whole(settings_));
  EXPECT_NEAR(full.y, other.y, 0.1 * other.y);
}

TEST_F(PhotonMapOfRoom, AnInterruptedPassLeavesNoTrace) {
  settings_.photon_capacity = 7001;
  Log log(Verbosity::quiet);
  const auto integrator = render::make_integrator(settings_, scene_, device(), log, 2);
  ASSERT_TRUE(integrator->prepare(never));
  for (int pass = 0; pass < 3; ++pass) {
    int polls = 0;
    EXPECT_FALSE(integrator->advance([&] { return ++polls == 3; }));
    ASSERT_TRUE(integrator->advance(never));
  }
  EXPECT_EQ(integrator->statistics().passes, 3u);
  EXPECT_TRUE(same_bits(integrator->resolve(), render(settings_).picture));
}

TEST_F(PhotonMapOfRoom, GoesOnFromASavedState) {
  settings_.map_photons = 40000;
  Log log(Verbosity::quiet);
  const auto made = [&](const render::Settings& settings) {
    return render::make_integrator(settings, scene_, device(), log, 2);
  };
  const auto first = made(settings_);
  ASSERT_TRUE(first->prepare(never));
  for (const bool full : {false, true}) {
    ASSERT_TRUE(first->advance(never));
    while (full && !first->complete()) ASSERT_TRUE(first->advance(never));
    const render::SavedState state = first->save_state();
    render::Settings cut = settings_;
    cut.photon_capacity = 7001;
    const auto second = made(cut);
    second->restore_state(state);
    EXPECT_EQ(second->save_state(), state);
    EXPECT_EQ(second->complete(), full);
    EXPECT_TRUE(same_bits(first->resolve(), second->resolve()));
    cut.nearest = 61;
    EXPECT_THROW(made(cut)->restore_state(state), Failure);
    EXPECT_THROW(made(settings_)->restore_state({state.begin(), state.end() - 1}), Failure);
  }
}

}  // namespace
}  // namespace ppm::test
