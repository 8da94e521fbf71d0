// Random inputs that are the same on every run.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <random>

namespace ppm::tests {

class Randoms {
 public:
  explicit Randoms(std::uint32_t seed) : engine_(seed) {}

  std::uint32_t word() { return static_cast<std::uint32_t>(engine_()); }
  std::uint32_t below(std::size_t count) { return word() % static_cast<std::uint32_t>(count); }
  float in(float low, float high) {
    return low + (high - low) * static_cast<float>(word() >> 8) * 0x1p-24f;
  }
  glm::vec3 in_cube(float half) { return {in(-half, half), in(-half, half), in(-half, half)}; }
  glm::vec3 direction() {
    for (;;) {
      const glm::vec3 v = in_cube(1.0f);
      const float length = glm::length(v);
      if (length > 0.1f && length < 1.0f) return v / length;
    }
  }
  std::mt19937& engine() { return engine_; }

 private:
  std::mt19937 engine_;
};

}  // namespace ppm::tests
