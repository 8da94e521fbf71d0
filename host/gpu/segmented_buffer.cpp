#include "segmented_buffer.hpp"

#include <algorithm>
#include <bit>

#include "failure.hpp"
#include "shared/bindings.h"

namespace ppm::gpu {

SegmentSize segment_size(const Device& device, std::uint64_t most_bytes) {
  const std::uint64_t texels = std::min(most_bytes / 16, device.max_texels());
  return {static_cast<std::uint32_t>(std::bit_width(std::max<std::uint64_t>(texels, 1)) - 1)};
}

SegmentedBuffer::SegmentedBuffer(Device& device, const std::string& name, std::uint64_t bytes,
                                 SegmentSize size)
    : size_(size) {
  const std::uint64_t segment = size.bytes();
  const std::uint64_t count = std::max<std::uint64_t>((bytes + segment - 1) / segment, 1);
  if (count > PPM_SEGMENTS) {
    throw Failure(device.description().name, "buffer " + name,
                  "its " + std::to_string(bytes) + " bytes are more than " +
                      std::to_string(PPM_SEGMENTS) + " segments of " + std::to_string(segment),
                  "use a smaller scene");
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::string part = count == 1 ? name : name + " " + std::to_string(i);
    segments_.emplace_back(device, part, std::min(segment, bytes - i * segment), Usage::texels);
  }
}

void SegmentedBuffer::upload(const void* data, std::uint64_t size, std::uint64_t offset) {
  const auto* bytes = static_cast<const std::byte*>(data);
  for (std::uint64_t done = 0; done < size;) {
    const std::uint64_t at = offset + done, within = at % size_.bytes();
    const std::uint64_t piece = std::min(size - done, size_.bytes() - within);
    segments_.at(at / size_.bytes()).upload(bytes + done, piece, within);
    done += piece;
  }
}

}  // namespace ppm::gpu
