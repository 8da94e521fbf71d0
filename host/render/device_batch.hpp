// What the device decides about a batch of passes (shared/layout.h, BatchWords), around a
// submission.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel.hpp"
#include "shared/layout.h"

namespace ppm::render {

class DeviceBatch {
 public:
  explicit DeviceBatch(gpu::Device& device)
      : buffer_(device, "batch", sizeof(shared::BatchWords), gpu::Usage::storage) {}

  void bind(gpu::BindingTable& table) const { table.set(PPM_BIND_BATCH, buffer_); }

  /// Nothing done yet, `paths` paths to be traced.
  void begin(gpu::Recorder& recorder, std::uint32_t paths) const {
    recorder.fill(buffer_, 0, sizeof values_);
    set(recorder, offsetof(shared::BatchWords, alive), paths);
  }
  /// The paths that were left after `rounds` rounds are those that the next ones begin with.
  void begin_again(gpu::Recorder& recorder, std::uint32_t rounds) const {
    constexpr std::size_t kAlive = offsetof(shared::BatchWords, alive);
    recorder.copy(buffer_, buffer_, 4, kAlive + 4 * rounds, kAlive);
    recorder.fill(buffer_, 0, 4 * PPM_TRACE_ROUNDS, kAlive + 4);
  }
  /// Says of the only pass how many photons there are to be sorted.
  void set_sortable(gpu::Recorder& recorder, std::uint32_t photons) const {
    set(recorder, offsetof(shared::BatchWords, sortable), photons);
  }
  /// The values are in place when the submission has ended.
  void read(gpu::Recorder& recorder) { recorder.read(buffer_, &values_, sizeof values_); }
  const shared::BatchWords& operator*() const { return values_; }
  const shared::BatchWords* operator->() const { return &values_; }

  /// Paths that a round begins with.
  gpu::DeviceCount alive(std::uint32_t round, std::uint64_t most, std::uint64_t expected) const {
    return {buffer_, word(offsetof(shared::BatchWords, alive)) + round, most, expected};
  }
  /// Photons to be sorted, a row for each pass.
  gpu::DeviceCount sortable(std::uint32_t passes, std::uint64_t most,
                            std::uint64_t expected) const {
    return {buffer_, word(offsetof(shared::BatchWords, sortable)), most, expected, passes};
  }
  /// All of so many items as long as the batch may go on, else none.
  gpu::DeviceCount if_going_on(std::uint64_t items) const {
    return {buffer_, word(offsetof(shared::BatchWords, go_on)), items, items};
  }

 private:
  static constexpr std::uint32_t word(std::size_t offset) {
    return static_cast<std::uint32_t>(offset / 4);
  }
  void set(gpu::Recorder& recorder, std::size_t offset, std::uint32_t value) const {
    recorder.fill(buffer_, value, 4, offset);
  }

  gpu::Buffer buffer_;
  shared::BatchWords values_{};
};

}  // namespace ppm::render
