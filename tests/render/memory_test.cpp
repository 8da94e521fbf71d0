// What a rendering holds does not grow with its passes.
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "integrator.hpp"
#include "small_room.hpp"

namespace ppm::test {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr bool kFreedIsReturned = false;  // it is kept aside, to catch uses of it
#else
constexpr bool kFreedIsReturned = true;
#endif

constexpr std::uint64_t kEarlyPasses = 3;
constexpr std::uint64_t kLaterPasses = 24;
// A kernel that the driver compiles anew takes 0.5 MB and more, at each of its dispatches; the rest
// is room for how malloc cuts its pieces.
constexpr std::uint64_t kAllowedBytes = 6u << 20;

std::uint64_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  statm >> all >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

class MemoryOf : public RenderTest, public ::testing::WithParamInterface<render::Method> {};

TEST_P(MemoryOf, ManyPassesIsThatOfFew) {
  if (!kFreedIsReturned) GTEST_SKIP() << "the sanitiser holds on to what is freed";
  const scene::Scene scene = load(small_room());
  render::Settings settings = room_settings(scene);
  settings.integrator = GetParam().name;
  settings.mlt_chains = 128;
  settings.map_photons = 20000;  // what pm holds does grow, up to these
  Log log(Verbosity::quiet);
  const auto integrator = render::make_integrator(settings, scene, device(), log, 1);
  const auto never = [] { return false; };
  ASSERT_TRUE(integrator->prepare(never));
  const auto render_until = [&](std::uint64_t passes) {
    while (integrator->statistics().passes < passes && !integrator->complete()) {
      ASSERT_GT(integrator->advance_up_to(1, never), 0u);
    }
  };
  render_until(kEarlyPasses);
  const std::uint64_t before = resident_bytes();
  ASSERT_GT(before, 0u);
  render_until(kEarlyPasses + kLaterPasses);
  EXPECT_LT(resident_bytes(), before + kAllowedBytes);
}

INSTANTIATE_TEST_SUITE_P(Methods, MemoryOf, ::testing::ValuesIn(render::methods()),
                         [](const auto& test) {
                           std::string name(test.param.name);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace ppm::test
