// Methods against what is known of scenes, against each other, and against themselves however the
// work is cut. A new method is a line of kMethods.
//
// 16 seeds are 15 degrees of freedom: Student's t passes 7 in 4e-6 of all cases, so that one of the
// several hundred comparisons errs with a probability of some 1e-3 [Sidak: 1 - (1 - 4e-6)^n].
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "agreement_scenes.hpp"
#include "failure.hpp"
#include "small_room.hpp"

namespace ppm::test {
namespace {

constexpr unsigned kSeeds = 16;
constexpr double kSigmas = 7.0;

struct Method {
  const char* name;
  double effort;                   ///< passes, in the scene's own measure
  std::vector<std::string> blind;  ///< scenes whose light it cannot find

  unsigned passes(unsigned scene_effort) const {
    return static_cast<unsigned>(std::ceil(effort * scene_effort));
  }
};
void PrintTo(const Method& method, std::ostream* stream) {
  *stream << method.name;
}

const std::vector<Method> kMethods = {{"pt", 1.0, {}},
                                      {"pt-mis", 1.0, {}},
                                      {"bdpt", 1.0, {}},
                                      {"lt", 2.0, {"furnace_with_guests", "mirror"}}};

std::string identifier(std::string name) {
  std::ranges::replace(name, '-', '_');
  return name;
}

render::Settings settings_for(const scene::Scene& scene, const std::string& method,
                              std::uint32_t pixels) {
  render::Settings settings = small_settings(scene, pixels, pixels);
  settings.integrator = method;
  return settings;
}

// ---- What is known

class Agreement : public RenderTest, public ::testing::WithParamInterface<AgreementScene> {};

TEST_P(Agreement, WithWhatIsKnown) {
  const AgreementScene& known = GetParam();
  const scene::Scene scene = known.make();
  for (const Method& method : kMethods) {
    if (std::ranges::find(method.blind, known.name) != method.blind.end()) continue;
    render::Settings settings = settings_for(scene, method.name, kAgreementPixels);
    settings.max_depth = known.max_depth;
    const auto blocks = replicate(
        device(), scene, settings, method.passes(known.effort), kSeeds,
        [](const render::Picture& picture) { return block_means(picture, kAgreementBlock); });
    const std::vector<glm::dvec3> expected = known.expected(settings);
    ASSERT_EQ(blocks.size(), expected.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      EXPECT_TRUE(agrees(blocks[i], expected[i], kSigmas, known.slack * expected[i]))
          << method.name << ", block " << i;
      // Nor may noise hide what is wrong.
      const glm::dvec3 noise = blocks[i].standard_error / expected[i];
      EXPECT_LT(std::max({noise.x, noise.y, noise.z}), 0.03) << method.name << ", block " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Table, Agreement, ::testing::ValuesIn(agreement_scenes()),
                         [](const auto& test) { return std::string(test.param.name); });

// ---- Each other

constexpr std::uint32_t kRoomPixels = 24, kRoomBlock = 6;
constexpr unsigned kRoomEffort = 12;

std::vector<Estimate> room_blocks(gpu::Device& device, const scene::Scene& scene,
                                  const render::Settings& settings, unsigned passes) {
  return replicate(device, scene, settings, passes, kSeeds,
                   [](const render::Picture& picture) { return block_means(picture, kRoomBlock); });
}

Estimate difference(const Estimate& a, const Estimate& b) {
  return {a.mean - b.mean,
          glm::sqrt(a.standard_error * a.standard_error + b.standard_error * b.standard_error)};
}

class Room : public RenderTest {};

TEST_F(Room, LooksTheSameByEveryMethod) {
  const scene::Scene scene = load(glossy_room());
  const auto rendered = [&](const Method& method) {
    return room_blocks(device(), scene, settings_for(scene, method.name, kRoomPixels),
                       method.passes(kRoomEffort));
  };
  const std::vector<Estimate> first = rendered(kMethods[0]);
  const auto compare = [&](const char* name, const std::vector<Estimate>& other, double bias) {
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_TRUE(
          agrees(difference(first[i], other[i]), glm::dvec3(0.0), kSigmas, bias * first[i].mean))
          << name << ", block " << i;
    }
  };
  for (std::size_t m = 1; m < kMethods.size(); ++m) {
    compare(kMethods[m].name, rendered(kMethods[m]), 0.0);
  }
  // Photon mapping sees each block through discs of 0.04 in a room of 2: what they blur across
  // edges and folds, and miss at them, is a few hundredths of a block that shows half a metre.
  render::Settings settings = settings_for(scene, "ppm", kRoomPixels);
  settings.samples_per_pixel = 4;
  settings.radius_mode = render::RadiusMode::fixed;
  settings.radius = 0.04;
  compare("ppm", room_blocks(device(), scene, settings, 2), 0.03);
  // The 30 nearest of some 10^5 lie in discs a little larger, and exceed their density by 30 / 29.
  settings.integrator = "pm";
  settings.radius_mode = render::RadiusMode::automatic;
  settings.nearest = 30;
  std::vector<Estimate> nearest = room_blocks(device(), scene, settings, 4);
  for (Estimate& block : nearest) block.mean *= 29.0 / 30.0;
  compare("pm", nearest, 0.04);
}

// ---- Themselves

class Reproducible : public RenderTest, public ::testing::WithParamInterface<Method> {
 protected:
  static constexpr unsigned kSamples = 5;
  Reproducible()
      : scene_(load(small_room())), settings_(room_settings(scene_)), log_(Verbosity::quiet) {
    settings_.integrator = GetParam().name;
  }
  render::Picture rendered(const render::Settings& settings) {
    return render_scene(device(), scene_, settings, kSamples).picture;
  }
  std::unique_ptr<render::Integrator> made(const render::Settings& settings) {
    return render::make_integrator(settings, scene_, device(), log_, 2);
  }
  static bool never() { return false; }

  scene::Scene scene_;
  render::Settings settings_;
  Log log_;
};

TEST_P(Reproducible, HoweverTheWorkIsCut) {
  const render::Picture picture = rendered(settings_);
  EXPECT_GT(window_mean(picture, whole(settings_)).x, 0.1);
  EXPECT_TRUE(same_bits(picture, rendered(settings_)));
  render::Settings parts = settings_;
  parts.tile_hits = 100;
  EXPECT_TRUE(same_bits(picture, rendered(parts)));
  render::Settings other = settings_;
  other.seed = 1;
  EXPECT_FALSE(same_bits(picture, rendered(other)));

  const auto one_by_one = made(settings_);
  ASSERT_TRUE(one_by_one->prepare(never));
  for (unsigned sample = 0; sample < kSamples; ++sample) ASSERT_TRUE(one_by_one->advance(never));
  EXPECT_TRUE(same_bits(picture, one_by_one->resolve()));
  EXPECT_EQ(one_by_one->statistics().samples, kSamples);

  const char* const selector = std::getenv("PPM_TEST_DEVICE");
  gpu::Device hasty(
      {.selector = selector ? selector : "", .validation = true, .dispatch_milliseconds = 0.2});
  EXPECT_TRUE(same_bits(picture, render_scene(hasty, scene_, settings_, kSamples).picture));
}

// A pass that is interrupted between its parts leaves no trace.
TEST_P(Reproducible, InterruptedPassesAreDiscarded) {
  settings_.tile_hits = 100;
  const auto integrator = made(settings_);
  ASSERT_TRUE(integrator->prepare(never));
  ASSERT_TRUE(integrator->advance(never));
  const render::Picture before = integrator->resolve();
  int polls = 0;
  EXPECT_FALSE(integrator->advance([&] { return ++polls > 3; }));
  EXPECT_EQ(integrator->statistics().passes, 1u);
  EXPECT_TRUE(same_bits(before, integrator->resolve()));
  for (unsigned sample = 1; sample < kSamples; ++sample) {
    ASSERT_TRUE(integrator->advance(never));
  }
  EXPECT_TRUE(same_bits(rendered(settings_), integrator->resolve()));
}

TEST_P(Reproducible, GoesOnFromASavedState) {
  const auto first = made(settings_);
  ASSERT_TRUE(first->prepare(never));
  for (unsigned made = 0; made < 2;)
    made += static_cast<unsigned>(first->advance_up_to(2 - made, never));
  const render::SavedState state = first->save_state();
  const auto second = made(settings_);
  second->restore_state(state);
  for (unsigned sample = 2; sample < kSamples; ++sample) ASSERT_TRUE(second->advance(never));
  EXPECT_TRUE(same_bits(rendered(settings_), second->resolve()));
  render::Settings other = settings_;
  other.seed = 1;
  EXPECT_THROW(made(other)->restore_state(state), Failure);
  EXPECT_THROW(made(settings_)->restore_state({state.begin(), state.end() - 4}), Failure);
}

INSTANTIATE_TEST_SUITE_P(Methods, Reproducible, ::testing::ValuesIn(kMethods),
                         [](const auto& test) { return identifier(test.param.name); });

}  // namespace
}  // namespace ppm::test
