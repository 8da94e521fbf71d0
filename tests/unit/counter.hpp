// An integrator that only counts.
#pragma once

#include <csignal>
#include <cstdint>
#include <functional>

#include "failure.hpp"
#include "integrator.hpp"

namespace ppm::test {

/// Its picture's red channel is the number of passes.
class Counter : public render::Integrator {
 public:
  explicit Counter(const render::Settings& settings) : settings_(settings) {}

  bool prepare(const std::function<bool()>& interrupted) override {
    ++prepared;
    if (interrupt_in_prepare) std::raise(SIGINT);
    return !interrupted();
  }
  bool advance(const std::function<bool()>& interrupted) override {
    if (counted.passes + 1 == interrupt_in_pass) std::raise(SIGTERM);
    if (interrupted()) return false;
    ++counted.passes;
    counted.photons_emitted += settings_.photons_per_pass;
    counted.pass_seconds.push_back(0.5);
    return true;
  }
  void look_from(const scene::Camera& /*camera*/) override {
    ++looked;
    counted = {};
  }
  render::Picture resolve() override {
    render::Picture picture{settings_.width, settings_.height, {}};
    for (std::uint32_t i = 0; i < settings_.width * settings_.height; ++i) {
      picture.rgb.insert(picture.rgb.end(), {static_cast<float>(counted.passes), 0.5f, 0.25f});
    }
    return picture;
  }
  render::SavedState save_state() override {
    return {static_cast<std::uint8_t>(counted.passes),
            static_cast<std::uint8_t>(counted.passes >> 8)};
  }
  void restore_state(const render::SavedState& state) override {
    if (state.size() != 2) throw Failure("", "saved state", "truncated", "");
    counted.passes = state[0] + 256u * state[1];
    counted.photons_emitted = counted.passes * settings_.photons_per_pass;
  }
  const render::Statistics& statistics() override { return counted; }

  render::Statistics counted;
  int prepared = 0, looked = 0;
  bool interrupt_in_prepare = false;
  std::uint64_t interrupt_in_pass = 0;

 private:
  render::Settings settings_;
};

}  // namespace ppm::test
