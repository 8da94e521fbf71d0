// What the tests of the room that runs kernels have in common.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "buffer.hpp"
#include "device_fixture.hpp"
#include "kernel.hpp"
#include "ppm_gpu_test_shaders.hpp"
#include "recorder.hpp"

namespace ppm::tests {

using gpu::BindingTable;
using gpu::Buffer;
using gpu::Kernel;
using gpu::Recorder;
using gpu::Usage;

using GpuRoom = DeviceTest;

struct RangePush {
  std::uint32_t first = 0, count = 0;
};

struct StepPush {
  std::uint32_t first = 0, count = 0, items = 0;
};

inline std::vector<std::uint32_t> random_words(std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<std::uint32_t> words(count);
  std::generate(words.begin(), words.end(), random);
  return words;
}

/// How often each of `count` items was visited, and the words of a margin behind them.
inline std::vector<std::uint32_t> visits(gpu::Device& device, const Kernel& kernel,
                                         std::uint64_t count) {
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

}  // namespace ppm::tests
