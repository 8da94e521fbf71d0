// The room's inner parts: what Device, Buffer, Kernel and Recorder hide and share among themselves.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "buffer.hpp"
#include "device.hpp"
#include "device_profile.hpp"
#include "instance.hpp"
#include "kernel.hpp"
#include "physical_device.hpp"
#include "raw_buffer.hpp"
#include "spirv_reflection.hpp"

namespace ppm::gpu {

/// What kernels of one text and the same constants share.
struct Pipeline {
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
};
using PipelineKey =
    std::pair<const std::uint32_t*,  ///< the text, which lives as long as the program
              std::vector<std::pair<std::uint32_t, std::uint32_t>>>;

/// Handles are null until made, so that the destructor clears up after a construction that failed
/// halfway.
struct Device::Implementation {
  ~Implementation();
  void open(const DeviceOptions& chosen);

  const std::string& name() const { return physical.description.name; }
  /// Names an object for tools, and the begin and end of a stretch of commands; nothing where
  /// VK_EXT_debug_utils is missing.
  template <class Handle>
  void set_name(VkObjectType type, Handle object, const std::string& text) const {
    set_name_of(type, reinterpret_cast<std::uint64_t>(object), text);
  }
  void begin_label(const char* text) const;
  void end_label() const;

  /// Starts the command buffer anew; the work recorded before must have ended.
  void begin_commands();
  /// Ends the command buffer, submits it and waits. Whatever happens, nothing runs when it returns
  /// or throws.
  void submit_and_wait();

  /// Host memory of kStagingBytes, made when first asked for.
  RawBuffer& staging();

  DeviceOptions options;
  std::unique_ptr<Instance> instance;
  PhysicalDevice physical;
  DeviceProfile profile;
  VkPhysicalDeviceMemoryProperties memory{};
  VkDevice handle = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool command_pool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
  PFN_vkSetDebugUtilsObjectNameEXT set_object_name = nullptr;
  PFN_vkCmdBeginDebugUtilsLabelEXT cmd_begin_label = nullptr;
  PFN_vkCmdEndDebugUtilsLabelEXT cmd_end_label = nullptr;

  std::uint64_t allocated_bytes = 0, peak_bytes = 0;
  std::string memory_note;  ///< tells of the first buffer that had to go to host memory
  std::unique_ptr<RawBuffer> staging_buffer;
  bool maps_device_memory = true;  ///< tests clear it, to copy through staging memory on any device

  /// Of all kernels that were ever made, for the next rendering: drivers take a tenth of a second
  /// for a large one, whatever they keep on disk. Kernels may be made by several threads.
  std::map<PipelineKey, Pipeline> pipelines;
  std::mutex pipelines_access;

  bool recording = false;  ///< a Recorder has the command buffer
  std::unique_ptr<Recorder::Implementation> recorder;
  std::map<std::string, KernelTime> times, region_times;
  std::vector<const char*> regions;  ///< open ones, the innermost last

 private:
  void set_name_of(VkObjectType type, std::uint64_t object, const std::string& text) const;
  void find_debug_calls();
  void create_device();
  void create_commands();
};

constexpr VkDeviceSize kStagingBytes = VkDeviceSize{16} << 20;

struct Buffer::Implementation {
  explicit Implementation(Device::Implementation& owner) : device(owner) {}
  ~Implementation();

  bool serves_as(VkDescriptorType type) const;
  /// Asserts that `size` bytes from `offset` on lie in the buffer.
  void check_range(std::uint64_t size, std::uint64_t offset) const;

  Device::Implementation& device;
  std::string name;
  Usage usage = Usage::storage;
  RawBuffer raw;
  VkBufferView view = VK_NULL_HANDLE;
};

struct Kernel::Implementation {
  explicit Implementation(Device::Implementation& owner) : device(owner) {}
  ~Implementation();
  void open(const Shader& shader,
            const std::vector<std::pair<std::uint32_t, std::uint32_t>>& constants);

  Device::Implementation& device;
  std::string name;
  Reflection reflection;
  std::map<std::uint32_t, std::uint32_t> descriptor_counts;  ///< by binding
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkShaderModule module = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
  bool is_shared = false;  ///< the device owns layouts and pipeline

  /// Takes in how long a dispatch took: an exponential moving average.
  void learn(double seconds, std::uint64_t items);

  double seconds_per_item = 0.0;  ///< by experience; 0: not known yet
  bool has_run = false;

 private:
  /// How many descriptors each binding has; `constants` gets those that are missing.
  void count_descriptors(std::vector<std::pair<std::uint32_t, std::uint32_t>>& constants);
  void check_limits() const;
  /// Takes layouts and pipeline from the device, if it has them; otherwise it gets those made here.
  bool take_shared(const PipelineKey& key);
  void share(const PipelineKey& key);
  void create_layouts();
  /// What the device's profile says about the constants that the shader leaves to it.
  void add_profile(std::vector<std::pair<std::uint32_t, std::uint32_t>>& constants);
  void create_pipeline(const Shader& shader,
                       const std::vector<std::pair<std::uint32_t, std::uint32_t>>& constants);
};

}  // namespace ppm::gpu
