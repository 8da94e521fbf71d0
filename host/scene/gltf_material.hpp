// glTF materials to the scene's.
#pragma once

#include "gltf_texture.hpp"
#include "scene.hpp"

namespace ppm::scene::gltf {

/// Reads materials, and the textures they use into `textures`.
class MaterialReader {
 public:
  /// `textures`, empty at first, must outlive this object.
  explicit MaterialReader(std::vector<Texture>& textures) : textures_(textures) {}

  /// An element of `materials`. Lengths are multiplied by `length_scale`. Factors outside their
  /// legal range are clamped, with a warning; what the renderer lacks is warned of. Throws Failure
  /// for what is malformed.
  Material read(const Element<tinygltf::Material>& element, double length_scale);

  /// Fills in the texels of all textures, see TextureReader.
  void decode_textures() { textures_.decode(); }

 private:
  using MaterialElement = Element<tinygltf::Material>;

  void read_metallic_roughness(const MaterialElement& element, Material& material);
  void read_normals(const MaterialElement& element, Material& material);
  void read_emission(const MaterialElement& element, Material& material);
  void read_specular(const MaterialElement& element, Material& material);
  void read_transmission(const MaterialElement& element, Material& material);
  void read_clearcoat(const MaterialElement& element, Material& material);

  TextureReader textures_;
};

}  // namespace ppm::scene::gltf
