// Recordings: counts from the device, the order of commands, regions.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "gpu_room.hpp"
#include "implementation.hpp"
#include "region.hpp"

namespace ppm::tests {
namespace {

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

}  // namespace
}  // namespace ppm::tests
