#include "image.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>

#include "failure.hpp"
#include "output_file.hpp"
#include "pfm.hpp"

namespace ppm::image {
namespace {

enum class Format { exr, hdr, pfm, png };

/// Nothing for an extension that is none of ours. Letter case does not matter.
std::optional<Format> format_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".exr") return Format::exr;
  if (extension == ".hdr") return Format::hdr;
  if (extension == ".pfm") return Format::pfm;
  if (extension == ".png") return Format::png;
  return std::nullopt;
}

Format format_or_failure(const std::filesystem::path& file) {
  const std::optional<Format> format = format_of(file);
  if (!format) {
    throw Failure(file.string(), "", "unknown kind of picture", "use .exr, .png, .hdr or .pfm");
  }
  return *format;
}

/// Never an infinity: the largest finite half instead. NaN stays NaN.
float half_value(float radiance) {
  constexpr float kLargest = 65504.0f;
  return std::isnan(radiance) ? radiance : std::clamp(radiance, -kLargest, kLargest);
}

/// RGBE holds neither signs nor infinities; its largest value is a little below 2^127.
float rgbe_value(float radiance) {
  constexpr float kLargest = 1.6e38f;
  return radiance > 0.0f ? std::min(radiance, kLargest) : 0.0f;
}

/// The picture's own channels and those of its layers, pixel by pixel.
std::vector<float> interleaved(const View& picture, std::span<const Layer> layers, bool half) {
  const std::size_t pixels = std::size_t{picture.width} * picture.height;
  std::size_t channels = 3;
  for (const Layer& layer : layers) channels += layer.channels.size();
  std::vector<float> values(channels * pixels);
  std::size_t first = 0;
  const auto add = [&](std::span<const float> from, std::size_t count, bool rounded) {
    PPM_ASSERT(from.size() == count * pixels, std::to_string(from.size()));
    for (std::size_t i = 0; i < from.size(); ++i) {
      values[i / count * channels + first + i % count] = rounded ? half_value(from[i]) : from[i];
    }
    first += count;
  };
  add(picture.rgb, 3, half);
  for (const Layer& layer : layers) {
    add(layer.values, layer.channels.size(), half && !layer.precise);
  }
  return values;
}

void add_layers(OIIO::ImageSpec& spec, std::span<const Layer> layers, bool half) {
  if (layers.empty()) return;
  spec.channelformats.assign(3, spec.format);
  for (const Layer& layer : layers) {
    for (const std::string& channel : layer.channels) {
      spec.channelnames.push_back(channel);
      spec.channelformats.push_back(half && !layer.precise ? OIIO::TypeDesc::HALF
                                                           : OIIO::TypeDesc::FLOAT);
    }
  }
  spec.nchannels = static_cast<int>(spec.channelnames.size());
}

OIIO::ImageSpec spec_for(Format format, const View& picture, const Encoding& encoding,
                         const std::vector<Attribute>& attributes) {
  const bool half = format == Format::exr && encoding.half;
  const auto type = format == Format::png ? OIIO::TypeDesc::UINT8
                    : half                ? OIIO::TypeDesc::HALF
                                          : OIIO::TypeDesc::FLOAT;
  OIIO::ImageSpec spec(static_cast<int>(picture.width), static_cast<int>(picture.height), 3, type);
  spec.attribute("oiio:ColorSpace", format == Format::png ? "sRGB" : "Linear");
  if (format != Format::exr) return spec;
  spec.attribute("compression", "zip");
  spec.attribute("DateTime",
                 "");  // OpenImageIO would write the time of day, which differs each run
  for (const auto& [name, value] : attributes) {
    if (const int* integer = std::get_if<int>(&value)) {
      spec.attribute(name, *integer);
    } else if (const double* number = std::get_if<double>(&value)) {
      spec.attribute(name, OIIO::TypeDesc::DOUBLE, number);
    } else {
      spec.attribute(name, std::get<std::string>(value));
    }
  }
  return spec;
}

/// The whole file in memory, so that what reaches the disk is written and checked by one piece of
/// code.
std::vector<unsigned char> encode(Format format, const OIIO::ImageSpec& spec, const void* pixels,
                                  const std::filesystem::path& file) {
  // EXR and HDR are given floats, whatever they hold.
  const auto given = format == Format::png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
  const char* name = format == Format::exr ? "exr" : format == Format::hdr ? "hdr" : "png";
  OIIO::Filesystem::IOVecOutput memory;
  std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
  const bool written = output && output->set_ioproxy(&memory) &&
                       output->open(std::string("picture.") + name, spec) &&
                       output->write_image(given, pixels) && output->close();
  if (!written) {
    const std::string cause = output ? output->geterror() : OIIO::geterror();
    throw Failure(file.string(), "cannot encode the picture", cause, "try another format");
  }
  return memory.buffer();
}

std::uint8_t srgb_code(double value) {
  if (!(value > 0.0)) return 0;  // NaN too
  if (value >= 1.0) return 255;
  // IEC 61966-2-1.
  const double encoded =
      value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

}  // namespace

bool has_known_extension(const std::filesystem::path& file) {
  return format_of(file).has_value();
}

bool takes_layers(const std::filesystem::path& file) {
  const std::optional<Format> format = format_of(file);
  return format == Format::exr || format == Format::pfm;
}

std::filesystem::path layer_file(const std::filesystem::path& picture, const std::string& layer) {
  if (format_of(picture) != Format::pfm) return picture;
  return picture.parent_path() /
         (picture.stem().string() + "." + layer + picture.extension().string());
}

void check_writable(const std::filesystem::path& file) {
  format_or_failure(file);
  check_creatable(file);
}

std::uint8_t srgb_byte(float radiance, double exposure) {
  return srgb_code(static_cast<double>(radiance) * std::exp2(exposure));
}

std::vector<std::uint8_t> srgb_bytes(std::span<const float> rgb, const Encoding& encoding) {
  const double scale = std::exp2(encoding.exposure);
  std::vector<std::uint8_t> bytes(rgb.size());
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
    const Rgb shown = tone_mapped(encoding.tone, {static_cast<double>(rgb[i]) * scale,
                                                  static_cast<double>(rgb[i + 1]) * scale,
                                                  static_cast<double>(rgb[i + 2]) * scale});
    for (std::size_t channel = 0; channel < 3; ++channel) {
      bytes[i + channel] = srgb_code(shown[channel]);
    }
  }
  return bytes;
}

std::string encode_png(std::uint32_t width, std::uint32_t height,
                       std::span<const std::uint8_t> rgb) {
  PPM_ASSERT(rgb.size() == std::size_t{3} * width * height && !rgb.empty(),
             std::to_string(rgb.size()));
  const OIIO::ImageSpec spec = spec_for(Format::png, {width, height, {}}, {}, {});
  const auto bytes = encode(Format::png, spec, rgb.data(), "PNG");
  return {bytes.begin(), bytes.end()};
}

void write(const std::filesystem::path& file, const View& picture, const Encoding& encoding,
           const std::vector<Attribute>& attributes, std::span<const Layer> layers) {
  const Format format = format_or_failure(file);
  const std::size_t count = std::size_t{3} * picture.width * picture.height;
  PPM_ASSERT(picture.rgb.size() == count && count > 0, std::to_string(picture.rgb.size()));

  if (format == Format::pfm) {
    write_whole(file, pfm_file(picture.width, picture.height, 3, picture.rgb));
    for (const Layer& layer : layers) {
      write_whole(layer_file(file, layer.name),
                  pfm_file(picture.width, picture.height, layer.channels.size(), layer.values));
    }
    return;
  }
  OIIO::ImageSpec spec = spec_for(format, picture, encoding, attributes);
  std::vector<unsigned char> bytes;
  if (format == Format::png) {
    bytes = encode(format, spec, srgb_bytes(picture.rgb, encoding).data(), file);
  } else if (format == Format::hdr) {
    std::vector<float> pixels(count);
    std::transform(picture.rgb.begin(), picture.rgb.end(), pixels.begin(), rgbe_value);
    bytes = encode(format, spec, pixels.data(), file);
  } else if (encoding.half || !layers.empty()) {
    add_layers(spec, layers, encoding.half);
    bytes = encode(format, spec, interleaved(picture, layers, encoding.half).data(), file);
  } else {
    bytes = encode(format, spec, picture.rgb.data(), file);
  }
  write_whole(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace ppm::image
