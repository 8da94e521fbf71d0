#include "gltf_image.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <memory>

#include "gltf_jpeg.hpp"

namespace {

// Compressed data may unfold to any size, whatever dimensions the image states; what the decoder
// asks for in one piece is bounded by this. A thread's own, as two may decode at once.
thread_local std::size_t allocation_limit = 0;

void* limited_realloc(void* memory, std::size_t size) {
  return size > allocation_limit ? nullptr : std::realloc(memory, size);
}

}  // namespace

#define STBI_MALLOC(size) limited_realloc(nullptr, size)
#define STBI_REALLOC(memory, size) limited_realloc(memory, size)
#define STBI_FREE(memory) std::free(memory)
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#include <stb/stb_image.h>

namespace ppm::scene::gltf {
namespace {

constexpr std::uint64_t kLargestSide = 16384;
constexpr int kChannels = 4;
constexpr const char* kRemedy = "convert it to PNG or JPEG, or export it again";

/// IEC 61966-2-1.
double srgb_to_linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Half floats for every code of an unsigned integer type.
struct DecodingTable {
  std::vector<std::uint16_t> color, alpha;

  explicit DecodingTable(std::size_t codes) : color(codes), alpha(codes) {
    for (std::size_t i = 0; i < codes; ++i) {
      const double value = static_cast<double>(i) / static_cast<double>(codes - 1);
      color[i] = glm::packHalf1x16(static_cast<float>(srgb_to_linear(value)));
      alpha[i] = glm::packHalf1x16(static_cast<float>(value));
    }
  }
};

template <typename Code>
std::vector<glm::u16vec4> decode_texels(const Code* codes, std::size_t texel_count) {
  const DecodingTable table(std::size_t{std::numeric_limits<Code>::max()} + 1);
  std::vector<glm::u16vec4> texels(texel_count);
  for (std::size_t i = 0; i < texel_count; ++i) {
    const Code* texel = codes + i * kChannels;
    texels[i] = {table.color[texel[0]], table.color[texel[1]], table.color[texel[2]],
                 table.alpha[texel[3]]};
  }
  return texels;
}

struct FreeStb {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

void check_size(const Element& image, std::uint64_t width, std::uint64_t height,
                std::uint64_t texel_budget) {
  if (width > kLargestSide || height > kLargestSide || width * height > texel_budget) {
    image.fail(
        "its " + std::to_string(width) + " x " + std::to_string(height) + " texels are too many",
        "use smaller images");
  }
}

Image decode_as_jpeg(const Element& image, ByteView bytes, JpegSize size) {
  const std::optional<JpegTexels> texels = decode_jpeg(bytes);
  if (!texels) image.fail("is corrupt", kRemedy);
  if (texels->damaged) image.warn("damaged JPEG", "is damaged; what can be read of it is used");
  return {size.width, size.height,
          decode_texels(texels->rgba.data(), std::size_t{size.width} * size.height)};
}

Image decode_as_png(const Element& image, ByteView bytes, std::uint64_t texel_budget) {
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  allocation_limit = 65536;
  if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0) {
    image.fail("is no PNG or JPEG image, or broken or too large", kRemedy);
  }
  const auto columns = static_cast<std::uint32_t>(width), rows = static_cast<std::uint32_t>(height);
  check_size(image, columns, rows, texel_budget);
  // Four channels of 16 bits, twice for the decoder's copies; and the compressed data, whose buffer
  // grows by doubling.
  const std::size_t count = std::size_t{columns} * rows;
  allocation_limit = 16 * (count + columns + rows) + 4 * bytes.size() + 65536;
  const auto as_image = [&](auto* codes) {
    const std::unique_ptr<void, FreeStb> owner(codes);
    if (codes == nullptr) {
      image.fail(std::string("is corrupt: ") + stbi_failure_reason(), kRemedy);
    }
    return Image{columns, rows, decode_texels(codes, count)};
  };
  if (stbi_is_16_bit_from_memory(bytes.data(), size) != 0) {
    return as_image(
        stbi_load_16_from_memory(bytes.data(), size, &width, &height, &channels, kChannels));
  }
  return as_image(stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, kChannels));
}

Image decode(const Element& image, ByteView bytes, std::uint64_t texel_budget) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    image.fail("is larger than 2 GiB", "make it smaller");
  }
  if (const std::optional<JpegSize> size = jpeg_size(bytes)) {
    check_size(image, size->width, size->height, texel_budget);
    return decode_as_jpeg(image, bytes, *size);
  }
  return decode_as_png(image, bytes, texel_budget);
}

}  // namespace

Image decode_image(const Element& image, Buffers& buffers, std::uint64_t texel_budget) {
  if (const std::optional<Element> uri = image.find("uri")) {
    const Bytes bytes = buffers.load_uri(*uri, std::numeric_limits<std::uint64_t>::max());
    return decode(image, bytes, texel_budget);
  }
  if (!image.find("bufferView")) image.fail("has neither uri nor bufferView", "add the image");
  return decode(image, buffers.view(image.follow("bufferView", "bufferViews")), texel_budget);
}

}  // namespace ppm::scene::gltf
