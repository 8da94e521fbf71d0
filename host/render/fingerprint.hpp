// What tells one rendering from another, for saved states.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

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

/// A part of a scene, by a name for people, and the hash of what it holds.
struct PartHash {
  std::string part;
  std::uint64_t value = 0;

  bool operator==(const PartHash&) const = default;
};

/// Of all of the scene that shows in a picture, but for its camera. Arrays that were released count
/// as empty.
std::vector<PartHash> part_hashes(const scene::Scene& scene);

/// All parts of the scene, as part_hashes.
void add_scene(Hash& hash, const scene::Scene& scene);
/// Its name, where it stands, where it looks and how wide.
void add_camera(Hash& hash, const scene::Camera& camera);

}  // namespace ppm::render
