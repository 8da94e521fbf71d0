// Typed, bounds-checked reading of glTF accessors.
#pragma once

#include <cstdint>
#include <cstring>
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

/// Bytes of one component.
std::uint64_t size_of(ComponentType type);

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
  /// Its elements come from `decoded`, tightly packed, instead of a bufferView. `decoded` holds
  /// what count, type and componentType ask for, and outlives this.
  Accessor(const Element<tinygltf::Accessor>& element, ByteView decoded);

  const std::string& path() const { return path_; }
  std::uint64_t count() const { return count_; }
  int components() const { return components_; }
  ComponentType component_type() const { return base_.type; }
  bool normalized() const { return normalized_; }

  /// Component `component` of element `i` as a real number; normalised integers lie in [-1,1].
  double real(std::uint64_t i, int component) const;
  /// The first components of element `i`, of which it must have as many.
  glm::dvec2 vec2(std::uint64_t i) const { return vector<2>(i); }
  glm::dvec3 vec3(std::uint64_t i) const { return vector<3>(i); }
  glm::dvec4 vec4(std::uint64_t i) const { return vector<4>(i); }
  /// Element `i` of an accessor of MAT4.
  glm::dmat4 mat4(std::uint64_t i) const;
  /// Element `i` of an accessor of unsigned integers, such as indices.
  std::uint64_t whole(std::uint64_t i) const;

 private:
  template <int N>
  glm::vec<N, double> vector(std::uint64_t i) const;
  void read_base(const Element<tinygltf::Accessor>& element);
  void read_sparse(const Element<tinygltf::Accessor>& element);
  /// Where element `i` lies, with its position there; nothing where it is zeros.
  const Items* find(std::uint64_t i, std::uint64_t& position) const;

  std::string path_;
  std::uint64_t count_ = 0;
  int components_ = 0;
  bool normalized_ = false;
  bool is_plain_ = false;  ///< floats, all in base_
  Items base_;             ///< no bytes where the accessor has no bufferView
  Items sparse_indices_, sparse_values_;
  std::uint64_t sparse_count_ = 0;
};

// What meshes mostly consist of must be fast: millions of corners are read one by one.
template <int N>
glm::vec<N, double> Accessor::vector(std::uint64_t i) const {
  if (is_plain_) {
    glm::vec<N, float> values;
    std::memcpy(&values, base_.bytes.data() + i * base_.stride, sizeof values);
    return glm::vec<N, double>(values);
  }
  glm::vec<N, double> values;
  for (int component = 0; component < N; ++component) values[component] = real(i, component);
  return values;
}

inline std::uint64_t Accessor::whole(std::uint64_t i) const {
  if (sparse_count_ > 0 || base_.bytes.empty()) return static_cast<std::uint64_t>(real(i, 0));
  const std::uint8_t* const at = base_.bytes.data() + i * base_.stride;
  if (base_.type == ComponentType::u32) {
    std::uint32_t value;
    std::memcpy(&value, at, sizeof value);
    return value;
  }
  if (base_.type == ComponentType::u16) {
    std::uint16_t value;
    std::memcpy(&value, at, sizeof value);
    return value;
  }
  return *at;
}

}  // namespace ppm::scene::gltf
