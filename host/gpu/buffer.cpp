#include "buffer.hpp"

#include <algorithm>
#include <cstring>

#include "call.hpp"
#include "failure.hpp"
#include "implementation.hpp"

namespace ppm::gpu {
namespace {

constexpr std::uint64_t kTexelBytes = 16;

bool has_texels(Usage usage) {
  return usage == Usage::texels || usage == Usage::storage_and_texels;
}
bool has_storage(Usage usage) {
  return usage == Usage::storage || usage == Usage::storage_and_texels;
}

VkBufferUsageFlags vulkan_usage(Usage usage) {
  VkBufferUsageFlags flags = 0;
  if (has_storage(usage)) flags |= VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  if (has_texels(usage)) flags |= VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
  if (usage == Usage::uniform) flags |= VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
  return flags;
}

// vkCmdFillBuffer wants multiples of 4, texel buffers whole texels.
std::uint64_t rounded_size(std::uint64_t bytes, Usage usage) {
  const std::uint64_t unit = has_texels(usage) ? kTexelBytes : 4;
  return std::max((bytes + unit - 1) / unit * unit, kTexelBytes);
}

void check_limit(const Device::Implementation& device, const std::string& name, std::uint64_t bytes,
                 std::uint64_t limit, const char* limit_name) {
  if (bytes <= limit) return;
  throw Failure(device.name(), "buffer " + name,
                "its " + std::to_string(bytes) + " bytes are more than the device allows: " +
                    std::to_string(limit) + " (" + limit_name + ")",
                "use a smaller scene, fewer photons, or another device with --device");
}

void check_limits(const Device& handle, const Device::Implementation& device,
                  const std::string& name, std::uint64_t bytes, Usage usage) {
  if (has_storage(usage)) {
    check_limit(device, name, bytes, handle.max_storage_bytes(), "maxStorageBufferRange");
  }
  if (has_texels(usage)) {
    check_limit(device, name, bytes, handle.max_texels() * kTexelBytes, "maxTexelBufferElements");
  }
  if (usage == Usage::uniform) {
    check_limit(device, name, bytes, device.physical.properties.limits.maxUniformBufferRange,
                "maxUniformBufferRange");
  }
  check_limit(device, name, bytes, device.physical.max_allocation, "maxMemoryAllocationSize");
}

void copy_now(Device::Implementation& device, VkBuffer from, VkDeviceSize from_offset, VkBuffer to,
              VkDeviceSize to_offset, VkDeviceSize size) {
  device.begin_commands();
  const VkBufferCopy region{from_offset, to_offset, size};
  vkCmdCopyBuffer(device.commands, from, to, 1, &region);
  device.submit_and_wait();
}

}  // namespace

Buffer::Implementation::~Implementation() {
  vkDestroyBufferView(device.handle, view, nullptr);
}

bool Buffer::Implementation::serves_as(VkDescriptorType type) const {
  switch (type) {
    case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
      return has_storage(usage);
    case VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER:
      return has_texels(usage);
    default:
      return usage == Usage::uniform;
  }
}

void Buffer::Implementation::check_range(std::uint64_t size, std::uint64_t offset) const {
  PPM_ASSERT(offset <= raw.bytes() && size <= raw.bytes() - offset,
             "buffer " + name + " has " + std::to_string(raw.bytes()) + " bytes, asked for " +
                 std::to_string(size) + " from " + std::to_string(offset) + " on");
}

Buffer::Buffer(Device& device, std::string name, std::uint64_t bytes, Usage usage)
    : implementation_(std::make_unique<Implementation>(device.implementation())) {
  Implementation& self = *implementation_;
  self.name = std::move(name);
  self.usage = usage;
  const std::uint64_t size = rounded_size(bytes, usage);
  check_limits(device, self.device, self.name, size, usage);
  self.raw.create(self.device, self.name, size, vulkan_usage(usage), Memory::device);
  if (!has_texels(usage)) return;
  VkBufferViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO;
  info.buffer = self.raw.handle();
  info.format = VK_FORMAT_R32G32B32A32_UINT;
  info.range = VK_WHOLE_SIZE;
  PPM_VK_CALL(self.device.name(), vkCreateBufferView, self.device.handle, &info, nullptr,
              &self.view);
  self.device.set_name(VK_OBJECT_TYPE_BUFFER_VIEW, self.view, self.name);
}

Buffer::Buffer() = default;
Buffer::~Buffer() = default;
Buffer::Buffer(Buffer&&) noexcept = default;
Buffer& Buffer::operator=(Buffer&&) noexcept = default;

std::uint64_t Buffer::bytes() const {
  return implementation_->raw.bytes();
}
const std::string& Buffer::name() const {
  return implementation_->name;
}

void Buffer::upload(const void* data, std::uint64_t size, std::uint64_t offset) {
  Implementation& self = *implementation_;
  self.check_range(size, offset);
  const auto* bytes = static_cast<const std::byte*>(data);
  if (self.raw.mapped()) {
    if (size > 0) std::memcpy(self.raw.mapped() + offset, bytes, size);
    return;
  }
  for (std::uint64_t done = 0; done < size; done += kStagingBytes) {
    RawBuffer& staging = self.device.staging();
    const std::uint64_t piece = std::min<std::uint64_t>(size - done, kStagingBytes);
    std::memcpy(staging.mapped(), bytes + done, piece);
    copy_now(self.device, staging.handle(), 0, self.raw.handle(), offset + done, piece);
  }
}

void Buffer::download(void* data, std::uint64_t size, std::uint64_t offset) const {
  const Implementation& self = *implementation_;
  self.check_range(size, offset);
  auto* bytes = static_cast<std::byte*>(data);
  if (self.raw.mapped()) {
    if (size > 0) std::memcpy(bytes, self.raw.mapped() + offset, size);
    return;
  }
  for (std::uint64_t done = 0; done < size; done += kStagingBytes) {
    RawBuffer& staging = self.device.staging();
    const std::uint64_t piece = std::min<std::uint64_t>(size - done, kStagingBytes);
    copy_now(self.device, self.raw.handle(), offset + done, staging.handle(), 0, piece);
    std::memcpy(bytes + done, staging.mapped(), piece);
  }
}

}  // namespace ppm::gpu
