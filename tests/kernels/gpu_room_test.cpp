// The room that runs kernels: ranges of items, constants, profiles, times.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <vector>

#include "gpu_room.hpp"
#include "implementation.hpp"

namespace ppm::tests {
namespace {

TEST_F(GpuRoom, VisitsEveryItemOnce) {
  const Kernel kernel(device(), shaders::gpu_count);
  for (const std::uint64_t count : {0u, 1u, 63u, 64u, 65u, 1023u, 1025u, 65535u * 64u + 1u}) {
    std::vector<std::uint32_t> expected(count, 1);
    const std::vector<std::uint32_t> seen = visits(device(), kernel, count);
    expected.resize(seen.size(), 0);
    EXPECT_TRUE(seen == expected) << count << " items";
  }
}

struct AllMembersPush {
  std::uint32_t first = 0, count = 0;
  std::int32_t sign = 0;
  float direction[3];
  float position[3], words[2];
  std::uint32_t pair[2];
  float rows[9];
  float turn[9];
  std::uint32_t last = 0;
};
static_assert(sizeof(AllMembersPush) == 128);

TEST_F(GpuRoom, PushAndSpecialisationConstantsArrive) {
  std::vector<std::uint32_t> expected = random_words(32, 7);
  // Bit patterns must be ordinary floats, which devices pass on unchanged.
  for (std::size_t i = 3; i < 31; ++i) expected[i] = (expected[i] & 0x007fffffu) | 0x3f800000u;
  std::array<std::uint32_t, 32> block;
  std::copy_n(expected.begin(), block.size(), block.begin());
  const auto push = std::bit_cast<AllMembersPush>(block);
  expected[0] = 0;
  expected[1] = 16;
  expected.insert(expected.end(), {1234567890u, std::bit_cast<std::uint32_t>(0.375f), 1u});

  const Kernel kernel(device(), shaders::gpu_push,
                      {{3, 1234567890u}, {5, std::bit_cast<std::uint32_t>(0.375f)}, {8, 1}});
  Buffer results(device(), "results", expected.size() * 4, Usage::storage);
  BindingTable table;
  table.set(PPM_BIND_TEST_0, results);
  device().run([&](Recorder& recorder) { recorder.dispatch(kernel, table, push, 16); });
  EXPECT_EQ(results.download<std::uint32_t>(expected.size()), expected);

  const Kernel defaults(device(), shaders::gpu_push);
  device().run([&](Recorder& recorder) { recorder.dispatch(defaults, table, push, 16); });
  std::copy_n(std::vector<std::uint32_t>{7, std::bit_cast<std::uint32_t>(0.5f), 0}.begin(), 3,
              expected.end() - 3);
  EXPECT_EQ(results.download<std::uint32_t>(expected.size()), expected);
}

TEST(ItemsPerDispatch, KeepsWithinTheTimeAndTheGroups) {
  const auto items_per_dispatch = [](std::uint64_t count, std::uint32_t group, double seconds,
                                     double milliseconds) {
    return gpu::items_per_dispatch(count, group, seconds, milliseconds, 16384);
  };
  // Unknown kernels start with at most 16384 items, cut evenly: 100000 / 7 = 14286, in whole groups
  // 14336.
  EXPECT_EQ(items_per_dispatch(100000, 64, 0.0, 50.0), 14336u);
  EXPECT_EQ(items_per_dispatch(100, 64, 0.0, 50.0), 128u);
  // 1 us an item: 50 ms hold 50000.
  EXPECT_EQ(items_per_dispatch(1000000, 1, 1e-6, 50.0), 50000u);
  // Never below 1024 items, however slow they are; never above 65535 groups, however fast:
  // 2^31 items are 513 parts of 4186128, or 65409 groups.
  EXPECT_EQ(items_per_dispatch(1024 * 64, 64, 1.0, 0.001), 1024u);
  EXPECT_EQ(items_per_dispatch(std::uint64_t{1} << 31, 64, 1e-15, 50.0), 65409u * 64u);
  EXPECT_EQ(items_per_dispatch(65535u * 64u, 64, 1e-15, 50.0), 65535u * 64u);
}

// The workgroup's size and the order of items are the device's choice: no result depends on them.
TEST_F(GpuRoom, TheProfilesConstantsReachTheKernels) {
  constexpr std::uint32_t kItems = 1000;
  const std::vector<std::uint32_t> once(kItems, 1);
  for (const std::uint32_t size : {32u, 64u, 256u}) {
    for (const bool alternate : {false, true}) {
      gpu::Device other({.selector = device().description().name, .validation = true});
      other.implementation().profile.workgroup_size = size;
      other.implementation().profile.alternate_halves = alternate;
      const Kernel kernel(other, shaders::gpu_profile);
      EXPECT_EQ(kernel.implementation().reflection.workgroup_size, size);
      Buffer results(other, "results", (2 + kItems) * 4, Usage::storage);
      BindingTable table;
      table.set(PPM_BIND_TEST_0, results);
      other.run([&](Recorder& recorder) {
        recorder.fill(results, 0, (2 + kItems) * 4);
        recorder.dispatch(kernel, table, RangePush{}, kItems);
      });
      const auto seen = results.download<std::uint32_t>(2 + kItems);
      EXPECT_EQ(seen[0], size);
      EXPECT_EQ(seen[1], alternate ? 1u : 0u);
      EXPECT_TRUE(std::equal(once.begin(), once.end(), seen.begin() + 2));
      EXPECT_EQ(other.validation_messages(), 0u);
    }
  }
}

TEST(DeviceProfile, LavapipeTakesOnePassAtATimeAndGpusMany) {
  EXPECT_EQ(gpu::device_profile(VK_PHYSICAL_DEVICE_TYPE_CPU).passes_in_flight, 1u);
  EXPECT_TRUE(gpu::device_profile(VK_PHYSICAL_DEVICE_TYPE_CPU).alternate_halves);
  EXPECT_GE(gpu::device_profile(VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU).passes_in_flight, 16u);
  EXPECT_FALSE(gpu::device_profile(VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU).alternate_halves);
}

// A device that gives a dispatch next to no time: the same visits in ranges of 1024.
TEST_F(GpuRoom, CutsByTimeChangeNoResult) {
  gpu::Device hasty(
      {.selector = device().description().name, .validation = true, .dispatch_milliseconds = 1e-6});
  const Kernel kernel(hasty, shaders::gpu_count);
  constexpr std::uint64_t kCount = 100000;
  for (int i = 0; i < 2; ++i) {
    const std::vector<std::uint32_t> seen = visits(hasty, kernel, kCount);
    EXPECT_EQ(std::count(seen.begin(), seen.begin() + kCount, 1u), std::ptrdiff_t{kCount});
    EXPECT_EQ(std::count(seen.begin() + kCount, seen.end(), 0u), 256);
  }
  // First 7 dispatches by the first guess, then 98 of at most 1024 items.
  EXPECT_EQ(hasty.times().at("gpu_count").dispatches, 7u + 98u);
  EXPECT_EQ(hasty.times().at("copy").dispatches, 2u);
}

TEST_F(GpuRoom, TimesAddUpToNoMoreThanTheClock) {
  const Kernel kernel(device(), shaders::gpu_count);
  const auto seconds = [&] {
    double sum = 0.0;
    for (const auto& [name, time] : device().times()) sum += time.seconds;
    return sum;
  };
  const double before = seconds();
  const auto start = std::chrono::steady_clock::now();
  visits(device(), kernel, 1 << 22);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  EXPECT_GT(seconds() - before, 0.0);
  EXPECT_LE(seconds() - before, wall.count());
}

using GpuRoomDeathTest = GpuRoom;

TEST_F(GpuRoomDeathTest, AMissingOrUnfitBufferIsNamed) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const Kernel kernel(device(), shaders::gpu_step);
  Buffer storage(device(), "a storage", 64, Usage::storage);
  Buffer texels(device(), "a texel buffer", 64, Usage::texels);
  BindingTable table;
  table.set(PPM_BIND_TEST_0, storage);
  const auto dispatch = [&](auto push) {
    device().run([&](Recorder& recorder) { recorder.dispatch(kernel, table, push, 16); });
  };
  EXPECT_DEATH(dispatch(StepPush{}), "kernel gpu_step, binding 41: no buffer is bound");
  table.set(PPM_BIND_TEST_1, texels);
  EXPECT_DEATH(dispatch(StepPush{}), "binding 41: a texel buffer was made for another use");
  table.set(PPM_BIND_TEST_1, storage);
  EXPECT_DEATH(dispatch(RangePush{}), "push block of 12 bytes, not 8");
  EXPECT_DEATH(storage.download<std::uint32_t>(17), "a storage has 64 bytes, asked for 68");
  EXPECT_DEATH(device().run([&](Recorder& recorder) { recorder.fill(storage, 0, 64, 4); }),
               "a storage has 64 bytes, asked for 64 from 4 on");
}

}  // namespace
}  // namespace ppm::tests
