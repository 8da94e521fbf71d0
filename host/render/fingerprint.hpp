// What tells one rendering from another, for saved states.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "scene.hpp"

namespace ppm::render {

class Hash {  // FNV-1a, 64 bits
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3ull;
  }
  template <class T>
  void add(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    add(&value, sizeof value);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

/// All of the scene that shows in a picture, but for its camera. Its arrays must not have been
/// released.
void add_scene(Hash& hash, const scene::Scene& scene);

}  // namespace ppm::render
