// Texels in several buffers, for what is larger than one buffer ought to be.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "buffer.hpp"

namespace ppm::gpu {

/// Every segment but the last has 2^shift texels of 16 bytes; PPM_SPEC_SEGMENT_SHIFT tells the
/// kernels.
struct SegmentSize {
  std::uint32_t shift = 23;  ///< 128 MiB

  std::uint64_t bytes() const { return std::uint64_t{16} << shift; }
};

/// The largest segments of at most `most_bytes` (128 MiB unless tests want otherwise; at least 16)
/// that the device can have.
SegmentSize segment_size(const Device& device, std::uint64_t most_bytes);

/// Read-only texels of any number of bytes, as kernels declare them with PPM_SEGMENTED_TEXELS: all
/// segments are full but the last.
class SegmentedBuffer {
 public:
  SegmentedBuffer() = default;
  /// Throws Failure where PPM_SEGMENTS of them do not hold so much, and as Buffer does.
  SegmentedBuffer(Device& device, const std::string& name, std::uint64_t bytes, SegmentSize size);

  std::span<const Buffer> segments() const { return segments_; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(segments_.size()); }

  /// As Buffer::upload; may reach over any number of segments.
  void upload(const void* data, std::uint64_t size, std::uint64_t offset = 0);

 private:
  SegmentSize size_;
  std::vector<Buffer> segments_;
};

}  // namespace ppm::gpu
