// A picture file as OpenImageIO reads it.
#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <stdexcept>
#include <vector>

namespace ppm::test {

struct PictureFile {
  OIIO::ImageSpec spec;
  std::vector<float> values;  ///< row-major from the top, channels interleaved, PNG bytes as [0,1]
};

/// Throws std::runtime_error for what is no whole picture.
inline PictureFile read_picture(const std::filesystem::path& file) {
  const auto input = OIIO::ImageInput::open(file.string());
  if (!input) throw std::runtime_error(OIIO::geterror());
  PictureFile picture{input->spec(), {}};
  picture.values.resize(picture.spec.image_pixels() *
                        static_cast<std::size_t>(picture.spec.nchannels));
  if (!input->read_image(0, 0, 0, picture.spec.nchannels, OIIO::TypeDesc::FLOAT,
                         picture.values.data())) {
    throw std::runtime_error(input->geterror());
  }
  return picture;
}

}  // namespace ppm::test
