// A camera that is put in the place of another: as from a new integrator, to the byte.
#include <string>

#include "small_room.hpp"

namespace ppm::test {
namespace {

constexpr unsigned kPasses = 2;

class LookFrom : public RenderTest, public ::testing::WithParamInterface<std::string> {
 protected:
  LookFrom() : scene_(load(small_room())), settings_(room_settings(scene_)) {
    settings_.integrator = GetParam();
    settings_.map_photons = 20000;
    settings_.nearest = 50;
    settings_.mlt_chains = 32;
    // The second camera is in the glass ball, whose medium the first one is not in.
    inside_ = settings_.camera;
    inside_.position = scene_.frame.to_working({0.375, -0.5, -0.125});
    inside_.yfov = 1.3;
  }

  std::unique_ptr<render::Integrator> make(const render::Settings& settings) {
    return render::make_integrator(settings, scene_, device(), log_, 2);
  }

  static void expect_same(render::Integrator& a, render::Integrator& b) {
    EXPECT_TRUE(same_bits(a.resolve(), b.resolve()));
    EXPECT_EQ(a.save_state(), b.save_state());
    const render::Statistics& x = a.statistics();
    const render::Statistics& y = b.statistics();
    EXPECT_EQ(x.passes, y.passes);
    EXPECT_EQ(x.photons_emitted, y.photons_emitted);
    EXPECT_EQ(x.photons_stored, y.photons_stored);
    EXPECT_EQ(x.map_photons, y.map_photons);
    EXPECT_EQ(x.samples, y.samples);
    EXPECT_EQ(x.mutations, y.mutations);
    EXPECT_EQ(x.hit_points, y.hit_points);
    EXPECT_EQ(x.triangles, y.triangles);
    EXPECT_EQ(x.lights, y.lights);
    EXPECT_EQ(x.rejected, y.rejected);
    EXPECT_EQ(x.initial_radius_median, y.initial_radius_median);
  }

  scene::Scene scene_;
  render::Settings settings_;
  scene::Camera inside_;
  Log log_{Verbosity::quiet};
};

void begin(render::Integrator& integrator, unsigned passes) {
  const auto never = [] { return false; };
  ASSERT_TRUE(integrator.prepare(never));
  for (unsigned pass = 0; pass < passes; ++pass) ASSERT_TRUE(integrator.advance(never));
}

TEST_P(LookFrom, BeginsAnewThere) {
  const auto moved = make(settings_);
  begin(*moved, 3);
  moved->resolve();
  moved->probe(12, 9);
  moved->look_from(inside_);
  begin(*moved, kPasses);

  render::Settings settings = settings_;
  settings.camera = inside_;
  const auto fresh = make(settings);
  begin(*fresh, kPasses);
  expect_same(*moved, *fresh);
  const auto reading = moved->probe(12, 9), expected = fresh->probe(12, 9);
  ASSERT_EQ(reading.has_value(), expected.has_value());
  if (reading) {
    EXPECT_EQ(reading->radius, expected->radius);
  }

  moved->look_from(settings_.camera);  // and back
  begin(*moved, kPasses);
  const auto first = make(settings_);
  begin(*first, kPasses);
  EXPECT_FALSE(same_bits(first->resolve(), fresh->resolve()));
  expect_same(*moved, *first);
}

// At every point at which preparation and the first pass can be left.
TEST_P(LookFrom, LeavesNoTraceOfWhatWasInterrupted) {
  const auto expected = make(settings_);
  begin(*expected, kPasses);
  const auto moved = make(settings_);
  bool prepared = false, passed = false;
  for (unsigned at = 1; !passed && at < 1000; at = at + 1 + at / 4) {
    unsigned left = at;
    const auto nuisance = [&] { return left > 0 && --left == 0; };
    prepared = moved->prepare(nuisance);
    passed = prepared && moved->advance(nuisance);
    moved->look_from(inside_);
  }
  EXPECT_TRUE(passed);
  moved->look_from(settings_.camera);
  begin(*moved, kPasses);
  expect_same(*moved, *expected);
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const render::Method& method : render::methods()) names.emplace_back(method.name);
  return names;
}

std::string test_name(const ::testing::TestParamInfo<std::string>& method) {
  std::string name = method.param;
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Methods, LookFrom, ::testing::ValuesIn(method_names()), test_name);

}  // namespace
}  // namespace ppm::test
