// The film of methods that add up samples: sums in fixed point on the device (shared/film.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "integrator.hpp"
#include "kernel.hpp"
#include "shared/film.h"
#include "shared/layout.h"

namespace ppm::render {

class Film {
 public:
  /// Of the picture and for the light that `scene` tells of. Black. `keeps`: whether `keep` may
  /// take memory. Throws Failure where the picture is too large for the device.
  Film(gpu::Device& device, const shared::SceneConstants& scene, bool keeps = true);

  void bind(gpu::BindingTable& table) const;
  /// The sums alone, as three buffers from this binding on, beside another film.
  void bind_sums(gpu::BindingTable& table, std::uint32_t first_binding) const;
  void clear();

  /// Remembers what there is now, for a pass that may have to be discarded. False: there is no
  /// memory for that, and the pass must be finished.
  bool keep();
  /// Back to what was kept last.
  void revert();

  /// What has been added, divided by `samples` (positive): radiance.
  Picture resolve(double samples) const;

  /// All sums, bit by bit; to be given back to a film of the same picture.
  std::vector<std::uint32_t> save() const;
  /// False, and nothing is changed, unless there are as many words as `save` gives.
  bool restore(std::span<const std::uint32_t> words);

  /// What a film of so many pixels takes on the device, and what it keeps as much again.
  static std::uint64_t bytes(std::uint64_t pixels) { return 3 * sizeof(shared::FilmSum) * pixels; }

 private:
  std::uint64_t pixels() const { return std::uint64_t{constants_.width} * constants_.height; }

  gpu::Device& device_;
  shared::FilmConstants constants_;
  gpu::Buffer constants_buffer_;
  bool keeps_;
  std::array<gpu::Buffer, 3> planes_, kept_;
};

}  // namespace ppm::render
