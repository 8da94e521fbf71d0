#include "gltf_image.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <memory>
#include <string_view>

namespace ppm::scene::gltf {
namespace {

constexpr std::uint64_t kLargestSide = 16384;
// Deflate makes 1032 bytes of one at most, and indices of one bit become up to 32.
constexpr std::uint64_t kLargestExpansion = 1032 * 32;
constexpr std::ptrdiff_t kMostScans =
    200;  // a progressive JPEG of a few KB can ask for hours of them
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

/// OpenImageIO's name of the format that the first bytes tell, or nothing.
const char* format_of(ByteView bytes) {
  constexpr std::array<std::uint8_t, 8> kPng{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  constexpr std::array<std::uint8_t, 3> kJpeg{0xff, 0xd8, 0xff};
  const auto begins_with = [&](ByteView magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
  };
  return begins_with(kPng) ? "png" : begins_with(kJpeg) ? "jpeg" : nullptr;
}

/// How often the marker that begins a scan stands in a JPEG; in coded data it cannot.
std::ptrdiff_t scan_count(ByteView bytes) {
  std::ptrdiff_t count = 0;
  for (std::size_t i = 1; i < bytes.size(); ++i) count += bytes[i - 1] == 0xff && bytes[i] == 0xda;
  return count;
}

/// Whether the chunks of a PNG file are all there. Where libpng meets the end of a file early,
/// OpenImageIO 2.4 jumps away from a string that it then leaks.
bool is_whole_png(ByteView bytes) {
  constexpr std::size_t kChunkBytes = 12;  // length, type and checksum around the data
  bool has_data = false;
  for (std::size_t at = 8; at + kChunkBytes <= bytes.size();) {
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | bytes[at + i];
    if (length > bytes.size() - at - kChunkBytes) return false;
    const std::string_view type(reinterpret_cast<const char*>(&bytes[at + 4]), 4);
    if (type == "IEND") return has_data;
    has_data = has_data || type == "IDAT";
    at += kChunkBytes + length;
  }
  return false;
}

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
    const char* format = format_of(bytes);
    if (format == nullptr) place.fail("is no PNG or JPEG image", kRemedy);
    if (format[0] == 'p' && !is_whole_png(bytes)) {
      place.fail("is corrupt: its PNG file is cut short", kRemedy);
    }
    if (format[0] == 'j' && scan_count(bytes) > kMostScans) {
      place.fail("has more than " + std::to_string(kMostScans) + " scans", kRemedy);
    }
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

  void check_size(std::uint64_t texel_budget) const {
    const auto width = static_cast<std::uint64_t>(std::max(spec_.width, 0));
    const auto height = static_cast<std::uint64_t>(std::max(spec_.height, 0));
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    if (width > kLargestSide || height > kLargestSide || width * height > texel_budget) {
      place_.fail("its " + size + " texels are too many", "use smaller images");
    }
    if (width * height == 0 || spec_.nchannels < 1 || spec_.nchannels > 4 || spec_.depth != 1 ||
        spec_.image_bytes(true) > kLargestExpansion * memory_.size()) {
      place_.fail("is corrupt: it cannot hold " + size + " texels", kRemedy);
    }
  }

  Image read() {
    return spec_.format == OIIO::TypeDesc::UINT16 ? read_as<std::uint16_t>(OIIO::TypeDesc::UINT16)
                                                  : read_as<std::uint8_t>(OIIO::TypeDesc::UINT8);
  }

 private:
  std::string cause() { return input_ ? input_->geterror() : OIIO::geterror(); }
  [[noreturn]] void corrupt() {
    const std::string text = cause();
    place_.fail("is corrupt: " + printable(text.substr(0, text.find('\n'))), kRemedy);
  }

  template <typename Code>
  Image read_as(OIIO::TypeDesc type) {
    const DecodingTable table(std::size_t{std::numeric_limits<Code>::max()} + 1);
    const auto width = static_cast<std::size_t>(spec_.width);
    const auto height = static_cast<std::size_t>(spec_.height);
    const auto channels = static_cast<std::size_t>(spec_.nchannels);
    const std::size_t colors = channels < 3 ? 1 : 3;
    Image image{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
    image.texels.reserve(width * height);
    std::vector<Code> row(width * channels);
    for (int y = 0; y < spec_.height; ++y) {
      if (!input_->read_scanline(y, 0, type, row.data())) corrupt();
      for (const Code* code = row.data(); code != row.data() + row.size(); code += channels) {
        const auto color = [&](std::size_t i) { return table.color[code[colors == 1 ? 0 : i]]; };
        const Code alpha = channels > colors ? code[colors] : std::numeric_limits<Code>::max();
        image.texels.emplace_back(color(0), color(1), color(2), table.alpha[alpha]);
      }
    }
    return image;
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

Image decode_image(const Element<tinygltf::Image>& image, std::uint64_t texel_budget) {
  const ByteView bytes = encoded_bytes(image);
  const Silence silence;
  Decoder decoder(image, bytes);
  decoder.check_size(texel_budget);
  return decoder.read();
}

}  // namespace ppm::scene::gltf
