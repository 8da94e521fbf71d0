// Compute pipelines, the buffers bound to them, and the recording of their dispatches.
#pragma once

#include <array>
#include <cstring>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "segmented_buffer.hpp"
#include "shader.hpp"
#include "shared/bindings.h"

namespace ppm::gpu {

/// Buffers by binding number (shared/bindings.h). Plain pointers: the buffers must outlive every
/// use.
class BindingTable {
 public:
  void set(std::uint32_t binding, const Buffer& buffer) { buffers_.at(binding) = {&buffer, 1}; }
  /// Segments, for kernels that were made for so many of them.
  void set(std::uint32_t binding, const SegmentedBuffer& buffer) {
    buffers_.at(binding) = buffer.segments();
  }
  const Buffer* get(std::uint32_t binding) const { return buffers_.at(binding).data(); }
  std::span<const Buffer> segments(std::uint32_t binding) const { return buffers_.at(binding); }

 private:
  std::array<std::span<const Buffer>, PPM_BINDING_LIMIT> buffers_{};
};

/// A pipeline whose set layout and push constant size come from its SPIR-V.
/// Specialisation constants are given as (constant_id, 32-bit value). Buffers in segments have one
/// unless PPM_SPEC_SEGMENTS + binding says otherwise.
class Kernel {
 public:
  Kernel(Device& device, const Shader& shader,
         const std::vector<std::pair<std::uint32_t, std::uint32_t>>& constants = {});
  ~Kernel();
  Kernel(Kernel&&) noexcept;
  Kernel& operator=(Kernel&&) noexcept;

  const std::string& name() const;
  struct Implementation;
  Implementation& implementation() const { return *implementation_; }

 private:
  std::unique_ptr<Implementation> implementation_;
};

/// How many items a dispatch has, as words that earlier commands write.
struct DeviceCount {
  const Buffer& buffer;        ///< Usage::storage, or storage_and_texels
  std::uint32_t word = 0;      ///< index of the count
  std::uint64_t most = 0;      ///< a larger count is taken for this
  std::uint64_t expected = 0;  ///< a guess, for cutting into ranges; the last takes what is more
  std::uint32_t rows = 1;      ///< row y (gl_WorkGroupID.y) has the count words[word + y]
};

/// Commands of one submission, in order: each sees the results of those before it (barriers are
/// implied).
class Recorder {
 public:
  /// Runs `kernel` over items [0, count). The push block must begin with `uint first, count`, which
  /// are filled in here: `first` and `count` of each range, as the items are cut into dispatches
  /// that keep within the device's dispatch time, judged by how long this kernel's items took
  /// before. Nothing is recorded for no items. The buffers that the kernel declares are taken from
  /// `table`; one that is missing is a programming error.
  template <class Push>
  void dispatch(const Kernel& kernel, const BindingTable& table, Push push, std::uint64_t count) {
    static_assert(std::is_trivially_copyable_v<Push> && sizeof(Push) <= 128);
    dispatch_bytes(kernel, table, &push, sizeof(Push), count);
  }

  /// The same over items [0, count) with a count that only the device knows. Ranges may reach
  /// beyond it (`first + count` is no bound for the last), and in a row beyond that row's: the
  /// kernel must compare its items with the count, too.
  template <class Push>
  void dispatch(const Kernel& kernel, const BindingTable& table, Push push,
                const DeviceCount& count) {
    static_assert(std::is_trivially_copyable_v<Push> && sizeof(Push) <= 128);
    dispatch_counted(kernel, table, &push, sizeof(Push), count);
  }

  void fill(const Buffer& buffer, std::uint32_t word, std::uint64_t bytes,
            std::uint64_t offset = 0);
  void copy(const Buffer& from, const Buffer& to, std::uint64_t bytes,
            std::uint64_t from_offset = 0, std::uint64_t to_offset = 0);
  /// Copies into `destination` when the submission has ended; it must live until then. At most 64
  /// KiB.
  void read(const Buffer& buffer, void* destination, std::uint64_t bytes, std::uint64_t offset = 0);

  struct Implementation;
  explicit Recorder(Implementation& implementation) : implementation_(implementation) {}

 private:
  void dispatch_bytes(const Kernel& kernel, const BindingTable& table, void* push,
                      std::size_t push_bytes, std::uint64_t count);
  void dispatch_counted(const Kernel& kernel, const BindingTable& table, void* push,
                        std::size_t push_bytes, const DeviceCount& count);
  Implementation& implementation_;
};

}  // namespace ppm::gpu
