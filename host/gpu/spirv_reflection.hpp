// What a compute shader's SPIR-V says about the buffers and constants it uses.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>

namespace ppm::gpu {

struct Reflection {
  /// Binding number -> kind of descriptor, of those variables of set 0 that some instruction uses:
  /// storage buffers, uniform buffers, uniform texel buffers.
  std::map<std::uint32_t, VkDescriptorType> bindings;
  /// Of those, the arrays: binding number -> number of the specialisation constant that holds how
  /// many descriptors it has.
  std::map<std::uint32_t, std::uint32_t> arrays;
  std::uint32_t push_bytes = 0;       ///< end of the push constant block's last member; 0: no block
  std::uint32_t workgroup_size = 1;   ///< invocations along x by default; y and z have one
  std::set<std::uint32_t> constants;  ///< numbers of the specialisation constants it declares
};

/// Walks a valid module with one entry point, SPIR-V 1.3 or later. `name` is for messages. Shaders
/// are part of the program, so that anything it does not know (another set, images, storage texels,
/// a workgroup size by id alone) is an assertion.
Reflection reflect(std::span<const std::uint32_t> words, const std::string& name);

}  // namespace ppm::gpu
