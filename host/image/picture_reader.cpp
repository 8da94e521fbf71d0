#include "picture_reader.hpp"

#include <OpenImageIO/imageio.h>

#include <string>

#include "failure.hpp"

namespace ppm::image {
namespace {

constexpr const char* kRemedy = "name an EXR or HDR file of the same camera and size";

std::string cause_of(const std::string& error) {
  return error.empty() ? "no picture that can be read" : error;
}

}  // namespace

std::vector<float> read_rgb(const std::filesystem::path& file, std::uint32_t width,
                            std::uint32_t height) {
  const auto input = OIIO::ImageInput::open(file.string());
  if (!input) throw Failure(file.string(), "", cause_of(OIIO::geterror()), kRemedy);
  const OIIO::ImageSpec& spec = input->spec();
  // Before anything is allocated: a file may claim any size.
  if (static_cast<std::int64_t>(width) != spec.width ||
      static_cast<std::int64_t>(height) != spec.height || spec.depth != 1) {
    throw Failure(file.string(), "",
                  std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                      " pixels instead of " + std::to_string(width) + " x " +
                      std::to_string(height),
                  kRemedy);
  }
  if (spec.nchannels < 3) {
    throw Failure(file.string(), "", "fewer than three channels", kRemedy);
  }
  std::vector<float> rgb(std::size_t{3} * width * height);
  if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, rgb.data())) {
    throw Failure(file.string(), "", cause_of(input->geterror()), kRemedy);
  }
  return rgb;
}

}  // namespace ppm::image
