// A buffer with its memory, its name and, where it is read as texels, its view.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "device.hpp"

namespace ppm::gpu {

/// What kernels may do with a buffer. Any buffer can be a copy's source or destination.
enum class Usage {
  storage,  ///< storage buffer only; at most Device::max_storage_bytes
  texels,   ///< read-only uvec4 texels; size rounded up to 16 bytes; at most Device::max_texels
            ///< texels
  storage_and_texels,  ///< written as storage in one dispatch, read as texels in another
  uniform,             ///< a uniform block
};

/// Device-local memory, or host memory where the device's is full (the first such fallback is told
/// by Device::memory_note). Zero-sized requests get 16 bytes. Movable; freed on destruction. Throws
/// Failure that names the buffer, its size and what would mend it when memory or a limit is short.
class Buffer {
 public:
  Buffer();
  Buffer(Device& device, std::string name, std::uint64_t bytes, Usage usage);
  ~Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;

  std::uint64_t bytes() const;
  const std::string& name() const;
  explicit operator bool() const { return implementation_ != nullptr; }

  /// Blocking copies through staging memory in pieces of bounded size. Offsets and sizes in bytes.
  void upload(const void* data, std::uint64_t size, std::uint64_t offset = 0);
  void download(void* data, std::uint64_t size, std::uint64_t offset = 0) const;

  template <class T>
  void upload(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    upload(values.data(), values.size_bytes());
  }
  template <class T>
  std::vector<T> download(std::size_t count) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(count);
    download(values.data(), count * sizeof(T));
    return values;
  }

  struct Implementation;
  Implementation* implementation() const { return implementation_.get(); }

 private:
  std::unique_ptr<Implementation> implementation_;
};

/// A buffer that holds `values` (at least 16 bytes).
template <class T>
Buffer make_buffer(Device& device, std::string name, std::span<const T> values, Usage usage) {
  Buffer buffer(device, std::move(name), values.size_bytes(), usage);
  if (!values.empty()) buffer.upload(values);
  return buffer;
}

}  // namespace ppm::gpu
