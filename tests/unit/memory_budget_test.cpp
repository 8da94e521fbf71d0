// What memory a rendering is reckoned to take, what there is, and how it is refused.
#include "memory_budget.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "failure.hpp"
#include "gltf_writer.hpp"
#include "image.hpp"
#include "inspect_report.hpp"
#include "load_gltf.hpp"
#include "machine_memory.hpp"
#include "scene_settings.hpp"
#include "temporary_folder.hpp"

namespace ppm::tests {
namespace {

using cli::MemoryLimits;
using render::MemoryPlan;

constexpr std::uint64_t kGiB = std::uint64_t{1} << 30;
constexpr std::uint64_t kPlenty = std::numeric_limits<std::uint64_t>::max();

MemoryPlan plan_of(const scene::SceneSize& size, const render::Settings& settings = {}) {
  return render::memory_plan(size, settings, render::PassLimits::of_cpu());
}

render::MemoryDemand demand_of(const scene::SceneSize& size) {
  return {size, render::PassLimits::of_cpu(), {}, false};
}

std::string refusal(const scene::SceneSize& size, const render::Settings& settings,
                    const MemoryLimits& limits) {
  try {
    cli::fit_or_refuse("a.glb", demand_of(size), settings, limits, cli::Known::all);
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "";
}

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

TEST(MemoryBudget, SizesAreReadInPowersOf1024) {
  EXPECT_EQ(cli::parse_size("4G"), 4 * kGiB);
  EXPECT_EQ(cli::parse_size("1.5g"), kGiB + kGiB / 2);
  EXPECT_EQ(cli::parse_size("512M"), kGiB / 2);
  EXPECT_EQ(cli::parse_size("64k"), 65536u);
  EXPECT_EQ(cli::parse_size("2T"), 2048 * kGiB);
  EXPECT_EQ(cli::parse_size("123456789"), 123456789u);
  for (const char* text :
       {"", "G", "0", "-1G", "4GB", "4 G", "nan", "inf", "1e30", "1e400", "0x1G"}) {
    EXPECT_FALSE(cli::parse_size(text)) << text;
  }
}

// By hand: a triangle is stored once on the host, and as 48 + 64 bytes and 0.4 nodes of 64 on the
// device.
TEST(MemoryPlan, GrowsWithWhatThereIs) {
  const MemoryPlan small = plan_of({}), triangles = plan_of({.triangles = 1000000}),
                   details = plan_of({.triangles = 1000000, .details = true}),
                   textures = plan_of({.texture_bytes = kGiB});
  EXPECT_NEAR(static_cast<double>(triangles.device_peak() - small.device_peak()), 137.6e6, 1e3);
  EXPECT_NEAR(static_cast<double>(details.device_peak() - triangles.device_peak()), 48e6, 1e3);
  EXPECT_EQ(textures.device_peak() - small.device_peak(), kGiB);
  EXPECT_EQ(plan_of({.texture_bytes = 2 * kGiB}).host_peak() - textures.host_peak(), kGiB);
  EXPECT_GE(triangles.host_peak() - small.host_peak(), 1000000 * sizeof(scene::Triangle));
  for (const MemoryPlan& plan : {small, triangles, details, textures}) {
    EXPECT_LE(plan.peak(), plan.host_peak() + plan.device_peak());
    EXPECT_GE(plan.peak(), std::max(plan.host_peak(), plan.device_peak()));
  }
}

// By hand: 12 bytes a texel on the host, twice while it is read; 16 on the device, and so much and
// the alias table's 28 beside it while that is made. 68 bytes a light, 128 a material on the
// device.
TEST(MemoryPlan, GrowsWithSkyLightsMaterialsAndWhatIsUnpacked) {
  constexpr std::uint64_t kTexels = std::uint64_t{1} << 23, kMany = 10000000;
  render::Settings tiny;  // so that its picture takes nothing
  tiny.width = tiny.height = 8;
  const auto of = [&](const scene::SceneSize& size) { return plan_of(size, tiny); };
  const MemoryPlan none = of({}), sky = of({.environment_texels = kTexels}),
                   lights = of({.lights = kMany}), materials = of({.materials = kMany}),
                   unpacked = of({.decoded_bytes = 3 * kGiB, .decoder_bytes = kGiB});
  EXPECT_EQ(sky.device_peak() - none.device_peak(), kTexels * 16);
  EXPECT_NEAR(static_cast<double>(sky.host_peak() - none.host_peak()), kTexels * (12.0 + 44.0),
              1e7);  // the picture is not there yet
  EXPECT_EQ(lights.device_peak() - none.device_peak(), kMany * 68);
  EXPECT_EQ(materials.device_peak() - none.device_peak(), kMany * 128);
  EXPECT_NEAR(static_cast<double>(unpacked.host_peak() - none.host_peak()), 4.0 * kGiB, 1e7);
  EXPECT_EQ(unpacked.device_peak(), none.device_peak());
}

TEST(MemoryPlan, GrowsWithThePicture) {
  render::Settings settings;
  const MemoryPlan usual = plan_of({}, settings);
  settings.width *= 10;
  // Hit points grow tenfold; photons and queues do not.
  EXPECT_GT(plan_of({}, settings).device_peak(), 4 * usual.device_peak());
  settings.width /= 10;
  settings.photons_per_pass = 1u << 30;
  // Photons are traced in chunks that the device can hold.
  EXPECT_LE(plan_of({}, settings).device_peak(), usual.device_peak() + 2 * kGiB);
}

TEST(MemoryPlan, FollowsTheMethod) {
  const auto bytes_of = [](const MemoryPlan& plan, const char* name) {
    std::uint64_t bytes = 0;
    for (const auto& part : plan.parts) bytes += part.name == name ? part.bytes : 0;
    return bytes;
  };
  render::Settings settings;
  EXPECT_GT(bytes_of(plan_of({}, settings), "photons"), 0u);
  EXPECT_EQ(bytes_of(plan_of({}, settings), "film"), 0u);
  settings.integrator = "pt";
  EXPECT_EQ(bytes_of(plan_of({}, settings), "photons"), 0u);
  const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
  EXPECT_EQ(bytes_of(plan_of({}, settings), "film"), 72 * pixels);
  settings.width = settings.height = 32768;
  const std::string film = refusal({}, settings, {4 * kGiB, 0, std::nullopt});
  EXPECT_TRUE(contains(film, "--width ")) << film;
}

// Twice what is kept of a pixel, or of a hit point; a map's photons follow from their numbers.
TEST(MemoryPlan, CheckpointsAreAsLargeAsTheState) {
  render::Settings settings;
  const render::PassLimits limits = render::PassLimits::of_cpu();
  const std::uint64_t pixels = std::uint64_t{settings.width} * settings.height;
  EXPECT_NEAR(static_cast<double>(render::checkpoint_memory(settings, limits).bytes),
              2.0 * 20 * 5 * static_cast<double>(pixels), 50.0);
  settings.integrator = "bdpt";
  EXPECT_EQ(render::checkpoint_memory(settings, limits).bytes, 2 * 36 * pixels);
  settings.integrator = "pm";
  EXPECT_EQ(render::checkpoint_memory(settings, limits).bytes, 0u);
}

// 32 bytes a photon, as many again of one grid to sort it by, and tables of cells; a grid holds
// what a buffer of 128 MiB does.
TEST(MemoryPlan, GrowsWithThePhotonMap) {
  render::Settings settings;
  settings.integrator = "pm";
  settings.map_photons = 2000000;
  const auto small = static_cast<double>(plan_of({}, settings).device_peak());
  settings.map_photons = 20000000;
  const auto large = static_cast<double>(plan_of({}, settings).device_peak());
  const double grid_growth = 20e6 / 3.0 - 2e6, table = 8.0 * ((1u << 22) + 65536);
  EXPECT_NEAR(large - small, 32.0 * (18e6 + grid_growth) + 2.0 * table, 1e3);
}

TEST(MemoryBudget, RefusalsNameTheLimitTheLargestPartsAndARemedy) {
  const scene::SceneSize triangles{.triangles = 50000000};
  const render::Settings usual;
  EXPECT_EQ(refusal(triangles, usual, {std::nullopt, kPlenty, std::nullopt}), "");
  EXPECT_EQ(refusal(triangles, usual, {100 * kGiB, 0, std::nullopt}),
            "");  // who sets a budget knows best
  const std::string over = refusal(triangles, usual, {4 * kGiB, kPlenty, std::nullopt});
  EXPECT_TRUE(over.starts_with("a.glb: --memory-budget: a rendering takes ")) << over;
  EXPECT_TRUE(contains(over, "triangles ")) << over;
  EXPECT_TRUE(contains(over, "may take 4 GiB")) << over;
  EXPECT_TRUE(contains(over, "simplify meshes")) << over;
  const std::string machine = refusal(triangles, usual, {std::nullopt, 2 * kGiB, std::nullopt});
  EXPECT_TRUE(contains(machine, "the machine has 2 GiB left")) << machine;
  const std::string device = refusal(triangles, usual, {std::nullopt, kPlenty, kGiB});
  EXPECT_TRUE(contains(device, "the device has 1 GiB left")) << device;

  const std::string textures =
      refusal({.texture_bytes = 8 * kGiB}, usual, {4 * kGiB, 0, std::nullopt});
  EXPECT_TRUE(contains(textures, "scale textures down")) << textures;
  render::Settings settings;
  settings.width = settings.height = 32768;
  const std::string picture = refusal({}, settings, {4 * kGiB, 0, std::nullopt});
  EXPECT_TRUE(contains(picture, "--width ")) << picture;
  render::Settings map;
  map.integrator = "pm";
  map.map_photons = 20000000;
  const std::string photons = refusal({}, map, {kGiB / 2, 0, std::nullopt});
  EXPECT_TRUE(contains(photons, "photon map ")) << photons;
  EXPECT_TRUE(contains(photons, "--map-photons ")) << photons;
}

// A scene with textures, a sky from a file, a lamp of triangles and a camera of its own aspect:
// what is said before it is loaded is what is said of it when it is there, to the byte.
TEST(MemoryBudget, RefusesByTheTotalThatInspectTells) {
  const test::TemporaryFolder folder;
  test::GltfWriter writer;
  writer.mesh(test::icosphere(3), writer.material(test::emitter({1.0, 1.0, 1.0})));
  writer.camera("wide", {0.0, 0.0, 3.0}, {0.0, 0.0, 0.0}, 0.8, 2.5);
  writer.write(folder / "s.glb");
  image::write(folder / "sky.exr", {512, 256, std::vector<float>(512 * 256 * 3, 1.0f)}, {}, {});
  cli::RenderOptions options;
  options.scene = folder / "s.glb";
  options.load.environment = folder / "sky.exr";
  const auto load = [&](std::uint64_t budget) {
    Log log(Verbosity::quiet);
    return scene::load_gltf(options.scene, log,
                            cli::load_options_for(options, {budget, kPlenty, std::nullopt}));
  };
  Log log(Verbosity::quiet);
  const scene::Scene scene = load(kPlenty);
  const render::Settings settings = cli::settings_for(options, scene, log);
  EXPECT_EQ(settings.height, 256u);
  // What is had with the smallest tiles.
  const render::MemoryFit least =
      render::fit_memory(demand_of(scene::SceneSize::of(scene)), settings, {1, 0, std::nullopt});
  EXPECT_FALSE(least.fits);
  const MemoryPlan plan = cli::inspect(scene, least.settings, {}).memory;
  EXPECT_NO_THROW(load(plan.peak()));
  try {
    load(plan.peak() - 1);
    FAIL();
  } catch (const Failure& failure) {
    const std::string text = failure.what();
    EXPECT_TRUE(contains(text, ("a rendering takes " + render::size_text(plan.peak())).c_str()))
        << text;
  }
  // Before all is known there is only a lower bound, and it is called one.
  try {
    load(1000);
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_TRUE(contains(failure.what(), "a rendering takes at least ")) << failure.what();
  }
}

// A machine as /proc and /sys show it, and what is left of it.
TEST(MachineMemory, IsWhatTheSystemOrTheControlGroupHasLeft) {
  const test::TemporaryFolder folder;
  const std::filesystem::path root = folder / "root";
  const auto write = [&](const char* file, const std::string& text) {
    std::filesystem::create_directories((root / file).parent_path());
    std::ofstream(root / file) << text;
  };
  EXPECT_EQ(available_memory(root), kPlenty);
  write("proc/meminfo", "MemTotal:  8000 kB\nMemFree:  10 kB\nMemAvailable:    4000 kB\n");
  EXPECT_EQ(available_memory(root), 4000u * 1024);
  write("sys/fs/cgroup/memory.max", "max\n");
  write("sys/fs/cgroup/memory.current", "1000000\n");
  EXPECT_EQ(available_memory(root), 4000u * 1024);
  write("sys/fs/cgroup/memory.max", "3000000\n");
  EXPECT_EQ(available_memory(root), 2000000u);
  write("sys/fs/cgroup/memory.stat", "anon 5\ninactive_file 400000\nactive_file 7\n");
  EXPECT_EQ(available_memory(root), 2400000u);
  write("sys/fs/cgroup/memory/memory.limit_in_bytes", "1500000\n");
  write("sys/fs/cgroup/memory/memory.usage_in_bytes", "1600000\n");
  EXPECT_EQ(available_memory(root), 0u);
}

TEST(MemoryBudget, LayersTakeWhatIsAskedFor) {
  using render::LayerKind;
  render::Settings settings;
  settings.width = settings.height = 1000;
  EXPECT_TRUE(render::layers_memory(settings, render::PassLimits::of_cpu(), {}).empty());
  const LayerKind kinds[] = {LayerKind::albedo, LayerKind::depth};
  const auto parts = render::layers_memory(settings, render::PassLimits::of_cpu(), kinds);
  ASSERT_EQ(parts.size(), 2u);
  // Four channels of 32 bits, twice; one tile of records, however many pixels there are.
  EXPECT_EQ(parts[0].bytes, 2u * 4 * 4 * 1000000);
  EXPECT_TRUE(parts[1].on_device);
  settings.height = 4000;
  EXPECT_EQ(render::layers_memory(settings, render::PassLimits::of_cpu(), kinds)[1].bytes,
            parts[1].bytes);
}

}  // namespace
}  // namespace ppm::tests
