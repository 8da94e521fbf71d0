// What goes wrong outside the program: no such device, too little memory, any Vulkan call that
// fails.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "call.hpp"
#include "device_fixture.hpp"
#include "failure.hpp"
#include "implementation.hpp"
#include "kernel.hpp"
#include "ppm_gpu_test_shaders.hpp"

namespace ppm::tests {
namespace {

using gpu::BindingTable;
using gpu::Buffer;
using gpu::FaultInjection;
using gpu::Kernel;
using gpu::Recorder;
using gpu::Usage;

struct RangePush {
  std::uint32_t first = 0, count = 0;
};

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Buffers of both kinds, copies through staging memory, a kernel, and a run of every kind of
// command.
void use(gpu::Device& device) {
  device.implementation().maps_device_memory = false;
  Buffer words(device, "words", 4096, Usage::storage_and_texels);
  const std::vector<std::uint32_t> zeros(1024, 0);
  words.upload<std::uint32_t>(zeros);
  const Kernel kernel(device, shaders::gpu_count);
  BindingTable table;
  table.set(PPM_BIND_TEST_0, words);
  std::uint32_t seen = 0;
  device.run([&](Recorder& recorder) {
    recorder.dispatch(kernel, table, RangePush{}, gpu::DeviceCount{words, 0, 64, 64});  // of none
    recorder.fill(words, 5, 2048);
    recorder.dispatch(kernel, table, RangePush{}, 1024);
    recorder.copy(words, words, 4, 0, 4092);
    recorder.read(words, &seen, 4);
  });
  std::vector<std::uint32_t> expected(1024, 1);
  std::fill_n(expected.begin(), 512, 6u);
  expected[1023] = 6;
  EXPECT_EQ(seen, 6u);
  EXPECT_TRUE(words.download<std::uint32_t>(1024) == expected);
}

class GpuFailure : public DeviceTest {
 protected:
  void TearDown() override {
    gpu::fault_injection() = FaultInjection{};
    DeviceTest::TearDown();
  }

  // Lets each of the calls that `action` makes fail in turn: a Failure must name it.
  template <class Action>
  static void fail_each_call(const Action& action) {
    FaultInjection& injection = gpu::fault_injection();
    injection = FaultInjection{};
    action();
    const std::uint64_t calls = injection.calls;
    ASSERT_GT(calls, 20u);
    for (std::uint64_t i = 1; i <= calls; ++i) {
      injection = FaultInjection{.fail_at = i, .result = VK_ERROR_DEVICE_LOST};
      const std::string message = message_of(action);
      ASSERT_NE(injection.failed, nullptr) << "call " << i;
      EXPECT_TRUE(contains(message, std::string(injection.failed) + ": VK_ERROR_DEVICE_LOST"))
          << injection.failed << " failed, and the message was: " << message;
    }
    injection = FaultInjection{};
  }
};

TEST_F(GpuFailure, EveryCallOfADevicesLifeFailsCleanly) {
  const std::string name = device().description().name;
  fail_each_call([&] {
    gpu::Device fresh({.selector = name, .validation = true});
    use(fresh);
  });
}

TEST_F(GpuFailure, ADeviceOutlivesFailedCallsAndKeepsItsAccount) {
  use(device());
  const std::uint64_t before = device().allocated_bytes();
  fail_each_call([&] { use(device()); });
  EXPECT_EQ(device().allocated_bytes(), before);
  use(device());
  device().implementation().maps_device_memory = true;
}

TEST_F(GpuFailure, AnExceptionWhileRecordingLeavesTheDeviceUsable) {
  const std::string message = message_of(
      [&] { device().run([&](Recorder&) { throw Failure("", "", "stopped by its user", ""); }); });
  EXPECT_EQ(message, "stopped by its user");
  use(device());
  device().implementation().maps_device_memory = true;
}

TEST_F(GpuFailure, AShortageNamesTheBufferAndItsSize) {
  FaultInjection& injection = gpu::fault_injection();
  const std::uint64_t before = device().allocated_bytes();
  std::string message, failed;
  for (std::uint64_t call = 1; failed != "vkAllocateMemory"; ++call) {
    ASSERT_LT(call, 10u);
    injection = FaultInjection{.fail_at = call, .result = VK_ERROR_OUT_OF_DEVICE_MEMORY};
    message = message_of([&] { const Buffer buffer(device(), "great", 3 << 20, Usage::storage); });
    failed = injection.failed;
  }
  EXPECT_EQ(device().allocated_bytes(), before);
  if (device().implementation().memory.memoryTypeCount > 1) GTEST_SKIP() << "went to other memory";
  EXPECT_TRUE(contains(message, "VK_ERROR_OUT_OF_DEVICE_MEMORY for 3 MiB of the buffer great"))
      << message;
}

TEST_F(GpuFailure, BuffersBeyondTheLimitsAreRefused) {
  const std::uint64_t storage = device().max_storage_bytes(), texels = device().max_texels() * 16;
  EXPECT_TRUE(contains(
      message_of([&] { const Buffer buffer(device(), "hits", storage + 1, Usage::storage); }),
      "buffer hits: its " + std::to_string(storage + 4) +
          " bytes are more than the device allows: " + std::to_string(storage) +
          " (maxStorageBufferRange)"));
  EXPECT_TRUE(contains(
      message_of([&] { const Buffer buffer(device(), "nodes", texels + 1, Usage::texels); }),
      "maxTexelBufferElements"));
  EXPECT_TRUE(contains(
      message_of([&] { const Buffer buffer(device(), "block", 1ull << 40, Usage::uniform); }),
      "maxUniformBufferRange"));
}

TEST(MemoryCandidates, DeviceMemoryFirstThenWhatTheHostReadsWell) {
  // A discrete GPU: device memory, a window of it for the host, host memory, and that cached.
  VkPhysicalDeviceMemoryProperties memory{};
  constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                  kVisible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                             VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                                  kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT,
                                  kAmd = VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD;
  for (const VkMemoryPropertyFlags flags : {VkMemoryPropertyFlags{0}, kVisible, kLocal,
                                            kVisible | kCached, kLocal | kVisible, kLocal | kAmd}) {
    memory.memoryTypes[memory.memoryTypeCount++].propertyFlags = flags;
  }
  using Types = std::vector<std::uint32_t>;
  EXPECT_EQ(memory_candidates(memory, 0x3f, gpu::Memory::device), (Types{2, 4, 3, 1}));
  EXPECT_EQ(memory_candidates(memory, 0x3f, gpu::Memory::host), (Types{3, 1, 4}));
  EXPECT_EQ(memory_candidates(memory, 0x1a, gpu::Memory::device), (Types{4, 3, 1}));
}

gpu::PhysicalDevice made_up(std::uint32_t index, const char* name, VkPhysicalDeviceType type,
                            std::vector<std::string> obstacles = {}) {
  gpu::PhysicalDevice device;
  device.properties.deviceType = type;
  device.description.index = index;
  device.description.name = name;
  device.description.obstacles = std::move(obstacles);
  return device;
}

TEST(DeviceChoice, TakesTheBestOrTheOneAskedFor) {
  const std::vector<gpu::PhysicalDevice> devices = {
      made_up(0, "Soft Renderer", VK_PHYSICAL_DEVICE_TYPE_CPU),
      made_up(1, "Old Card", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, {"the feature x is missing"}),
      made_up(2, "Chip 9000", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU),
      made_up(3, "Card 1", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
  };
  const auto index = [&](const char* selector) {
    return choose(devices, selector).description.index;
  };
  EXPECT_EQ(index(""), 3u);
  EXPECT_EQ(index("0"), 0u);
  EXPECT_EQ(index("soft"), 0u);
  EXPECT_EQ(index("CHIP"), 2u);
  EXPECT_EQ(index("card"), 3u);
  EXPECT_EQ(index("9000"), 2u);
  EXPECT_EQ(message_of([&] { index("7"); }),
            "--device: 7: no Vulkan device has this index or name: there is 0 (Soft Renderer), "
            "1 (Old Card), 2 (Chip 9000), 3 (Card 1)");
  EXPECT_TRUE(contains(message_of([&] { index("old"); }),
                       "Old Card: cannot serve: the feature x is missing"));
}

// Index 1 and name "Card 1": the index wins.
TEST(DeviceChoice, AnIndexIsNoPartOfAName) {
  const std::vector<gpu::PhysicalDevice> devices = {
      made_up(0, "Card 1", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
      made_up(1, "Soft Renderer", VK_PHYSICAL_DEVICE_TYPE_CPU),
  };
  EXPECT_EQ(choose(devices, "1").description.index, 1u);
}

// A variable of the environment while it lives.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* const before = std::getenv(name)) before_ = before;
    setenv(name, value, 1);
  }
  ~Environment() { before_.empty() ? unsetenv(name_) : setenv(name_, before_.c_str(), 1); }

 private:
  const char* name_;
  std::string before_;
};

TEST(DeviceList, WithoutADriverSaysWhatToInstall) {
  const Environment new_name("VK_DRIVER_FILES", "/nonexistent.json");
  const Environment old_name("VK_ICD_FILENAMES", "/nonexistent.json");
  const std::string message = message_of([] { gpu::list_devices(); });
  EXPECT_TRUE(contains(message, "mesa-vulkan-drivers")) << message;
}

TEST(DeviceList, WithoutTheLayerSaysWhatToInstall) {
  const Environment layers("VK_LAYER_PATH", "/nonexistent");
  const std::string message =
      message_of([] { gpu::Device device({.selector = "", .validation = true}); });
  EXPECT_TRUE(contains(message, "vulkan-validationlayers")) << message;
}

TEST(DeviceList, SaysWhatThereIs) {
  const auto devices = gpu::list_devices();
  ASSERT_FALSE(devices.empty());
  for (std::uint32_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].index, i);
    EXPECT_FALSE(devices[i].name.empty() || devices[i].driver.empty() || devices[i].type.empty());
    EXPECT_EQ(devices[i].api_version.substr(0, 2), "1.");
    EXPECT_GT(devices[i].memory_bytes, 0u);
  }
}

}  // namespace
}  // namespace ppm::tests
