// A rendering that is cut up in every way at once (small tiles, short dispatches, few photons at a
// time), stopped in the middle and cut otherwise from there on: picture, layers and state are those
// of the plain one, to the byte.
#include <algorithm>
#include <cstring>
#include <string>

#include "implementation.hpp"
#include "layers.hpp"
#include "small_room.hpp"

namespace ppm::test {
namespace {

constexpr std::uint64_t kPasses = 5, kMiddle = 2;

bool never() {
  return false;
}

struct Cut {
  std::uint64_t tile_hits, photon_capacity;
  std::uint32_t passes_in_flight;
  double dispatch_milliseconds;
};
// The plain one is in one piece: 1728 hit points, passes of some 20 000 photons stored.
constexpr Cut kPlain{1u << 20, 1u << 19, 1, 1000.0};
constexpr Cut kFirst{300, 3000, 1, 0.01};
constexpr Cut kSecond{1000, 1u << 19, 2, 0.2};

class Division : public RenderTest, public ::testing::WithParamInterface<std::string> {
 protected:
  Division() : scene_(load(small_room())), settings_(room_settings(scene_)) {
    settings_.integrator = GetParam();
    settings_.map_photons = 60000;  // more than kPasses bring
    settings_.nearest = 30;
    for (const render::LayerFacts& facts : render::all_layers()) {
      if (render::method_has_layer(GetParam(), facts.kind)) kinds_.push_back(facts.kind);
    }
  }
  void SetUp() override {
    RenderTest::SetUp();
    milliseconds_before_ = device().implementation().options.dispatch_milliseconds;
  }
  void TearDown() override {
    device().implementation().options.dispatch_milliseconds = milliseconds_before_;
    RenderTest::TearDown();
  }

  std::unique_ptr<render::Integrator> make(const Cut& cut) {
    settings_.tile_hits = cut.tile_hits;
    settings_.photon_capacity = cut.photon_capacity;
    settings_.passes_in_flight = cut.passes_in_flight;
    device().implementation().options.dispatch_milliseconds = cut.dispatch_milliseconds;
    return render::make_integrator(settings_, scene_, device(), log_, 2);
  }
  static void advance(render::Integrator& integrator, std::uint64_t passes) {
    for (std::uint64_t made = 0, now = 0; made < passes; made += now) {
      now = integrator.advance_up_to(passes - made, never);
      ASSERT_GT(now, 0u);
    }
  }
  static std::uint64_t dispatches() {
    std::uint64_t count = 0;
    for (const auto& [name, time] : device().times()) count += time.dispatches;
    return count;
  }

  scene::Scene scene_;
  render::Settings settings_;
  std::vector<render::LayerKind> kinds_;
  Log log_{Verbosity::quiet};
  double milliseconds_before_ = 0.0;
};

void expect_same(const std::vector<image::Layer>& layers,
                 const std::vector<image::Layer>& expected) {
  ASSERT_EQ(layers.size(), expected.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    EXPECT_EQ(layers[i].name, expected[i].name);
    ASSERT_EQ(layers[i].values.size(), expected[i].values.size());
    EXPECT_EQ(std::memcmp(layers[i].values.data(), expected[i].values.data(),
                          layers[i].values.size() * sizeof(float)),
              0)
        << layers[i].name;
  }
}

TEST_P(Division, TiledSplitAndResumedIsThePlainOneToTheByte) {
  const std::uint64_t at_first = dispatches();
  const auto plain = make(kPlain);
  ASSERT_TRUE(plain->prepare(never));
  advance(*plain, kPasses);
  const std::uint64_t after_plain = dispatches();

  render::SavedState middle;
  {
    const auto first = make(kFirst);
    ASSERT_TRUE(first->prepare(never));
    advance(*first, kMiddle);
    middle = first->save_state();
  }
  const auto second = make(kSecond);
  second->restore_state(middle);
  advance(*second, kPasses - kMiddle);
  EXPECT_GT(dispatches() - after_plain, after_plain - at_first) << "it was not cut";

  EXPECT_GT(window_mean(plain->resolve(), whole(settings_)).x, 0.1);
  EXPECT_TRUE(same_bits(second->resolve(), plain->resolve()));
  EXPECT_EQ(second->save_state(), plain->save_state());
  ASSERT_FALSE(kinds_.empty());
  expect_same(render::layers_of(*second, kinds_), render::layers_of(*plain, kinds_));
  EXPECT_EQ(second->statistics().passes, kPasses);
}

std::vector<std::string> names_of_methods() {
  std::vector<std::string> names;
  for (const render::Method& method : render::methods()) names.emplace_back(method.name);
  return names;
}

// All that there are: a new method is in.
INSTANTIATE_TEST_SUITE_P(Methods, Division, ::testing::ValuesIn(names_of_methods()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace ppm::test
