// Typed, bounds-checked reading of glTF accessors.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "gltf_document.hpp"

namespace ppm::scene::gltf {

/// glTF's componentType numbers.
enum class ComponentType : std::uint32_t {
  i8 = 5120,
  u8 = 5121,
  i16 = 5122,
  u16 = 5123,
  u32 = 5125,
  f32 = 5126
};

/// A run of equal items within a bufferView: item i lies at i * stride.
struct Items {
  ByteView bytes;
  std::uint64_t stride = 0;
  ComponentType type = ComponentType::f32;
};

/// The elements of an accessor. All bounds are checked when it is made, so that reading cannot
/// fail; nothing is copied or allocated in proportion to `count`. Strides, sparse substitution,
/// absent bufferViews (zeros) and normalised integers are as glTF 2.0 section 3.6.2 says.
class Accessor {
 public:
  /// Throws Failure where it reaches outside its bufferView or is malformed.
  explicit Accessor(const Element<tinygltf::Accessor>& element);

  const std::string& path() const { return path_; }
  std::uint64_t count() const { return count_; }
  int components() const { return components_; }
  ComponentType component_type() const { return base_.type; }

  /// Component `component` of element `i` as a real number; normalised integers lie in [-1,1].
  double real(std::uint64_t i, int component) const;
  glm::dvec2 vec2(std::uint64_t i) const { return {real(i, 0), real(i, 1)}; }
  glm::dvec3 vec3(std::uint64_t i) const { return {real(i, 0), real(i, 1), real(i, 2)}; }
  /// Element `i` of an accessor of unsigned integers, such as indices.
  std::uint64_t whole(std::uint64_t i) const { return static_cast<std::uint64_t>(real(i, 0)); }

 private:
  void read_base(const Element<tinygltf::Accessor>& element);
  void read_sparse(const Element<tinygltf::Accessor>& element);

  std::string path_;
  std::uint64_t count_ = 0;
  int components_ = 0;
  bool normalized_ = false;
  Items base_;  ///< no bytes where the accessor has no bufferView
  Items sparse_indices_, sparse_values_;
  std::uint64_t sparse_count_ = 0;
};

}  // namespace ppm::scene::gltf
