#include "gltf_image.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <memory>

#include "gltf_image_format.hpp"

namespace ppm::scene::gltf {
namespace {

constexpr std::uint64_t kLargestSide = 16384;
// Deflate makes 1032 bytes of one at most, and indices of one bit become up to 32.
constexpr std::uint64_t kLargestExpansion = 1032 * 32;
constexpr const char* kRemedy = "convert it to PNG or JPEG, or export it again";
constexpr float kLargestHalf = 65504.0f;

/// IEC 61966-2-1.
double srgb_to_linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

std::uint16_t half_of(double value) {
  // NaN becomes 0.
  const double legal = value > 0.0 ? std::min(value, double{kLargestHalf}) : 0.0;
  return glm::packHalf1x16(static_cast<float>(legal));
}

// What a channel becomes: codes of 8 bits stay, those of 16 bits become halves by a table.
struct Bytes {
  using Code = std::uint8_t;
  using Texel = glm::u8vec4;
  static constexpr OIIO::TypeDesc::BASETYPE kType = OIIO::TypeDesc::UINT8;
  static constexpr Code kOpaque = 255;
  Code color(Code code) const { return code; }
  Code data(Code code) const { return code; }
};

struct Words {
  using Code = std::uint16_t;
  using Texel = glm::u16vec4;
  static constexpr OIIO::TypeDesc::BASETYPE kType = OIIO::TypeDesc::UINT16;
  static constexpr Code kOpaque = 65535;
  std::vector<std::uint16_t> colors, values;

  explicit Words(bool srgb) {
    for (std::size_t i = 0; i <= kOpaque; ++i) {
      const double value = static_cast<double>(i) / kOpaque;
      values.push_back(half_of(value));
      if (srgb) colors.push_back(half_of(srgb_to_linear(value)));
    }
    if (!srgb) colors = values;
  }
  std::uint16_t color(Code code) const { return colors[code]; }
  std::uint16_t data(Code code) const { return values[code]; }
};

struct Floats {
  using Code = float;
  using Texel = glm::u16vec4;
  static constexpr OIIO::TypeDesc::BASETYPE kType = OIIO::TypeDesc::FLOAT;
  static constexpr Code kOpaque = 1.0f;
  std::uint16_t color(Code code) const { return half_of(code); }
  std::uint16_t data(Code code) const { return half_of(std::min(code, 1.0f)); }
};

/// Keeps stderr to ourselves: libpng prints errors and mere warnings there, and OpenImageIO 2.4
/// does not stop it. Nothing happens where there is no stderr.
class Silence {
 public:
  Silence() : stderr_(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3)) {
    std::fflush(stderr);
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (stderr_ >= 0 && nowhere >= 0) dup2(nowhere, STDERR_FILENO);
    if (nowhere >= 0) close(nowhere);
  }
  ~Silence() {
    std::fflush(stderr);
    if (stderr_ < 0) return;
    dup2(stderr_, STDERR_FILENO);
    close(stderr_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int stderr_;
};

/// One encoded image that OpenImageIO has opened.
class Decoder {
 public:
  Decoder(const Place& place, ByteView bytes) : place_(place), memory_(bytes.data(), bytes.size()) {
    const char* format = image_format_of(bytes);
    if (format == nullptr) place.fail("is no PNG, JPEG or other known image", kRemedy);
    const std::string danger = danger_in_image(bytes, format);
    if (!danger.empty()) place.fail(danger, kRemedy);
    input_ = OIIO::ImageInput::create(format);
    OIIO::ImageSpec wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1);
    if (!input_ || !input_->set_ioproxy(&memory_) || !input_->open("image", spec_, wishes)) {
      corrupt();
    }
  }
  ~Decoder() { cause(); }  // OpenImageIO prints causes that nobody asked for
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  void check_size(std::uint64_t byte_budget) const {
    const auto width = static_cast<std::uint64_t>(std::max(spec_.width, 0));
    const auto height = static_cast<std::uint64_t>(std::max(spec_.height, 0));
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    const std::uint64_t texel_bytes = is_of_bytes() ? sizeof(glm::u8vec4) : sizeof(glm::u16vec4);
    if (width > kLargestSide || height > kLargestSide ||
        width * height * texel_bytes > byte_budget) {
      place_.fail("its " + size + " texels are too many", "use smaller images");
    }
    const std::uint64_t most = kLargestExpansion * memory_.size();
    if (width * height == 0 || spec_.nchannels < 1 || spec_.nchannels > 4 || spec_.depth != 1 ||
        spec_.image_bytes(true) > most || !are_tiles_sound(most)) {
      place_.fail("is corrupt: it cannot hold " + size + " texels", kRemedy);
    }
  }

  /// Needs check_size.
  ImageSize size() const {
    const auto width = static_cast<std::uint32_t>(spec_.width);
    const auto height = static_cast<std::uint32_t>(spec_.height);
    return {width, height,
            std::uint64_t{width} * height *
                (is_of_bytes() ? sizeof(glm::u8vec4) : sizeof(glm::u16vec4))};
  }

  Image read(bool srgb) {
    Image image{
        static_cast<std::uint32_t>(spec_.width), static_cast<std::uint32_t>(spec_.height), {}, {}};
    if (is_of_bytes()) {
      read_as(Bytes(), image.rgba8);
    } else if (spec_.format == OIIO::TypeDesc::UINT16) {
      read_as(Words(srgb), image.halves);
    } else {
      read_as(Floats(), image.halves);
    }
    return image;
  }

 private:
  std::string cause() { return input_ ? input_->geterror() : OIIO::geterror(); }
  [[noreturn]] void corrupt() {
    const std::string text = cause();
    place_.fail("is corrupt: " + printable(text.substr(0, text.find('\n'))), kRemedy);
  }

  bool is_of_bytes() const { return spec_.format.basesize() == 1; }

  bool are_tiles_sound(std::uint64_t most_bytes) const {
    if (spec_.tile_width == 0) return true;
    const auto side = static_cast<int>(kLargestSide);
    return spec_.tile_width > 0 && spec_.tile_height > 0 && spec_.tile_width <= side &&
           spec_.tile_height <= side && spec_.tile_depth <= 1 &&
           spec_.tile_bytes(true) <= most_bytes;
  }

  /// As many rows as the file keeps together, from `y` on.
  bool read_band(int y, int end, OIIO::TypeDesc type, void* band) {
    // One by one: read_scanlines allocates 64 MiB at each call, which sanitisers mark byte by byte.
    if (spec_.tile_width == 0) return input_->read_scanline(y, 0, type, band);
    return input_->read_tiles(0, 0, spec_.x, spec_.x + spec_.width, y, end, spec_.z, spec_.z + 1, 0,
                              spec_.nchannels, type, band);
  }

  template <typename Channels>
  void read_as(const Channels& convert, std::vector<typename Channels::Texel>& texels) {
    using Code = typename Channels::Code;
    const auto width = static_cast<std::size_t>(spec_.width);
    const auto channels = static_cast<std::size_t>(spec_.nchannels);
    const std::size_t colors = channels < 3 ? 1 : 3;
    const int rows = spec_.tile_width == 0 ? 1 : spec_.tile_height;
    texels.reserve(width * static_cast<std::size_t>(spec_.height));
    std::vector<Code> band(width * channels *
                           static_cast<std::size_t>(std::min(rows, spec_.height)));
    for (int y = 0; y < spec_.height; y += rows) {
      const int end = std::min(y + rows, spec_.height);
      if (!read_band(spec_.y + y, spec_.y + end, Channels::kType, band.data())) corrupt();
      const Code* const last = band.data() + width * channels * static_cast<std::size_t>(end - y);
      for (const Code* code = band.data(); code != last; code += channels) {
        const auto color = [&](std::size_t i) { return convert.color(code[colors == 1 ? 0 : i]); };
        const Code alpha = channels > colors ? code[colors] : Channels::kOpaque;
        texels.emplace_back(color(0), color(1), color(2), convert.data(alpha));
      }
    }
  }

  const Place& place_;
  OIIO::Filesystem::IOMemReader memory_;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
};

ByteView encoded_bytes(const Element<tinygltf::Image>& image) {
  if (image->bufferView != -1) {
    return bytes_of(follow(image.member("bufferView"), image->bufferView, image.model().bufferViews,
                           "bufferViews"));
  }
  if (image->image.empty()) {
    image.member("uri").fail("\"" + printable(image->uri) + "\" cannot be read",
                             "put the file beside the glTF file or below");
  }
  return image->image;
}

}  // namespace

ImageSize measure_image(const Element<tinygltf::Image>& image, std::uint64_t byte_budget) {
  const ByteView bytes = encoded_bytes(image);
  const Silence silence;
  const Decoder decoder(image, bytes);
  decoder.check_size(byte_budget);
  return decoder.size();
}

Image decode_image(const Element<tinygltf::Image>& image, bool srgb) {
  const ByteView bytes = encoded_bytes(image);
  const Silence silence;
  Decoder decoder(image, bytes);
  decoder.check_size(std::numeric_limits<std::uint64_t>::max());
  return decoder.read(srgb);
}

}  // namespace ppm::scene::gltf
