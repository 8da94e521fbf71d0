// What is done when memory is short never shows: eye paths traced anew for each pass, films that
// are not kept, allocations that fail.
#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "call.hpp"
#include "failure.hpp"
#include "layers.hpp"
#include "small_room.hpp"

namespace ppm::test {
namespace {

constexpr unsigned kPasses = 3;

bool never() {
  return false;
}

class Thrift : public RenderTest {
 protected:
  Thrift() : scene_(load(small_room())), settings_(room_settings(scene_)) {}

  void TearDown() override {
    gpu::fault_injection() = {};
    RenderTest::TearDown();
  }

  std::unique_ptr<render::Integrator> make(const render::Settings& settings) {
    return render::make_integrator(settings, scene_, device(), log_, 2);
  }

  scene::Scene scene_;
  render::Settings settings_;
  Log log_{Verbosity::quiet};
};

// Where tiles are traced anew photons may come in one chunk, which is traced once for all tiles, or
// in several.
TEST_F(Thrift, HitPointsTracedAnewMakeTheSamePicture) {
  for (const auto mode : {render::RadiusMode::automatic, render::RadiusMode::footprint}) {
    settings_.radius_mode = mode;
    const Rendering kept = render_scene(device(), scene_, settings_, kPasses);
    for (const auto& [tile_hits, photons] :
         {std::pair(1u << 20, 1u << 19), std::pair(700u, 1u << 19), std::pair(900u, 6000u)}) {
      render::Settings anew = settings_;
      anew.traces_anew = true;
      anew.tile_hits = tile_hits;
      anew.photon_capacity = photons;
      const Rendering other = render_scene(device(), scene_, anew, kPasses);
      const std::string what =
          std::to_string(tile_hits) + " hit points a tile, " + std::to_string(photons) + " photons";
      EXPECT_TRUE(same_bits(kept.picture, other.picture)) << what;
      EXPECT_EQ(kept.statistics.hit_points, other.statistics.hit_points) << what;
      EXPECT_EQ(kept.statistics.photons_stored, other.statistics.photons_stored) << what;
      EXPECT_EQ(kept.statistics.photon_rays, other.statistics.photon_rays) << what;
      EXPECT_EQ(kept.statistics.initial_radius_median, other.statistics.initial_radius_median);
      EXPECT_EQ(other.statistics.tiles > 1, tile_hits < 1000) << what;
    }
  }
}

TEST_F(Thrift, OfClassicPhotonMappingToo) {
  settings_.integrator = "pm";
  settings_.map_photons = 20000;
  settings_.nearest = 50;
  const auto picture = [&](const render::Settings& settings) {
    const auto integrator = make(settings);
    EXPECT_TRUE(integrator->prepare(never));
    EXPECT_TRUE(integrator->advance(never));
    integrator->resolve();  // the next one begins with its radii
    while (!integrator->complete()) EXPECT_TRUE(integrator->advance(never));
    return std::pair(integrator->resolve(), integrator->statistics().nearest_radius_median);
  };
  const auto kept = picture(settings_);
  settings_.traces_anew = true;
  for (const std::uint64_t tile_hits : {1u << 20, 700u}) {
    settings_.tile_hits = tile_hits;
    const auto anew = picture(settings_);
    EXPECT_TRUE(same_bits(kept.first, anew.first)) << tile_hits;
    EXPECT_EQ(kept.second, anew.second);
  }
}

TEST_F(Thrift, LayersAndProbesAreTheSame) {
  constexpr std::array kKinds = {render::LayerKind::radius, render::LayerKind::photons,
                                 render::LayerKind::density, render::LayerKind::direct_emission,
                                 render::LayerKind::depth};
  const auto rendered = [&] {
    auto integrator = make(settings_);
    EXPECT_TRUE(integrator->prepare(never));
    EXPECT_TRUE(integrator->advance(never));
    return integrator;
  };
  const auto kept = rendered();
  settings_.traces_anew = true;
  settings_.tile_hits = 700;
  const auto anew = rendered();
  const auto a = render::layers_of(*kept, kKinds), b = render::layers_of(*anew, kKinds);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].values.size(), b[i].values.size());
    EXPECT_EQ(
        std::memcmp(a[i].values.data(), b[i].values.data(), a[i].values.size() * sizeof(float)), 0)
        << a[i].name;
  }
  for (const glm::uvec2 at : {glm::uvec2(0, 0), glm::uvec2(11, 9), glm::uvec2(23, 17)}) {
    const auto p = kept->probe(at.x, at.y), q = anew->probe(at.x, at.y);
    ASSERT_TRUE(p && q);
    EXPECT_EQ(p->photons, q->photons);
    EXPECT_EQ(p->radius, q->radius);
    EXPECT_EQ(p->radiance, q->radiance);
  }
}

// In both directions, and another picture in no case: how hit points are kept is nothing that a
// saved state would know.
TEST_F(Thrift, SavedStatesGoOnEitherWay) {
  render::Settings anew = settings_;
  anew.traces_anew = true;
  anew.tile_hits = 900;
  const render::Picture expected = render_scene(device(), scene_, settings_, kPasses).picture;
  for (const auto& [before, after] : {std::pair(settings_, anew), std::pair(anew, settings_)}) {
    const auto first = make(before);
    ASSERT_TRUE(first->prepare(never));
    ASSERT_TRUE(first->advance(never));
    const auto second = make(after);
    second->restore_state(first->save_state());
    EXPECT_EQ(second->save_state(), first->save_state());
    for (unsigned pass = 1; pass < kPasses; ++pass) EXPECT_TRUE(second->advance(never));
    EXPECT_TRUE(same_bits(second->resolve(), expected));
  }
}

/// Says yes from the n-th time on that it is asked.
class Nuisance {
 public:
  explicit Nuisance(unsigned at) : left_(at) {}
  bool operator()() { return left_ == 0 || --left_ == 0; }

 private:
  unsigned left_;
};

// Interrupted anywhere, a pass is either discarded or complete.
TEST_F(Thrift, InterruptedPassesAreDiscardedOrFinished) {
  for (const char* method : {"ppm", "pt", "bdpt", "mlt"}) {
    SCOPED_TRACE(method);
    render::Settings thrifty = settings_;
    thrifty.integrator = method;
    thrifty.mlt_chains = 40;
    const render::Picture expected = render_scene(device(), scene_, thrifty, kPasses).picture;
    thrifty.traces_anew = true;
    thrifty.keeps_film = false;
    thrifty.tile_hits = std::string(method) == "ppm" ? 700 : 100;
    const auto integrator = make(thrifty);
    ASSERT_TRUE(integrator->prepare(never));
    ASSERT_TRUE(integrator->advance(never));
    const render::SavedState state = integrator->save_state();
    unsigned discarded = 0;
    while (!integrator->advance(Nuisance(discarded + 1))) {
      ++discarded;
      ASSERT_LT(discarded, 1000u);
      ASSERT_EQ(integrator->save_state(), state) << "at poll " << discarded;
    }
    EXPECT_GT(discarded, 0u);
    EXPECT_EQ(integrator->statistics().passes, 2u);
    ASSERT_TRUE(integrator->advance(never));
    EXPECT_TRUE(same_bits(integrator->resolve(), expected));
  }
}

TEST_F(Thrift, MoreHitPointsThanAllowedAreTracedAnew) {
  const Rendering kept = render_scene(device(), scene_, settings_, kPasses);
  settings_.tile_hits = 700;
  settings_.pass_allowance = 1;
  const std::uint64_t before = device().allocated_bytes();
  const auto integrator = make(settings_);
  const std::uint64_t made = device().allocated_bytes();
  ASSERT_TRUE(integrator->prepare(never));
  // Of some 3000 hit points none stays but those of one tile.
  EXPECT_GT(integrator->statistics().tiles, 3u);
  for (unsigned pass = 0; pass < kPasses; ++pass) ASSERT_TRUE(integrator->advance(never));
  EXPECT_TRUE(same_bits(integrator->resolve(), kept.picture));
  EXPECT_LT(device().allocated_bytes() - made, made - before);
}

// Every allocation of the preparation fails once; what has been made by then is made again in
// smaller pieces, and said once.
TEST_F(Thrift, AllocationsThatFailWhilePreparingAreMadeGoodFor) {
  for (const char* method : {"ppm", "pm"}) {
    SCOPED_TRACE(method);
    settings_.integrator = method;
    settings_.map_photons = 5000;
    const render::Picture expected = render_scene(device(), scene_, settings_, 1).picture;
    unsigned failures = 0;
    gpu::FaultInjection& injection = gpu::fault_injection();
    for (std::uint64_t call = 1; failures < 12; call += 9) {
      Log log(Verbosity::quiet);
      const auto integrator = render::make_integrator(settings_, scene_, device(), log, 1);
      injection = {.fail_at = call, .result = VK_ERROR_OUT_OF_DEVICE_MEMORY};
      ASSERT_TRUE(integrator->prepare(never)) << "call " << call;
      const char* const failed = injection.failed;
      injection = {};
      if (!failed) break;
      ++failures;
      EXPECT_LE(log.warnings().size(), 1u) << failed;
      ASSERT_TRUE(integrator->advance(never));
      EXPECT_TRUE(same_bits(integrator->resolve(), expected)) << failed << ", call " << call;
    }
    EXPECT_GT(failures, 5u);
  }
}

}  // namespace
}  // namespace ppm::test
