// Metropolis light transport: as bright as independent samples say, wherever the light is, however
// many chains share the mutations.
#include <string>

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
  const render::Settings settings = settings_of(scene);
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

}  // namespace
}  // namespace ppm::test
