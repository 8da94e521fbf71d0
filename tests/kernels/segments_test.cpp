// Buffers in segments: what is uploaded is what kernels read, wherever it is cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "device_fixture.hpp"
#include "failure.hpp"
#include "kernel.hpp"
#include "ppm_gpu_test_shaders.hpp"
#include "spirv_reflection.hpp"

namespace ppm::tests {
namespace {

using gpu::SegmentedBuffer;
using gpu::SegmentSize;

class Segments : public DeviceTest {};

std::vector<std::uint32_t> distinct_words(std::uint64_t texels) {
  std::vector<std::uint32_t> words(4 * texels);
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = static_cast<std::uint32_t>(i + 1);
  return words;
}

// What a kernel reads that was made for as many segments as there are.
std::vector<std::uint32_t> read_back(gpu::Device& device, const SegmentedBuffer& buffer,
                                     SegmentSize size, std::uint64_t texels) {
  const gpu::Kernel kernel(device, shaders::gpu_segments,
                           {{PPM_SPEC_SEGMENT_SHIFT, size.shift},
                            {PPM_SPEC_SEGMENTS + PPM_BIND_TEST_0, buffer.count()}});
  const gpu::Buffer results(device, "results", 16 * texels, gpu::Usage::storage);
  gpu::BindingTable table;
  table.set(PPM_BIND_TEST_0, buffer);
  table.set(PPM_BIND_TEST_1, results);
  struct {
    std::uint32_t first = 0, count = 0;
  } push;
  device.run([&](gpu::Recorder& recorder) { recorder.dispatch(kernel, table, push, texels); });
  return results.download<std::uint32_t>(4 * texels);
}

TEST_F(Segments, KernelsReadWhatWasUploaded) {
  const SegmentSize size{6};
  for (const std::uint64_t texels : {1u, 63u, 64u, 65u, 500u, 960u, 961u, 1024u}) {
    SegmentedBuffer buffer(device(), "texels", 16 * texels, size);
    EXPECT_EQ(buffer.count(), (texels + 63) / 64);
    for (const gpu::Buffer& segment : buffer.segments()) EXPECT_LE(segment.bytes(), size.bytes());
    const std::vector<std::uint32_t> words = distinct_words(texels);
    // In pieces that no segment is a multiple of.
    constexpr std::uint64_t kPiece = 16 * 37;
    for (std::uint64_t offset = 0; offset < 16 * texels; offset += kPiece) {
      buffer.upload(words.data() + offset / 4, std::min(kPiece, 16 * texels - offset), offset);
    }
    EXPECT_EQ(read_back(device(), buffer, size, texels), words) << texels << " texels";
  }
}

TEST_F(Segments, WhatIsTooLargeForAllOfThemIsRefused) {
  try {
    const SegmentedBuffer buffer(device(), "triangles", 16 * (64 * PPM_SEGMENTS + 1), {6});
    FAIL() << "no failure";
  } catch (const Failure& failure) {
    EXPECT_NE(std::string(failure.what()).find("buffer triangles"), std::string::npos);
  }
}

TEST_F(Segments, AreNoLargerThanTheDeviceCanHave) {
  EXPECT_EQ(gpu::segment_size(device(), std::uint64_t{1} << 27).bytes(), std::uint64_t{1} << 27);
  EXPECT_EQ(gpu::segment_size(device(), 1000).bytes(), 512u);
  EXPECT_LE(gpu::segment_size(device(), ~std::uint64_t{0}).bytes(), 16 * device().max_texels());
}

TEST(SegmentsReflection, ArraysNameTheConstantOfTheirLength) {
  const gpu::Reflection read = gpu::reflect(shaders::gpu_segments.words, "gpu_segments");
  EXPECT_EQ(read.bindings.at(PPM_BIND_TEST_0), VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
  const std::map<std::uint32_t, std::uint32_t> expected = {
      {PPM_BIND_TEST_0, PPM_SPEC_SEGMENTS + PPM_BIND_TEST_0}};
  EXPECT_EQ(read.arrays, expected);
}

}  // namespace
}  // namespace ppm::tests
