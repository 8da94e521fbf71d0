// Measuring, on a rendering that takes no time: which rows there are and how they add up.
#include "measure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <set>

#include "device_fixture.hpp"
#include "failure.hpp"
#include "machine.hpp"
#include "modeller.hpp"
#include "scaling.hpp"
#include "statistics.hpp"

namespace ppm::bench {
namespace {

constexpr float kHalf = 0.5f;

/// A closed grey box with a point light in it: every ray ends on a diffuse wall.
scene::Scene closed_box(Log& /*log*/) {
  scene::Scene scene;
  scene.file = "box";
  Modeller modeller(scene);
  std::array<std::uint32_t, 6> walls;
  walls.fill(modeller.diffuse("grey", glm::vec3(0.5f)));
  modeller.box(glm::vec3(0.0f), glm::vec3(kHalf), 0.0f, -1.0f, 1, walls);
  modeller.find_bounds();
  scene::PunctualLight light;
  light.intensity = glm::vec3(1.0f);
  scene.punctual_lights.push_back(light);
  scene.cameras.push_back(
      {"inside", {0.0, 0.0, 0.25}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 1.0, {}, {}});
  return scene;
}

render::Settings small_settings(const scene::Scene& scene, Log& /*log*/) {
  render::Settings settings;
  settings.width = 32;
  settings.height = 24;
  settings.samples_per_pixel = 1;
  settings.photons_per_pass = 500;
  settings.camera = scene.cameras.front();
  return settings;
}

class Measure : public tests::DeviceTest {
 protected:
  Measure() {
    const char* const selector = std::getenv("PPM_TEST_DEVICE");
    plan_.device.selector = selector ? selector : "";
    plan_.device.validation = true;
    plan_.repetitions = 2;
    plan_.passes = 2;
  }

  std::optional<std::vector<Row>> measure_box(const std::function<bool()>& interrupted = [] {
    return false;
  }) {
    return measure({{"box", closed_box, small_settings}}, plan_, interrupted, log_,
                   [](const std::string&) {});
  }

  Plan plan_;
  Log log_{Verbosity::quiet};
};

double sum_of_shares(const std::vector<Row>& rows, const std::string& prefix) {
  double sum = 0.0;
  for (const Row& row : rows) {
    if (row.name.starts_with(prefix)) sum += row.counters.at("share").front();
  }
  return sum;
}

TEST_F(Measure, RowsAddUp) {
  plan_.aged = true;
  const auto measured = measure_box();
  ASSERT_TRUE(measured);
  const std::vector<Row>& rows = *measured;
  std::set<std::string> names;
  for (const Row& row : rows) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name << " is there twice";
    EXPECT_EQ(row.seconds.size(), 2u) << row.name;
    EXPECT_GE(least(row.seconds), 0.0) << row.name;
    for (const auto& [counter, values] : row.counters) {
      EXPECT_EQ(values.size(), row.seconds.size()) << row.name << " " << counter;
      for (const double value : values) EXPECT_TRUE(std::isfinite(value)) << counter;
    }
  }
  for (const char* name : {"compile", "box/start", "box/pass", "box/aged/pass"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  // Whatever moves a known number of bytes still goes by the name that traffic.cpp knows.
  for (const char* kernel : {"photon", "grid_count", "grid_scatter", "gather", "update"}) {
    const std::string name = std::string("box/kernel:") + kernel;
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const Row& each) { return each.name == name; });
    ASSERT_NE(row, rows.end()) << name;
    EXPECT_GT(row->counters.at("bytes_streamed").front(), 0.0) << name;
  }
  for (const char* parts : {"box/start:", "box/start/kernel:", "box/kernel:", "box/aged/kernel:"}) {
    EXPECT_NEAR(sum_of_shares(rows, parts), 1.0, 1e-9) << parts;
  }
  const Row& compile = rows.front();
  EXPECT_EQ(compile.name, "compile");
  double compiling = 0.0;
  for (const auto& [counter, values] : compile.counters) {
    if (counter.ends_with("_seconds")) compiling += values.front();
  }
  EXPECT_NEAR(compiling, compile.seconds.front(), 1e-12);
  // Aged passes come once radii have halved.
  Results results;
  results.rows = rows;
  EXPECT_EQ(results.find("box/pass")->counters.at("passes_before"),
            (std::vector<double>{1.0, 1.0}));
  const double half = static_cast<double>(passes_until_half(0.7));
  EXPECT_EQ(results.find("box/aged/pass")->counters.at("passes_before"),
            (std::vector<double>{half, half + 2.0}));
}

TEST_F(Measure, PassesUntilHalfFollowTheLawOfRadii) {
  // The product of (j + alpha) / (j + 1) is Gamma(i + alpha) / (Gamma(alpha) Gamma(i + 1)).
  for (const double alpha : {0.3, 0.5, 0.7, 0.8}) {
    const auto area = [alpha](double i) {
      return std::exp(std::lgamma(i + alpha) - std::lgamma(alpha) - std::lgamma(i + 1.0));
    };
    const auto passes = static_cast<double>(passes_until_half(alpha));
    EXPECT_LE(area(passes), 0.25) << alpha;
    EXPECT_GT(area(passes - 1.0), 0.25) << alpha;
  }
}

TEST_F(Measure, AnInterruptionLeavesNothing) {
  // Wherever it comes: before the first step, while radii are sought, in a pass, in an aged one.
  plan_.aged = true;
  for (const int polls : {0, 5, 60}) {
    int left = polls;
    EXPECT_FALSE(measure_box([&left] { return left-- <= 0; })) << polls;
  }
}

/// Statistics after one pass in the closed box.
render::Statistics statistics_of(gpu::Device& device, std::uint32_t max_depth) {
  Log log(Verbosity::quiet);
  const scene::Scene scene = closed_box(log);
  render::Settings settings = small_settings(scene, log);
  settings.samples_per_pixel = 3;
  settings.max_depth = max_depth;
  const auto integrator = render::make_integrator(settings, scene, device, log, 1);
  integrator->prepare([] { return false; });
  integrator->advance([] { return false; });
  return integrator->statistics();
}

TEST_F(Measure, RaysAreCountedExactly) {
  // Each ray of a photon ends where a photon is stored, and each eye path is a single ray.
  const render::Statistics all = statistics_of(device(), 0);
  EXPECT_EQ(all.photon_rays, all.photons_stored);
  EXPECT_GT(all.photon_rays, 500u);
  EXPECT_EQ(all.eye_rays, 32u * 24u * 3u);
  // With one scattering event between light and eye a photon has one ray.
  EXPECT_EQ(statistics_of(device(), 1).photon_rays, 500u);
}

TEST(Machine, TellsOfItself) {
  const Machine machine = describe_machine();
  EXPECT_EQ(machine.date.size(), std::string("2020-01-02T03:04:05+00:00").size());
  EXPECT_GE(machine.processors, 1u);
  EXPECT_FALSE(machine.executable.empty());
  const double before = processor_seconds();
  volatile double sum = 0.0;
  for (int i = 0; i < 20000000; ++i) sum = sum + 1.0;
  EXPECT_GT(processor_seconds(), before);
}

TEST(Machine, PeakMemoryIsWhatWasHeld) {
  constexpr std::size_t kBytes = std::size_t{64} << 20;
  const std::uint64_t before = peak_memory_bytes();
  {
    const std::vector<char> block(before + kBytes, 1);  // more than ever was there
    EXPECT_GE(peak_memory_bytes(), before + kBytes);
  }
}

TEST(Scaling, TableGivesMediansOfRatios) {
  Results results;
  const auto add = [&](const char* name, std::vector<double> seconds) {
    results.rows.push_back({name, 1, std::move(seconds), {}, {}});
  };
  add("room/pass", {1.0, 2.0, 1.0});
  add("room-photons/pass", {8.0, 16.0, 20.0});  // 8, 8, 20 times
  add("dark/pass", {1.75, 3.5, 1.75});
  add("room/kernel:update", {0.25, 0.25, 0.25});
  add("room-hits/kernel:update", {0.5, 0.5, 0.5});
  const std::string table = scaling_table(results);
  EXPECT_NE(table.find("10 times the photons: pass                    8.00    8.00   20.00"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("1.75    1.75    1.75    <= 1.5 MISSED"), std::string::npos) << table;
  EXPECT_NE(table.find("2.00    2.00    2.00    <= 3.0 met"), std::string::npos) << table;
  EXPECT_EQ(table.find("uneven"), std::string::npos) << "was not measured:\n" << table;
}

}  // namespace
}  // namespace ppm::bench
