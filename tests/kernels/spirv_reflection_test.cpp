// What is read from SPIR-V, against what the shaders' text declares.
#include "spirv_reflection.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "ppm_gpu_test_shaders.hpp"
#include "shared/bindings.h"

namespace ppm::tests {
namespace {

using gpu::Reflection;
using Bindings = std::map<std::uint32_t, VkDescriptorType>;

TEST(SpirvReflection, ListsTheBuffersInUse) {
  const Reflection read = gpu::reflect(shaders::gpu_read.words, "gpu_read");
  const Bindings expected = {
      {PPM_BIND_TEST_0, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER},
      {PPM_BIND_TEST_1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
      {PPM_BIND_TEST_2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
      {PPM_BIND_TEST_3, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
  };
  EXPECT_EQ(read.bindings, expected);
  EXPECT_EQ(read.push_bytes, 8u);
  EXPECT_EQ(read.workgroup_size, 32u);
}

TEST(SpirvReflection, MeasuresThePushBlock) {
  const Reflection push = gpu::reflect(shaders::gpu_push.words, "gpu_push");
  EXPECT_EQ(push.push_bytes, 128u);
  EXPECT_EQ(push.workgroup_size, 16u);
  EXPECT_EQ(gpu::reflect(shaders::gpu_step.words, "gpu_step").push_bytes, 12u);
}

TEST(SpirvReflectionDeathTest, WhatIsNoModuleIsNamed) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const std::vector<std::uint32_t> text = {1, 2, 3, 4, 5, 6};
  EXPECT_DEATH(gpu::reflect(text, "text"), "shader text is not SPIR-V");
  const auto words = shaders::gpu_read.words;
  std::vector<std::uint32_t> cut(words.begin(), words.end());
  cut.back() |= 7u << 16;  // OpFunctionEnd, now longer than what is left
  EXPECT_DEATH(gpu::reflect(cut, "cut"), "shader cut is cut short");
}

}  // namespace
}  // namespace ppm::tests
