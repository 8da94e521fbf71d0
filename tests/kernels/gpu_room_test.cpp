// The room that runs kernels: copies, bindings, constants, ranges of items.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "buffer.hpp"
#include "device_fixture.hpp"
#include "implementation.hpp"
#include "kernel.hpp"
#include "ppm_gpu_test_shaders.hpp"
#include "recorder.hpp"
#include "region.hpp"

namespace ppm::tests {
namespace {

using gpu::BindingTable;
using gpu::Buffer;
using gpu::Kernel;
using gpu::Recorder;
using gpu::Usage;

struct RangePush {
  std::uint32_t first = 0, count = 0;
};

struct StepPush {
  std::uint32_t first = 0, count = 0, items = 0;
};

std::vector<std::uint32_t> random_words(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> words(count);
  std::generate(words.begin(), words.end(), random);
  return words;
}

class GpuRoom : public DeviceTest {};

// How often each of `count` items was visited, and the words of a margin behind them.
std::vector<std::uint32_t> visits(gpu::Device& device, const Kernel& kernel, std::uint64_t count) {
  constexpr std::uint64_t kMargin = 256;
  const std::uint64_t words = count + kMargin;
  Buffer buffer(device, "visits", words * 4, Usage::storage);
  BindingTable table;
  table.set(PPM_BIND_TEST_0, buffer);
  device.run([&](Recorder& recorder) {
    recorder.fill(buffer, 0, words * 4);
    recorder.dispatch(kernel, table, RangePush{}, count);
  });
  return buffer.download<std::uint32_t>(words);
}

TEST_F(GpuRoom, VisitsEveryItemOnce) {
  const Kernel kernel(device(), shaders::gpu_count);
  for (const std::uint64_t count : {0u, 1u, 63u, 64u, 65u, 1023u, 1025u, 65535u * 64u + 1u}) {
    std::vector<std::uint32_t> expected(count, 1);
    const std::vector<std::uint32_t> seen = visits(device(), kernel, count);
    expected.resize(seen.size(), 0);
    EXPECT_TRUE(seen == expected) << count << " items";
  }
}

struct CountedPush {
  std::uint32_t first = 0, count = 0, stride = 0;
};

// The counts are written on the device, larger or smaller than expected, and in rows.
TEST_F(GpuRoom, VisitsAsManyItemsAsTheDeviceCounted) {
  gpu::Device hasty(
      {.selector = device().description().name, .validation = true, .dispatch_milliseconds = 1e-6});
  for (gpu::Device* const on : {&device(), &hasty}) {
    const Kernel kernel(*on, shaders::gpu_counted);
    constexpr std::uint32_t kStride = 300000;
    struct Case {
      std::vector<std::uint32_t> counts;
      std::uint64_t most, expected;
    };
    for (const Case& test : {Case{{0}, 1000, 5}, Case{{1}, 1000, 0}, Case{{70000}, 100000, 100},
                             Case{{70000}, 100000, 99999}, Case{{5000}, 300, 4},
                             Case{{10000, 0, 3000, 10001}, 20000, 10000}, Case{{7}, 0, 0}}) {
      const auto rows = static_cast<std::uint32_t>(test.counts.size());
      Buffer counts(*on, "counts", 64, Usage::storage);
      Buffer visits(*on, "visits", std::uint64_t{rows} * kStride * 4, Usage::storage);
      BindingTable table;
      table.set(PPM_BIND_TEST_0, visits);
      table.set(PPM_BIND_TEST_1, counts);
      on->run([&](Recorder& recorder) {
        recorder.fill(visits, 0, visits.bytes());
        for (std::uint32_t row = 0; row < rows; ++row)
          recorder.fill(counts, test.counts[row], 4, 4 * row + 8);
        for (int i = 0; i < 2; ++i) {
          recorder.dispatch(kernel, table, CountedPush{.stride = kStride},
                            gpu::DeviceCount{counts, 2, test.most, test.expected, rows});
        }
      });
      std::vector<std::uint32_t> expected(std::size_t{rows} * kStride, 0);
      for (std::uint32_t row = 0; row < rows; ++row) {
        const auto items = std::min<std::uint64_t>(test.counts[row], test.most);
        std::fill_n(expected.begin() + row * kStride, items, 2u);
      }
      EXPECT_TRUE(visits.download<std::uint32_t>(expected.size()) == expected)
          << test.counts[0] << " of at most " << test.most << ", expected " << test.expected;
    }
  }
  EXPECT_EQ(hasty.validation_messages(), 0u);
}

// More counted dispatches than one submission has room for, each with the count the last one left.
TEST_F(GpuRoom, CountsAreTakenWhenTheirTurnComes) {
  constexpr std::uint32_t kSteps = 3000;
  const Kernel kernel(device(), shaders::gpu_counted);
  Buffer counts(device(), "counts", 16, Usage::storage);
  Buffer visits(device(), "visits", 4096 * 4, Usage::storage);
  BindingTable table;
  table.set(PPM_BIND_TEST_0, visits);
  table.set(PPM_BIND_TEST_1, counts);
  device().run([&](Recorder& recorder) {
    recorder.fill(visits, 0, visits.bytes());
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      recorder.fill(counts, i, 4, 8);
      recorder.dispatch(kernel, table, CountedPush{}, gpu::DeviceCount{counts, 2, 4096, i / 2});
    }
  });
  const auto seen = visits.download<std::uint32_t>(4096);
  for (std::uint32_t i = 0; i < 4096; ++i)
    ASSERT_EQ(seen[i], i + 1 < kSteps ? kSteps - 1 - i : 0u) << "item " << i;
}

TEST(CountedRanges, HoldTheMostAndFollowTheExpected) {
  using gpu::cut_counted;
  EXPECT_EQ(cut_counted(1000, 1000, 64, 1024).ranges, 1u);
  EXPECT_EQ(cut_counted(100000, 10000, 64, 2048).ranges, 5u);
  // However much is expected, no more ranges than PPM_COUNTED_RANGES, and room for all.
  for (const std::uint64_t most : {1ull, 70000ull, 5000000ull, 256ull * 65535 * 64}) {
    for (const std::uint64_t expected : {0ull, 100ull, 4000000000ull}) {
      for (const std::uint64_t step : {1024ull, 65535ull * 64}) {
        const gpu::CountedRanges cut = cut_counted(most, expected, 64, step);
        EXPECT_LE(cut.ranges, 256u);
        EXPECT_LE(cut.step, 65535u * 64);
        const std::uint64_t before_last = (cut.ranges - 1ull) * cut.step;
        EXPECT_LE(most, before_last + 65535u * 64) << expected << ", " << step;
      }
    }
  }
}

TEST_F(GpuRoom, BytesComeBackAsTheyWent) {
  for (const bool staged : {false, true}) {
    device().implementation().maps_device_memory = !staged;
    for (const std::size_t size : {std::size_t{1}, std::size_t{16}, (std::size_t{16} << 20) + 5}) {
      Buffer buffer(device(), "bytes", size, Usage::storage);
      std::vector<std::uint32_t> words = random_words(size / 4 + 1, 1);
      std::vector<std::byte> back(size);
      buffer.upload(words.data(), size);
      buffer.download(back.data(), size);
      EXPECT_EQ(std::memcmp(words.data(), back.data(), size), 0)
          << size << " bytes, staged: " << staged;
    }
  }
  device().implementation().maps_device_memory = true;
}

TEST_F(GpuRoom, PartsOfABufferAreItsOwn) {
  for (const bool staged : {false, true}) {
    device().implementation().maps_device_memory = !staged;
    std::vector<std::uint32_t> expected = random_words(1000, 2);
    Buffer buffer =
        gpu::make_buffer<std::uint32_t>(device(), "parts", expected, Usage::storage_and_texels);
    const std::vector<std::uint32_t> part = random_words(10, 3);
    buffer.upload(part.data(), part.size() * 4, 77 * 4);
    std::copy(part.begin(), part.end(), expected.begin() + 77);
    std::vector<std::uint32_t> back(500);
    buffer.download(back.data(), back.size() * 4, 50 * 4);
    EXPECT_TRUE(std::equal(back.begin(), back.end(), expected.begin() + 50));
  }
  device().implementation().maps_device_memory = true;
}

TEST_F(GpuRoom, SizesAreRoundedUpAndNeverZero) {
  EXPECT_EQ(Buffer(device(), "none", 0, Usage::storage).bytes(), 16u);
  EXPECT_EQ(Buffer(device(), "odd", 17, Usage::storage).bytes(), 20u);
  EXPECT_EQ(Buffer(device(), "odd texels", 17, Usage::texels).bytes(), 32u);
}

TEST_F(GpuRoom, TexelsStorageAndUniformsHoldTheSameBytes) {
  constexpr std::uint32_t kItems = 1000;
  const std::vector<std::uint32_t> words = random_words(4 * kItems, 4);
  const std::uint32_t constants[4] = {11, 22, 33, 3};
  const Kernel kernel(device(), shaders::gpu_read);
  Buffer texels = gpu::make_buffer<std::uint32_t>(device(), "texels", words, Usage::texels);
  Buffer storage = gpu::make_buffer<std::uint32_t>(device(), "words", words, Usage::storage);
  Buffer uniform = gpu::make_buffer<std::uint32_t>(device(), "uniform", constants, Usage::uniform);
  Buffer results(device(), "results", kItems * 48, Usage::storage);
  BindingTable table;
  table.set(PPM_BIND_TEST_0, texels);
  table.set(PPM_BIND_TEST_1, storage);
  table.set(PPM_BIND_TEST_2, results);
  table.set(PPM_BIND_TEST_3, uniform);
  device().run([&](Recorder& recorder) { recorder.dispatch(kernel, table, RangePush{}, kItems); });

  std::vector<std::uint32_t> expected;
  for (std::size_t i = 0; i < words.size(); i += 4) {
    const std::uint32_t* const w = &words[i];
    expected.insert(expected.end(), {w[0], w[1], w[2], w[3], w[0], w[1], w[2], w[3], w[0] * 3 + 11,
                                     w[1] * 3 + 22, w[2] * 3 + 33, w[3]});
  }
  EXPECT_TRUE(results.download<std::uint32_t>(expected.size()) == expected);
}

TEST_F(GpuRoom, StorageWrittenInOneDispatchIsReadAsTexelsInTheNext) {
  constexpr std::uint32_t kTexels = 5000, kWords = 4 * kTexels;
  const Kernel step(device(), shaders::gpu_step), read(device(), shaders::gpu_read);
  const std::vector<std::uint32_t> words = random_words(kWords, 5);
  const std::uint32_t constants[4] = {0, 0, 0, 1};
  Buffer from = gpu::make_buffer<std::uint32_t>(device(), "from", words, Usage::storage);
  Buffer uniform = gpu::make_buffer<std::uint32_t>(device(), "uniform", constants, Usage::uniform);
  Buffer both(device(), "both", kWords * 4, Usage::storage_and_texels);
  Buffer results(device(), "results", kTexels * 48, Usage::storage);
  BindingTable step_table, read_table;
  step_table.set(PPM_BIND_TEST_0, from);
  step_table.set(PPM_BIND_TEST_1, both);
  read_table.set(PPM_BIND_TEST_0, both);
  read_table.set(PPM_BIND_TEST_1, both);
  read_table.set(PPM_BIND_TEST_2, results);
  read_table.set(PPM_BIND_TEST_3, uniform);
  device().run([&](Recorder& recorder) {
    recorder.dispatch(step, step_table, StepPush{.items = kWords}, kWords);
    recorder.dispatch(read, read_table, RangePush{}, kTexels);
  });
  const auto seen = results.download<std::uint32_t>(kTexels * 12);
  for (std::uint32_t i = 0; i < kWords; ++i) {
    ASSERT_EQ(seen[i / 4 * 12 + i % 4], words[(i + 1) % kWords] + 1) << "word " << i;
  }
}

// After k steps, word i holds what word i + k held, plus k: every step must see all of the one
// before. 3000 steps are more commands than one submission takes.
TEST_F(GpuRoom, CommandsSeeTheResultsOfThoseBefore) {
  constexpr std::uint32_t kItems = 777, kSteps = 3000;
  const Kernel kernel(device(), shaders::gpu_step);
  const std::vector<std::uint32_t> words = random_words(kItems, 6);
  Buffer a = gpu::make_buffer<std::uint32_t>(device(), "a", words, Usage::storage);
  Buffer b(device(), "b", kItems * 4, Usage::storage);
  BindingTable forth, back;
  forth.set(PPM_BIND_TEST_0, a);
  forth.set(PPM_BIND_TEST_1, b);
  back.set(PPM_BIND_TEST_0, b);
  back.set(PPM_BIND_TEST_1, a);
  device().run([&](Recorder& recorder) {
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      recorder.dispatch(kernel, i % 2 == 0 ? forth : back, StepPush{.items = kItems}, kItems);
    }
  });
  const auto seen = a.download<std::uint32_t>(kItems);
  for (std::uint32_t i = 0; i < kItems; ++i) {
    ASSERT_EQ(seen[i], words[(i + kSteps) % kItems] + kSteps) << "word " << i;
  }
}

// 40 reads of 64 KiB are more than one submission gives back.
TEST_F(GpuRoom, ReadsSeeTheBufferAsItWasThen) {
  constexpr std::uint32_t kReads = 40, kWords = 16384;
  Buffer a(device(), "a", kWords * 4, Usage::storage), b(device(), "b", kWords * 4, Usage::storage);
  std::vector<std::vector<std::uint32_t>> results(kReads, std::vector<std::uint32_t>(kWords));
  device().run([&](Recorder& recorder) {
    for (std::uint32_t i = 0; i < kReads; ++i) {
      recorder.fill(a, 1000 + i, kWords * 4);
      recorder.fill(a, i, 8, 40);
      recorder.copy(a, b, kWords * 4 - 4, 4, 0);
      recorder.read(b, results[i].data(), kWords * 4 - 4);
    }
  });
  for (std::uint32_t i = 0; i < kReads; ++i) {
    std::vector<std::uint32_t> expected(kWords, 1000 + i);
    expected[9] = expected[10] = i;
    expected[kWords - 1] = 0;
    ASSERT_TRUE(results[i] == expected) << "read " << i;
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

// What the driver is told of regions, in order; an empty text is an end.
std::vector<std::string> labels;
VKAPI_ATTR void VKAPI_CALL note_begin(VkCommandBuffer, const VkDebugUtilsLabelEXT* label) {
  labels.emplace_back(label->pLabelName);
}
VKAPI_ATTR void VKAPI_CALL note_end(VkCommandBuffer) {
  labels.emplace_back();
}

// Every submission opens the regions anew and ends them: 3000 steps are more than one takes.
TEST_F(GpuRoom, RegionsAreBalancedInEverySubmission) {
  constexpr std::uint32_t kSteps = 3000;
  gpu::Device labelled({.selector = device().description().name, .validation = true});
  const Kernel kernel(labelled, shaders::gpu_count);
  Buffer words(labelled, "words", 64, Usage::storage);
  BindingTable table;
  table.set(PPM_BIND_TEST_0, words);
  const auto run = [&] {
    const gpu::Region whole(labelled, "whole");
    labelled.run([&](Recorder& recorder) {
      recorder.fill(words, 0, 64);
      const gpu::Region part(labelled, "part");
      for (std::uint32_t i = 0; i < kSteps; ++i) recorder.dispatch(kernel, table, RangePush{}, 16);
    });
  };
  run();  // with the layer's own checks
  labels.clear();
  labelled.implementation().cmd_begin_label = note_begin;
  labelled.implementation().cmd_end_label = note_end;
  run();

  std::vector<std::string> open;
  std::size_t submissions = 0, parts = 0, dispatches = 0;
  for (const std::string& label : labels) {
    if (label.empty()) {
      ASSERT_FALSE(open.empty());
      open.pop_back();
      continue;
    }
    const std::vector<std::string> expected = label == "whole" ? std::vector<std::string>{}
                                              : label == "part"
                                                  ? std::vector<std::string>{"whole"}
                                                  : std::vector<std::string>{"whole", "part"};
    ASSERT_EQ(open, expected) << "around " << label;
    submissions += label == "whole";
    parts += label == "part";
    dispatches += label == "gpu_count";
    open.push_back(label);
  }
  EXPECT_TRUE(open.empty());
  EXPECT_GT(submissions, 2u);
  EXPECT_EQ(parts, submissions);
  EXPECT_EQ(dispatches, kSteps);
  EXPECT_EQ(labelled.region_times().at("part").dispatches, 2 * kSteps);
  EXPECT_EQ(labelled.region_times().at("whole").dispatches, 2u);
}

TEST_F(GpuRoom, AnExceptionInARegionLeavesNoneOpen) {
  const auto stopped = [&] {
    const gpu::Region region(device(), "stopped");
    device().run([](Recorder&) { throw std::runtime_error("stopped"); });
  };
  EXPECT_THROW(stopped(), std::runtime_error);
  EXPECT_TRUE(device().implementation().regions.empty());
  const Kernel kernel(device(), shaders::gpu_count);
  EXPECT_EQ(visits(device(), kernel, 100)[99], 1u);
}

TEST_F(GpuRoom, MemoryAccountReturnsToWhereItWas) {
  Buffer(device(), "first", 16, Usage::storage).download<std::uint32_t>(1);
  const std::uint64_t before = device().allocated_bytes();
  {
    const Buffer a(device(), "a", 1 << 20, Usage::storage);
    Buffer b(device(), "b", 1 << 20, Usage::texels);
    EXPECT_GE(device().allocated_bytes(), before + (2u << 20));
    Buffer moved = std::move(b);
    EXPECT_GE(device().allocated_bytes(), before + (2u << 20));
    moved = Buffer(device(), "c", 16, Usage::texels);
    EXPECT_LT(device().allocated_bytes(), before + (2u << 20));
  }
  EXPECT_EQ(device().allocated_bytes(), before);
  EXPECT_GE(device().peak_bytes(), before + (2u << 20));
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
