// Buffers: their bytes, uses and sizes, and the account of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "gpu_room.hpp"
#include "implementation.hpp"

namespace ppm::tests {
namespace {

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

}  // namespace
}  // namespace ppm::tests
