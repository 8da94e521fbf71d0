// The device's counters (shared/layout.h, PPM_COUNTER_*), cleared and read around a submission.
#pragma once

#include <array>
#include <cstdint>

#include "kernel.hpp"
#include "shared/layout.h"

namespace ppm::render {

class Counters {
 public:
  explicit Counters(gpu::Device& device)
      : buffer_(device, "counters", sizeof(Values), gpu::Usage::storage) {}

  void bind(gpu::BindingTable& table) const { table.set(PPM_BIND_COUNTERS, buffer_); }
  void clear(gpu::Recorder& recorder) const { recorder.fill(buffer_, 0, sizeof(Values)); }
  /// Sets one counter to zero and leaves the others.
  void clear(gpu::Recorder& recorder, std::uint32_t counter) const {
    recorder.fill(buffer_, 0, sizeof(std::uint32_t), counter * sizeof(std::uint32_t));
  }
  /// One counter takes the value of another, which becomes zero.
  void move(gpu::Recorder& recorder, std::uint32_t from, std::uint32_t to) const {
    recorder.copy(buffer_, buffer_, 4, 4 * from, 4 * to);
    clear(recorder, from);
  }
  /// As many items as the counter says, `most` at most.
  gpu::DeviceCount count(std::uint32_t counter, std::uint64_t most) const {
    return {buffer_, counter, most, most};
  }
  /// The values are in place when the submission has ended.
  void read(gpu::Recorder& recorder) { recorder.read(buffer_, values_.data(), sizeof(Values)); }

  std::uint32_t operator[](std::uint32_t counter) const { return values_[counter]; }

 private:
  using Values = std::array<std::uint32_t, PPM_COUNTER_COUNT>;
  gpu::Buffer buffer_;
  Values values_{};
};

}  // namespace ppm::render
