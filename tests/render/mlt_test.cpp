// Metropolis light transport: as bright as independent samples say, wherever the light is, however
// many chains share the mutations.
#include <string>

#include "failure.hpp"
#include "shared/bidirectional.h"
#include "small_room.hpp"

namespace ppm::test {
namespace {

constexpr unsigned kSeeds = 6;
// Student's t with some ten degrees of freedom: passed once in 4000 comparisons.
constexpr double kSigmas = 5.5;

class Mlt : public RenderTest {
 protected:
  static render::Settings settings_of(const scene::Scene& scene) {
    render::Settings settings = small_settings(scene, 16, 16);
    settings.integrator = "mlt";
    settings.mlt_chains = 256;
    return settings;
  }
};

/// A closed room whose walls glow, one of them a lamp besides; a rough and a glass ball.
GltfWriter glowing_room(bool furnished) {
  GltfWriter writer;
  writer.mesh(inside_out(box(glm::vec3(-1.0f), glm::vec3(1.0f))),
              writer.material(with_emission(lambert({0.7, 0.5, 0.2}), {0.1, 0.2, 0.4})));
  if (furnished) {
    writer.mesh(quad({-0.3f, 0.9f, -0.6f}, {0.6f, 0, 0}, {0, 0, 0.6f}),
                writer.material(emitter({8.0, 7.0, 6.0})));
    writer.mesh(icosphere(2), writer.material(metal({0.8, 0.7, 0.5}, 0.5)),
                placed({-0.4, -0.5, -0.4}, 0.35));
    writer.mesh(icosphere(2), writer.material(glass(1.5)), placed({0.4, -0.5, -0.3}, 0.35));
  }
  writer.camera("inside", {0.3, 0.1, 0.8}, {0.0, -0.3, -1.0}, 1.2);
  return writer;
}

std::vector<glm::dvec3> blocks_and_whole(const render::Picture& picture) {
  std::vector<glm::dvec3> means = block_means(picture, 8);
  means.push_back(window_mean(picture, {0, 0, picture.width, picture.height}));
  return means;
}

double mean_of(glm::dvec3 value) {
  return (value.x + value.y + value.z) / 3.0;
}

// e / (1 - albedo) everywhere: the picture's mean is the normalisation, within 1 %.
TEST_F(Mlt, FurnaceIsNormalised) {
  const glm::dvec3 expected = glm::dvec3(0.1, 0.2, 0.4) / (1.0 - glm::dvec3(0.7, 0.5, 0.2));
  const scene::Scene scene = load(glowing_room(false));
  render::Settings settings = settings_of(scene);
  settings.mlt_chains = 200;  // 15 mutations each in 12 passes of 256
  const Estimate mean =
      replicate(device(), scene, settings, 12, kSeeds, [&](const render::Picture& picture) {
        return std::vector{glm::dvec3(mean_of(window_mean(picture, whole(settings))))};
      })[0];
  EXPECT_LT(mean.standard_error.x, 0.004 * mean_of(expected));
  EXPECT_TRUE(agrees(mean, glm::dvec3(mean_of(expected)), 0.0, 0.01 * mean_of(expected)));
}

// From the start: 256 chains that are 24 mutations long.
TEST_F(Mlt, AgreesWithIndependentSamples) {
  const scene::Scene scene = load(glowing_room(true));
  render::Settings settings = settings_of(scene);
  settings.filter = render::Filter::tent;
  settings.integrator = "bdpt";
  const auto samples = replicate(device(), scene, settings, 12, kSeeds, blocks_and_whole);
  settings.integrator = "mlt";
  auto blocks = replicate(device(), scene, settings, 24, kSeeds, blocks_and_whole);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].standard_error = glm::sqrt(blocks[i].standard_error * blocks[i].standard_error +
                                         samples[i].standard_error * samples[i].standard_error);
    EXPECT_TRUE(agrees(blocks[i], samples[i].mean, kSigmas, 0.002 * samples[i].mean)) << i;
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_LT(blocks[i].standard_error[channel], 0.06 * samples[i].mean[channel]) << i;
  }
}

// Chains start as they go on: the first mutations of all are no darker where light is rare, nor
// do they brighten, though few large steps are accepted.
TEST_F(Mlt, StartsWithoutBias) {
  GltfWriter writer;
  writer.mesh(inside_out(box(glm::vec3(-1.0f), glm::vec3(1.0f))),
              writer.material(with_emission(lambert(glm::dvec3(0.3)), {0.02, 0.02, 0.02})));
  writer.mesh(quad({-0.2f, -0.3f, -0.9f}, {0.6f, 0, 0}, {0, 0.5f, 0}),
              writer.material(emitter({3.0, 4.0, 5.0})));
  writer.camera("inside", {0.0, 0.0, 0.8}, {0.0, 0.0, -1.0}, 1.2);
  const scene::Scene scene = load(writer);
  render::Settings settings = settings_of(scene);
  const auto first = replicate(device(), scene, settings, 1, 3 * kSeeds, blocks_and_whole);
  const auto later = replicate(device(), scene, settings, 24, kSeeds, blocks_and_whole);
  settings.integrator = "bdpt";
  const auto samples = replicate(device(), scene, settings, 12, kSeeds, blocks_and_whole);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const glm::dvec3 noise = 5.0 * samples[i].standard_error;
    EXPECT_TRUE(agrees(first[i], samples[i].mean, kSigmas, noise)) << "first, block " << i;
    EXPECT_TRUE(agrees(later[i], samples[i].mean, kSigmas, noise)) << "later, block " << i;
    EXPECT_LT(first[i].standard_error.x, 0.06 * samples[i].mean.x) << i;
    EXPECT_LT(later[i].standard_error.x, 0.08 * samples[i].mean.x) << i;
  }
}

// Light that comes through the lens belongs to other pixels than the sample's own: by this way
// alone, and by the one that has nothing of it.
TEST_F(Mlt, SplatsAreAPartOfTheState) {
  GltfWriter writer;
  writer.mesh(inside_out(box(glm::vec3(-1.0f), glm::vec3(1.0f))),
              writer.material(lambert({0.7, 0.5, 0.2})));
  writer.point_light({0.4, 0.5, 0.2}, {1.0, 0.8, 0.6}, 2.0);
  writer.camera("inside", {0.3, 0.1, 0.8}, {0.0, -0.3, -1.0}, 1.2);
  const scene::Scene scene = load(writer);
  render::Settings settings = settings_of(scene);
  settings.integrator = "bdpt";
  const auto samples = replicate(device(), scene, settings, 12, kSeeds, blocks_and_whole);
  settings.integrator = "mlt";
  for (const std::uint32_t ways : {PPM_BDPT_LENS, PPM_BDPT_NEXT_EVENT}) {
    settings.bdpt_strategies = ways;
    const auto blocks = replicate(device(), scene, settings, 24, kSeeds, blocks_and_whole);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      EXPECT_TRUE(agrees(blocks[i], samples[i].mean, kSigmas, 5.0 * samples[i].standard_error))
          << "ways " << ways << ", block " << i;
      EXPECT_LT(blocks[i].standard_error.x, 0.06 * samples[i].mean.x) << ways << ", " << i;
    }
  }
}

TEST_F(Mlt, IsTheSameForAnyTiles) {
  const scene::Scene scene = load(small_room());
  render::Settings settings = settings_of(scene);
  const auto whole_picture = render_scene(device(), scene, settings, 2).picture;
  EXPECT_TRUE(same_bits(whole_picture, render_scene(device(), scene, settings, 2).picture));
  settings.tile_hits = 300;
  EXPECT_TRUE(same_bits(whole_picture, render_scene(device(), scene, settings, 2).picture));
}

TEST_F(Mlt, InterruptedPassIsUndone) {
  const scene::Scene scene = load(small_room());
  render::Settings settings = settings_of(scene);
  settings.mlt_chains = 64;  // four steps a pass
  Log log(Verbosity::quiet);
  const auto never = [] { return false; };
  const auto integrator = render::make_integrator(settings, scene, device(), log, 1);
  ASSERT_TRUE(integrator->prepare(never));
  ASSERT_TRUE(integrator->advance(never));
  const auto before = integrator->resolve();
  unsigned polls = 0;
  EXPECT_FALSE(integrator->advance([&] { return ++polls > 7; }));
  EXPECT_TRUE(same_bits(before, integrator->resolve()));
  ASSERT_TRUE(integrator->advance(never));
  EXPECT_TRUE(same_bits(integrator->resolve(), render_scene(device(), scene, settings, 2).picture));
}

// Also where the rest is rendered in other tiles.
TEST_F(Mlt, GoesOnFromASavedState) {
  const scene::Scene scene = load(small_room());
  render::Settings settings = settings_of(scene);
  settings.mlt_chains = 64;
  Log log(Verbosity::quiet);
  const auto never = [] { return false; };
  const auto made = [&](const render::Settings& own) {
    return render::make_integrator(own, scene, device(), log, 1);
  };
  const auto first = made(settings);
  ASSERT_TRUE(first->prepare(never));
  ASSERT_TRUE(first->advance(never));
  const render::SavedState state = first->save_state();
  const auto before = first->resolve();
  ASSERT_TRUE(first->advance(never));

  render::Settings other = settings;
  other.tile_hits = 50;
  const auto second = made(other);
  second->restore_state(state);
  EXPECT_EQ(second->save_state(), state);
  EXPECT_TRUE(same_bits(before, second->resolve()));
  ASSERT_TRUE(second->advance(never));
  EXPECT_TRUE(same_bits(first->resolve(), second->resolve()));
  EXPECT_EQ(second->statistics().mutations, 2u);

  other.seed = 1;
  EXPECT_THROW(made(other)->restore_state(state), Failure);
  other = settings;
  other.mlt_chains = 65;
  EXPECT_THROW(made(other)->restore_state(state), Failure);
  for (const std::ptrdiff_t missing : {1, 16, 5000})
    EXPECT_THROW(made(settings)->restore_state({state.begin(), state.end() - missing}), Failure);
  EXPECT_THROW(made(settings)->restore_state({}), Failure);
}

}  // namespace
}  // namespace ppm::test
