// glTF materials and textures to the scene's.
#pragma once

#include <map>

#include "gltf_image.hpp"
#include "scene.hpp"

namespace ppm::scene::gltf {

/// Reads materials, and the textures they use into `textures`.
class MaterialReader {
 public:
  /// `textures` must outlive this object.
  explicit MaterialReader(std::vector<Texture>& textures) : textures_(textures) {}

  /// An element of `materials`. Lengths are multiplied by `length_scale`. Factors outside their
  /// legal range are clamped, with a warning; what the renderer lacks is warned of. Throws Failure
  /// for what is malformed and for images that cannot be read.
  Material read(const Element<tinygltf::Material>& element, double length_scale);

 private:
  void read_metallic_roughness(const Element<tinygltf::Material>& element, Material& material);
  std::optional<std::uint32_t> read_texture(const Element<tinygltf::TextureInfo>& info);
  Texture decode_texture(const Element<tinygltf::Texture>& element);

  std::vector<Texture>& textures_;
  std::map<int, std::uint32_t> textures_by_index_;  ///< glTF's index to ours
  std::uint64_t texel_count_ = 0;
};

}  // namespace ppm::scene::gltf
