// Stopping leaves no trace: between passes by saved states, within a pass by interruption.
#include <algorithm>
#include <cmath>
#include <utility>

#include "failure.hpp"
#include "small_room.hpp"

namespace ppm::test {
namespace {

constexpr unsigned kPasses = 4;

bool never() {
  return false;
}

scene::Material& find(scene::Scene& scene, const std::function<bool(const scene::Material&)>& is) {
  return *std::find_if(scene.materials.begin(), scene.materials.end(), is);
}
scene::Material& brushed(scene::Scene& scene) {
  return find(scene, [](const scene::Material& m) { return m.metallic > 0 && m.roughness > 0; });
}
scene::Material& ball(scene::Scene& scene) {
  return find(scene, [](const scene::Material& m) { return m.solid; });
}

class Restart : public RenderTest {
 protected:
  Restart() : scene_(load(small_room())), settings_(room_settings(scene_)) {}

  std::unique_ptr<render::Integrator> make(const render::Settings& settings,
                                           const scene::Scene& scene) {
    return render::make_integrator(settings, scene, device(), log_, 2);
  }
  std::unique_ptr<render::Integrator> make(const render::Settings& settings) {
    return make(settings, scene_);
  }

  render::SavedState state_after(unsigned passes) {
    const auto integrator = make(settings_);
    EXPECT_TRUE(integrator->prepare(never));
    for (unsigned pass = 0; pass < passes; ++pass) EXPECT_TRUE(integrator->advance(never));
    return integrator->save_state();
  }

  render::Picture in_one_go() { return render_scene(device(), scene_, settings_, kPasses).picture; }

  scene::Scene scene_;
  render::Settings settings_;
  Log log_{Verbosity::quiet};
};

TEST_F(Restart, GoesOnAsIfNeverStopped) {
  const render::Picture expected = in_one_go();
  render::Settings tiled = settings_;
  tiled.tile_hits = 2000;
  for (const unsigned before : {0u, 2u}) {
    const render::SavedState state = state_after(before);
    for (const render::Settings& settings : {settings_, tiled}) {
      const auto integrator = make(settings);
      integrator->restore_state(state);
      EXPECT_EQ(integrator->save_state(), state);
      for (unsigned pass = before; pass < kPasses; ++pass) EXPECT_TRUE(integrator->advance(never));
      EXPECT_TRUE(same_bits(integrator->resolve(), expected))
          << before << " passes before, " << integrator->statistics().tiles << " tiles after";
      EXPECT_EQ(integrator->statistics().passes, kPasses);
      EXPECT_EQ(integrator->statistics().photons_emitted, kPasses * settings.photons_per_pass);
    }
  }
}

TEST_F(Restart, RefusesStatesOfOtherSettings) {
  const render::SavedState state = state_after(1);
  const auto refused = [&](const char* what, const auto& change) {
    render::Settings other = settings_;
    change(other);
    EXPECT_THROW(make(other)->restore_state(state), Failure) << what;
  };
  refused("width", [](render::Settings& s) { s.width = 25; });
  refused("photons", [](render::Settings& s) { s.photons_per_pass = 5001; });
  refused("alpha", [](render::Settings& s) { s.alpha = 0.71; });
  refused("radius mode",
          [](render::Settings& s) { s.radius_mode = render::RadiusMode::footprint; });
  refused("samples", [](render::Settings& s) { s.samples_per_pixel = 5; });
  refused("filter", [](render::Settings& s) { s.filter = render::Filter::tent; });
  refused("seed", [](render::Settings& s) { s.seed = 1; });
  refused("depth", [](render::Settings& s) { s.max_depth = 7; });
  refused("camera", [](render::Settings& s) { s.camera.position.x += 0.01; });
}

// The picture is a function of all of the scene: whatever of it differs must be noticed.
TEST_F(Restart, RefusesStatesOfOtherScenes) {
  const render::SavedState state = state_after(1);
  const auto refused = [&](const char* what, const auto& change) {
    scene::Scene other = scene_;
    change(other);
    EXPECT_THROW(make(settings_, other)->restore_state(state), Failure) << what;
  };
  refused("corner", [](scene::Scene& s) { s.triangles[0].corners[0].position.x *= 0.999f; });
  refused("normal", [](scene::Scene& s) {
    std::swap(s.triangles[20].corners[0].normal, s.triangles[20].corners[1].normal);
  });
  refused("assignment", [](scene::Scene& s) { s.triangles[0].material ^= 1u; });
  refused("colour", [](scene::Scene& s) { s.materials[0].base_color.x = 0.5f; });
  refused("roughness", [](scene::Scene& s) { brushed(s).roughness = 0.3f; });
  refused("glass", [](scene::Scene& s) { ball(s).ior = 1.4f; });
  refused("absorption", [](scene::Scene& s) { ball(s).attenuation_distance = 1.0f; });
  refused("lamp moved", [](scene::Scene& s) { s.punctual_lights[0].position.x += 0.1f; });
  refused("lamp turned", [](scene::Scene& s) { s.punctual_lights[0].direction.x *= -1.0f; });
  refused("lamp's colour", [](scene::Scene& s) {
    std::swap(s.punctual_lights[0].intensity.x, s.punctual_lights[0].intensity.z);
  });
}

TEST_F(Restart, RefusesWhatIsCutOff) {
  const render::SavedState state = state_after(1);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{7}, std::size_t{40}, state.size() / 2, state.size() - 1}) {
    const render::SavedState part(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(make(settings_)->restore_state(part), Failure) << size << " bytes";
  }
  render::SavedState longer = state;
  longer.push_back(0);
  EXPECT_THROW(make(settings_)->restore_state(longer), Failure);
}

// Says yes at the n-th time it is asked.
class Nuisance {
 public:
  explicit Nuisance(unsigned at) : left_(at) {}
  bool operator()() { return left_ > 0 && --left_ == 0; }

 private:
  unsigned left_;
};

// Every point at which a pass can be stopped is tried once, with chunks and tiles so that some lie
// between two gathers of one pass.
TEST_F(Restart, InterruptedPassesLeaveNoTrace) {
  settings_.photon_capacity = 6000;
  settings_.tile_hits = 2000;
  const render::Picture expected = in_one_go();
  const auto integrator = make(settings_);
  ASSERT_TRUE(integrator->prepare(never));
  ASSERT_TRUE(integrator->advance(never));
  const render::SavedState state = integrator->save_state();
  unsigned interruptions = 0;
  while (!integrator->advance(Nuisance(interruptions + 1))) {
    ++interruptions;
    ASSERT_LT(interruptions, 1000u);
    ASSERT_EQ(integrator->save_state(), state) << "at poll " << interruptions;
  }
  EXPECT_GT(interruptions, 10u);
  for (unsigned pass = 2; pass < kPasses; ++pass) ASSERT_TRUE(integrator->advance(never));
  EXPECT_TRUE(same_bits(integrator->resolve(), expected));
  EXPECT_EQ(integrator->statistics().passes, kPasses);
}

TEST_F(Restart, InterruptedPreparationStillGivesAPicture) {
  for (const unsigned at : {1u, 2u, 3u, 4u}) {
    const auto integrator = make(settings_);
    ASSERT_FALSE(integrator->prepare(Nuisance(at)));
    const render::Picture picture = integrator->resolve();
    ASSERT_EQ(picture.rgb.size(), 3u * settings_.width * settings_.height);
    for (const float value : picture.rgb) ASSERT_TRUE(std::isfinite(value));
  }
}

}  // namespace
}  // namespace ppm::test
