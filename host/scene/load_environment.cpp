#include "load_environment.hpp"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <system_error>

#include "failure.hpp"
#include "input_file.hpp"

namespace ppm::scene {
namespace {

namespace fs = std::filesystem;

/// 4096 x 2048: 128 MiB on the device, which is what every device can bind at once.
constexpr std::uint64_t kMostTexels = std::uint64_t{1} << 23;
/// Deflate makes 1032 bytes of one at most; EXR's halves become floats.
constexpr std::uint64_t kLargestExpansion = 1032 * 2;
/// What an infinite texel becomes: the largest half float, beyond which EXR files overflow.
constexpr float kLargestHalf = 65504.0f;
/// Leaves room for strength, solid angle and sums in single precision.
constexpr float kLargestRadiance = 1e15f;
constexpr const char* kRemedy = "convert it to a lat-long .hdr or .exr";

std::string lower_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// One file that OpenImageIO has opened, of a size that may be trusted.
class EnvironmentFile {
 public:
  explicit EnvironmentFile(const fs::path& file) : file_(file.string()) {
    const std::string why = why_unreadable(file);
    if (!why.empty()) fail(why, "name a .hdr or .exr file that you may read");
    std::error_code error;
    bytes_ = fs::file_size(file, error);
    input_ = OIIO::ImageInput::create(lower_extension(file) == ".hdr" ? "hdr" : "openexr");
    if (!input_ || !input_->open(file_, spec_)) corrupt();
    check_size();
  }
  ~EnvironmentFile() { cause(); }  // OpenImageIO prints causes that nobody asked for
  EnvironmentFile(const EnvironmentFile&) = delete;
  EnvironmentFile& operator=(const EnvironmentFile&) = delete;

  std::uint64_t texels() const {
    return static_cast<std::uint64_t>(spec_.width) * static_cast<std::uint64_t>(spec_.height);
  }

  Environment read() {
    Environment environment;
    environment.name = file_;
    environment.width = static_cast<std::uint32_t>(spec_.width);
    environment.height = static_cast<std::uint32_t>(spec_.height);
    const std::size_t count = std::size_t{environment.width} * environment.height;
    const int channels = spec_.nchannels < 3 ? 1 : 3;
    std::vector<float> values(count * static_cast<std::size_t>(channels));
    if (!input_->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data())) corrupt();
    environment.texels.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      environment.texels[i] = channels == 1
                                  ? glm::vec3(values[i])
                                  : glm::vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    }
    return environment;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const char* remedy) {
    throw Failure(file_, "", what, remedy);
  }
  std::string cause() { return input_ ? input_->geterror() : OIIO::geterror(); }
  [[noreturn]] void corrupt() {
    const std::string why = first_line(cause());
    fail("cannot be read as an environment" + (why.empty() ? "" : ": " + why), kRemedy);
  }

  void check_size() {
    const auto width = static_cast<std::uint64_t>(std::max(spec_.width, 0));
    const auto height = static_cast<std::uint64_t>(std::max(spec_.height, 0));
    const std::string size = std::to_string(width) + " x " + std::to_string(height) + " texels";
    if (width == 0 || width != 2 * height) {
      fail("its " + size + " are not twice as wide as high: it is no lat-long map", kRemedy);
    }
    if (width * height > kMostTexels) {
      fail("its " + size + " are too many", "scale it down to 4096 x 2048");
    }
    if (spec_.nchannels < 1 || spec_.depth > 1 ||
        width * height * sizeof(float) > kLargestExpansion * bytes_) {
      fail("is corrupt: it cannot hold " + size, kRemedy);
    }
  }

  std::string file_;
  std::uint64_t bytes_ = 0;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
};

/// How many of the texels had to be changed.
std::size_t clamp_texels(std::vector<glm::vec3>& texels) {
  std::size_t changed = 0;
  for (glm::vec3& texel : texels) {
    const glm::vec3 before = texel;
    for (int channel = 0; channel < 3; ++channel) {
      float& value = texel[channel];
      if (std::isinf(value) && value > 0.0f) value = kLargestHalf;
      value = value > 0.0f ? std::min(value, kLargestRadiance) : 0.0f;
    }
    changed += texel != before ? 1 : 0;
  }
  return changed;
}

}  // namespace

bool is_environment_file(const fs::path& file) {
  const std::string extension = lower_extension(file);
  return extension == ".hdr" || extension == ".exr";
}

std::uint64_t environment_texels(const fs::path& file) {
  return EnvironmentFile(file).texels();
}

Environment load_environment(const fs::path& file, Log& log) {
  Environment environment = EnvironmentFile(file).read();
  if (const std::size_t changed = clamp_texels(environment.texels); changed > 0) {
    log.warn(file.string() + ": " + std::to_string(changed) +
             " texels were negative, infinite or no numbers and were clamped");
  }
  return environment;
}

}  // namespace ppm::scene
