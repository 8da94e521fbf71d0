#include "kernel.hpp"

#include <algorithm>

#include "call.hpp"
#include "failure.hpp"
#include "implementation.hpp"

namespace ppm::gpu {

Kernel::Kernel(Device& device, const Shader& shader,
               const std::vector<std::pair<std::uint32_t, std::uint32_t>>& constants)
    : implementation_(std::make_unique<Implementation>(device.implementation())) {
  implementation_->open(shader, constants);
}

Kernel::~Kernel() = default;
Kernel::Kernel(Kernel&&) noexcept = default;
Kernel& Kernel::operator=(Kernel&&) noexcept = default;

const std::string& Kernel::name() const {
  return implementation_->name;
}

void Kernel::Implementation::open(
    const Shader& shader, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& constants) {
  name = shader.name;
  reflection = reflect(shader.words, name);
  // What the kernel does not declare is not its business.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
  for (const auto& constant : constants) {
    if (reflection.constants.contains(constant.first)) all.push_back(constant);
  }
  count_descriptors(all);
  check_limits();
  add_profile(all);
  const PipelineKey key{shader.words.data(), all};
  if (take_shared(key)) return;
  create_layouts();
  create_pipeline(shader, all);
  share(key);
}

bool Kernel::Implementation::take_shared(const PipelineKey& key) {
  const std::scoped_lock lock(device.pipelines_access);
  const auto found = device.pipelines.find(key);
  if (found == device.pipelines.end()) return false;
  set_layout = found->second.set_layout;
  layout = found->second.layout;
  pipeline = found->second.pipeline;
  is_shared = true;
  return true;
}

void Kernel::Implementation::share(const PipelineKey& key) {
  const std::scoped_lock lock(device.pipelines_access);
  // Another thread may have made the same meanwhile; then these stay this kernel's own.
  is_shared = device.pipelines.try_emplace(key, Pipeline{set_layout, layout, pipeline}).second;
}

void Kernel::Implementation::add_profile(
    std::vector<std::pair<std::uint32_t, std::uint32_t>>& constants) {
  const auto add = [&](std::uint32_t id, std::uint32_t value) {
    if (reflection.constants.contains(id)) constants.emplace_back(id, value);
  };
  add(PPM_SPEC_ALTERNATE_HALVES, device.profile.alternate_halves ? 1 : 0);
  add(PPM_SPEC_SUBGROUP_SIZE,
      std::min(device.physical.subgroup_size, device.profile.workgroup_size));
  if (!reflection.constants.contains(PPM_SPEC_WORKGROUP_SIZE)) return;
  reflection.workgroup_size = device.profile.workgroup_size;
  add(PPM_SPEC_WORKGROUP_SIZE, reflection.workgroup_size);
}

void Kernel::Implementation::count_descriptors(
    std::vector<std::pair<std::uint32_t, std::uint32_t>>& constants) {
  for (const auto& [binding, type] : reflection.bindings) descriptor_counts[binding] = 1;
  // Of every array that is declared, in use or not, lest the driver believe in its default length.
  for (const std::uint32_t id : reflection.constants) {
    if (id < PPM_SPEC_SEGMENTS || id >= PPM_SPEC_SEGMENTS + PPM_BINDING_LIMIT) continue;
    const auto given =
        std::ranges::find(constants, id, &std::pair<std::uint32_t, std::uint32_t>::first);
    if (given == constants.end()) constants.emplace_back(id, 1);
  }
  for (const auto& [binding, id] : reflection.arrays) {
    const auto given =
        std::ranges::find(constants, id, &std::pair<std::uint32_t, std::uint32_t>::first);
    PPM_ASSERT(given != constants.end(), "kernel " + name + ", binding " + std::to_string(binding) +
                                             ": an array of unknown length");
    descriptor_counts[binding] = given->second;
  }
}

void Kernel::Implementation::check_limits() const {
  const VkPhysicalDeviceLimits& limits = device.physical.properties.limits;
  std::uint32_t storage = 0, texels = 0;
  for (const auto& [binding, type] : reflection.bindings) {
    PPM_ASSERT(binding < PPM_BINDING_LIMIT,
               "kernel " + name + ", binding " + std::to_string(binding));
    const std::uint32_t count = descriptor_counts.at(binding);
    if (type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) storage += count;
    if (type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER) texels += count;
  }
  if (storage > limits.maxPerStageDescriptorStorageBuffers ||
      texels > limits.maxPerStageDescriptorSampledImages) {
    throw Failure(device.name(), "kernel " + name,
                  "its " + std::to_string(storage) + " storage and " + std::to_string(texels) +
                      " texel buffers are more than the device binds",
                  "use a smaller scene, or choose another device with --device");
  }
}

void Kernel::Implementation::create_layouts() {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const auto& [number, type] : reflection.bindings) {
    VkDescriptorSetLayoutBinding binding{};
    binding.binding = number;
    binding.descriptorType = type;
    binding.descriptorCount = descriptor_counts.at(number);
    binding.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    bindings.push_back(binding);
  }
  VkDescriptorSetLayoutCreateInfo set_info{};
  set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  set_info.bindingCount = static_cast<std::uint32_t>(bindings.size());
  set_info.pBindings = bindings.data();
  PPM_VK_CALL(device.name(), vkCreateDescriptorSetLayout, device.handle, &set_info, nullptr,
              &set_layout);

  const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, reflection.push_bytes};
  VkPipelineLayoutCreateInfo layout_info{};
  layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layout_info.setLayoutCount = 1;
  layout_info.pSetLayouts = &set_layout;
  layout_info.pushConstantRangeCount = reflection.push_bytes > 0 ? 1 : 0;
  layout_info.pPushConstantRanges = &range;
  PPM_VK_CALL(device.name(), vkCreatePipelineLayout, device.handle, &layout_info, nullptr, &layout);
  device.set_name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, set_layout, name);
  device.set_name(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout, name);
}

void Kernel::Implementation::create_pipeline(
    const Shader& shader, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& constants) {
  VkShaderModuleCreateInfo module_info{};
  module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  module_info.codeSize = shader.words.size_bytes();
  module_info.pCode = shader.words.data();
  PPM_VK_CALL(device.name(), vkCreateShaderModule, device.handle, &module_info, nullptr, &module);
  device.set_name(VK_OBJECT_TYPE_SHADER_MODULE, module, name);

  std::vector<VkSpecializationMapEntry> entries;
  std::vector<std::uint32_t> values;
  for (const auto& [id, value] : constants) {
    entries.push_back({id, static_cast<std::uint32_t>(values.size() * sizeof value), sizeof value});
    values.push_back(value);
  }
  VkSpecializationInfo specialization{};
  specialization.mapEntryCount = static_cast<std::uint32_t>(entries.size());
  specialization.pMapEntries = entries.data();
  specialization.dataSize = values.size() * sizeof(std::uint32_t);
  specialization.pData = values.data();

  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = layout;
  PPM_VK_CALL(device.name(), vkCreateComputePipelines, device.handle, VK_NULL_HANDLE, 1, &info,
              nullptr, &pipeline);
  device.set_name(VK_OBJECT_TYPE_PIPELINE, pipeline, name);
  vkDestroyShaderModule(device.handle, module, nullptr);
  module = VK_NULL_HANDLE;
}

Kernel::Implementation::~Implementation() {
  if (is_shared) return;
  vkDestroyPipeline(device.handle, pipeline, nullptr);
  vkDestroyShaderModule(device.handle, module, nullptr);
  vkDestroyPipelineLayout(device.handle, layout, nullptr);
  vkDestroyDescriptorSetLayout(device.handle, set_layout, nullptr);
}

// The first dispatch of all may hold the driver's compilation and tells nothing, unless it stays
// the only one. Small dispatches are mostly overhead and count for little.
void Kernel::Implementation::learn(double seconds, std::uint64_t items) {
  constexpr double kFullWeightItems = 16384.0;
  constexpr std::uint64_t kTellingItems = 1024;
  const bool is_first = !has_run;
  has_run = true;
  if (is_first || (seconds_per_item == 0.0 && items < kTellingItems)) return;
  const double count = static_cast<double>(items);
  const double sample = seconds / count;
  const double weight =
      seconds_per_item == 0.0 ? 1.0 : 0.5 * std::min(1.0, count / kFullWeightItems);
  seconds_per_item += weight * (sample - seconds_per_item);
}

}  // namespace ppm::gpu
