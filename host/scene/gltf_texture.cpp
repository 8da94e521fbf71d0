#include "gltf_texture.hpp"

#include <array>
#include <cmath>

#include "gltf_image.hpp"

namespace ppm::scene::gltf {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 32;  // of all textures
constexpr double kLargestTransform = 1e6;  // beyond, texture coordinates have no digits left

Wrap wrap_of(const Place& place, int number) {
  switch (number) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return Wrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clamp_to_edge;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirrored_repeat;
    default:
      place.fail("is not a wrapping mode", "use 10497, 33071 or 33648");
  }
}

bool is_nearest(const Place& place, int number) {
  switch (number) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
      return true;
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
    case -1:  // absent
      return false;
    default:
      place.fail("is not a filter", "use 9728 or 9729");
  }
}

/// The texture but for its image.
Texture sampler_of(const Element<tinygltf::Texture>& element) {
  Texture texture;
  if (element->sampler == -1) return texture;
  const auto sampler =
      follow(element.member("sampler"), element->sampler, element.model().samplers, "samplers");
  texture.wrap_s = wrap_of(sampler.member("wrapS"), sampler->wrapS);
  texture.wrap_t = wrap_of(sampler.member("wrapT"), sampler->wrapT);
  texture.nearest = is_nearest(sampler.member("magFilter"), sampler->magFilter);
  return texture;
}

/// The index of the image that a texture shows: its WebP file where it has one, or else its own;
/// and where that is written.
std::optional<std::pair<Place, int>> source_of(const Element<tinygltf::Texture>& element) {
  if (const auto webp = Extension::find(element, element->extensions, "EXT_texture_webp")) {
    if (webp->has("source")) return {{webp->member("source"), webp->index("source")}};
  }
  if (element->source != -1) return {{element.member("source"), element->source}};
  return std::nullopt;
}

/// KHR_texture_transform: T R S, with R as its text and its example have it, counter-clockwise
/// where v points down; the signs of the sines in its snippet of GLSL are the other way round, and
/// no program follows those.
void apply(const Extension& transform, TextureUse& use) {
  std::array<float, 2> offset{0.0f, 0.0f}, scale{1.0f, 1.0f};
  transform.factors("offset", offset, -kLargestTransform, kLargestTransform);
  transform.factors("scale", scale, -kLargestTransform, kLargestTransform);
  const double rotation = transform.factor("rotation", 0.0, -kLargestTransform, kLargestTransform);
  const double c = std::cos(rotation), s = std::sin(rotation);
  use.row_s = glm::vec3(glm::dvec3(c * scale[0], s * scale[1], offset[0]));
  use.row_t = glm::vec3(glm::dvec3(-s * scale[0], c * scale[1], offset[1]));
}

}  // namespace

OptionalTextureUse TextureReader::read(const Element<tinygltf::TextureInfo>& info,
                                       Content content) {
  if (info->index == -1) return std::nullopt;
  return read({info, info->index, info->texCoord,
               Extension::find(info, info->extensions, "KHR_texture_transform")},
              content);
}

OptionalTextureUse TextureReader::read(const Element<tinygltf::NormalTextureInfo>& info,
                                       Content content) {
  if (info->index == -1) return std::nullopt;
  return read({info, info->index, info->texCoord,
               Extension::find(info, info->extensions, "KHR_texture_transform")},
              content);
}

OptionalTextureUse TextureReader::read(const Extension& owner, const std::string& key,
                                       Content content) {
  const auto info = owner.object(key);
  if (!info) return std::nullopt;
  std::optional<Extension> transform;
  if (const auto extensions = info->object("extensions")) {
    transform = extensions->object("KHR_texture_transform");
  }
  return read({*info, info->index("index"), info->number("texCoord"), transform}, content);
}

OptionalTextureUse TextureReader::read(const Info& info, Content content) {
  TextureUse use;
  double set = info.texcoord_set.value_or(0.0);
  if (info.transform) {
    apply(*info.transform, use);
    set = info.transform->number("texCoord").value_or(set);
  }
  if (set != 0.0 && set != 1.0) {
    info.place.warn("texCoord",
                    "textures that use another set than TEXCOORD_0 and TEXCOORD_1 are ignored");
    return std::nullopt;
  }
  use.texcoord_set = set == 1.0 ? 1 : 0;
  const auto texture = find(info, content);
  if (!texture) return std::nullopt;
  use.texture = *texture;
  return use;
}

std::optional<std::uint32_t> TextureReader::find(const Info& info, Content content) {
  const tinygltf::Model& model = info.place.model();
  const auto element = follow(info.place.member("index"), info.index, model.textures, "textures");
  const auto source = source_of(element);
  if (!source) {
    element.warn("texture source", "a texture without a source that can be read is ignored");
    return std::nullopt;
  }
  Texture texture = sampler_of(element);
  const Key key{source->second, texture.wrap_s, texture.wrap_t, texture.nearest, content};
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;

  const auto image = follow(source->first, source->second, model.images, "images");
  std::uint64_t& bytes = element.document().size.texture_bytes;
  const ImageSize size = measure_image(image, kMostBytes - bytes);
  bytes += size.bytes;
  texture.name = element->name.empty() ? image.name() : element.name();
  texture.width = size.width;
  texture.height = size.height;
  textures_.push_back(std::move(texture));
  waiting_.push_back({image, content});
  const auto position = static_cast<std::uint32_t>(textures_.size() - 1);
  known_.emplace(key, position);
  return position;
}

void TextureReader::decode() {
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const bool is_color = waiting_[i].content == Content::colors;
    Image image = decode_image(waiting_[i].image, is_color);
    textures_[i].srgb = is_color && !image.rgba8.empty();
    textures_[i].rgba8 = std::move(image.rgba8);
    textures_[i].halves = std::move(image.halves);
  }
  waiting_.clear();
}

}  // namespace ppm::scene::gltf
