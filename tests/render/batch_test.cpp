// Passes that the device is given several at a time are the passes made one by one, to the byte.
#include <memory>
#include <utility>
#include <vector>

#include "small_room.hpp"

namespace ppm::test {
namespace {

constexpr std::uint64_t kPasses = 7;

bool never() {
  return false;
}

class Batch : public RenderTest {
 protected:
  Batch() : scene_(load(small_room())), settings_(room_settings(scene_)) {}

  std::unique_ptr<render::Integrator> make(std::uint32_t in_flight) {
    settings_.passes_in_flight = in_flight;
    return render::make_integrator(settings_, scene_, device(), log_, 2);
  }

  struct Run {
    render::Picture picture;
    render::Statistics statistics;
    render::SavedState state;
    std::vector<std::uint64_t> made;  // passes at a time
  };

  Run run(std::uint32_t in_flight, std::uint64_t passes = kPasses) {
    const auto integrator = make(in_flight);
    EXPECT_TRUE(integrator->prepare(never));
    Run run;
    for (std::uint64_t done = 0; done < passes; done += run.made.back()) {
      run.made.push_back(integrator->advance_up_to(passes - done, never));
      if (run.made.back() == 0) {
        ADD_FAILURE() << "interrupted by nobody";
        break;
      }
    }
    run.picture = integrator->resolve();
    run.statistics = integrator->statistics();
    run.state = integrator->save_state();
    return run;
  }

  static void expect_same(const Run& run, const Run& expected) {
    EXPECT_TRUE(same_bits(run.picture, expected.picture));
    EXPECT_EQ(run.state, expected.state);
    const render::Statistics &a = run.statistics, &b = expected.statistics;
    EXPECT_EQ(a.passes, kPasses);
    EXPECT_EQ(a.photons_emitted, b.photons_emitted);
    EXPECT_EQ(a.photons_stored, b.photons_stored);
    EXPECT_EQ(a.photon_rays, b.photon_rays);
    EXPECT_EQ(a.paths_cut, b.paths_cut);
    EXPECT_EQ(a.rejected, b.rejected);
    EXPECT_EQ(a.pass_seconds.size(), kPasses);
  }

  scene::Scene scene_;
  render::Settings settings_;
  Log log_{Verbosity::quiet};
};

using Made = std::vector<std::uint64_t>;

TEST_F(Batch, LeavesNoTraceInThePicture) {
  for (const std::uint64_t tile_hits : {1u << 20, 900u}) {
    settings_.tile_hits = tile_hits;
    const Run one_by_one = run(1);
    EXPECT_EQ(one_by_one.made, Made(kPasses, 1));
    EXPECT_GT(one_by_one.statistics.photons_stored, 0u);
    for (const auto& [in_flight, made] :
         {std::pair{2u, Made{2, 2, 2, 1}}, std::pair{3u, Made{3, 3, 1}}, std::pair{16u, Made{7}}}) {
      const Run batched = run(in_flight);
      EXPECT_EQ(batched.made, made);
      expect_same(batched, one_by_one);
    }
  }
}

// Without a pilot nothing is known of how many photons a path leaves. In a room of white walls they
// are more than first thought, so that the first batch does not fit; a smaller one does.
TEST_F(Batch, OfTooManyPhotonsIsMadeSmaller) {
  for (scene::Material& material : scene_.materials) {
    if (glm::length(material.emission) == 0.0f) material.base_color = glm::vec3(0.95f);
  }
  settings_.radius_mode = render::RadiusMode::fixed;
  settings_.radius = 0.05;
  const Run one_by_one = run(1);
  const std::uint64_t photons = one_by_one.statistics.photons_stored / kPasses;
  ASSERT_GT(photons, settings_.photons_per_pass * 6);
  settings_.photon_capacity = photons * 5 / 2;
  const Run batched = run(16);
  EXPECT_EQ(batched.made, (Made{2, 2, 2, 1}));
  expect_same(batched, one_by_one);
  settings_.photon_capacity = photons / 3;  // not even one pass fits
  const Run chunked = run(16);
  EXPECT_EQ(chunked.made, Made(kPasses, 1));
  expect_same(chunked, one_by_one);
}

// Discs with more photons than one dispatch looks at: chunks of few photons know nothing of that.
TEST_F(Batch, WithLongSearchesIsFinishedByTheHostAndThenByItself) {
  settings_.radius_mode = render::RadiusMode::fixed;
  settings_.radius = 0.7;
  settings_.photons_per_pass = 20000;
  for (const std::uint64_t tile_hits : {1u << 20, 900u}) {
    settings_.tile_hits = tile_hits;
    settings_.photon_capacity = 6000;
    const Run chunked = run(1);
    settings_.photon_capacity = 1u << 19;
    const Run batched = run(4);
    EXPECT_EQ(batched.made.front(), 1u);
    EXPECT_EQ(batched.made.back(), 2u);
    expect_same(batched, chunked);
  }
}

// Says yes at the n-th time it is asked, and from then on.
class Stop {
 public:
  explicit Stop(unsigned at) : left_(at) {}
  bool operator()() {
    if (left_ > 0) --left_;
    return left_ == 0;
  }

 private:
  unsigned left_;
};

// Wherever it is stopped: so many whole passes, as if no more had been asked for.
TEST_F(Batch, InterruptedLeavesWholePasses) {
  settings_.tile_hits = 2000;
  std::vector<render::SavedState> expected;
  for (std::uint64_t passes = 0; passes <= 3; ++passes) expected.push_back(run(1, passes).state);
  std::uint64_t made = 0;
  std::vector<std::uint64_t> seen(4, 0);
  for (unsigned at = 1; made < 3; ++at) {
    ASSERT_LT(at, 100u);
    const auto integrator = make(3);
    ASSERT_TRUE(integrator->prepare(never));
    made = integrator->advance_up_to(3, Stop(at));
    ASSERT_LE(made, 3u);
    ++seen[made];
    EXPECT_EQ(integrator->statistics().passes, made);
    ASSERT_EQ(integrator->save_state(), expected[made]) << "at poll " << at;
  }
  EXPECT_GT(seen[0], 0u);
  EXPECT_GT(seen[1], 0u);
  EXPECT_GT(seen[2], 0u);
}

}  // namespace
}  // namespace ppm::test
