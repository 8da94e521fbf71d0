// glTF textures, and how materials use them, to the scene's.
#pragma once

#include <map>
#include <tuple>

#include "gltf_document.hpp"
#include "scene.hpp"

namespace ppm::scene::gltf {

/// What a texture holds: colours of 8 or 16 bits are sRGB, data is linear.
enum class Content { colors, data };

/// Reads the textures that materials use into `textures`, at first without their texels. An image
/// is decoded once for each sampler and content that it is used with.
class TextureReader {
 public:
  /// `textures`, empty at first, must outlive this object.
  explicit TextureReader(std::vector<Texture>& textures) : textures_(textures) {}

  /// A textureInfo of glTF; nothing where there is none, or where it cannot be used, with a
  /// warning. Counts its texels in the document's size. Throws Failure for what is malformed and
  /// for what is no image.
  OptionalTextureUse read(const Element<tinygltf::TextureInfo>& info, Content content);
  OptionalTextureUse read(const Element<tinygltf::NormalTextureInfo>& info, Content content);
  /// The textureInfo `key` of an extension.
  OptionalTextureUse read(const Extension& owner, const std::string& key, Content content);

  /// Fills in the texels of all textures. Throws Failure for images that cannot be read.
  void decode();

 private:
  /// What all kinds of textureInfo have in common.
  struct Info {
    Place place;
    int index;
    std::optional<double> texcoord_set;
    std::optional<Extension> transform;  ///< KHR_texture_transform
  };
  /// Of an image, its sampler and its content.
  using Key = std::tuple<int, Wrap, Wrap, bool, Content>;

  OptionalTextureUse read(const Info& info, Content content);
  std::optional<std::uint32_t> find(const Info& info, Content content);

  std::vector<Texture>& textures_;
  std::map<Key, std::uint32_t> known_;
  /// What each of `textures` is to be decoded from.
  struct Waiting {
    Element<tinygltf::Image> image;
    Content content;
  };
  std::vector<Waiting> waiting_;
};

}  // namespace ppm::scene::gltf
