// Pictures that come back as they were written, and files that are no such pictures.
#include "picture_reader.hpp"

#include <gtest/gtest.h>

#include <string>

#include "failure.hpp"
#include "image.hpp"
#include "read_picture.hpp"
#include "temporary_folder.hpp"

namespace ppm::image {
namespace {

const std::vector<float> kPixels = {0.0f,  0.25f,  0.5f, 1.0f, -0.75f, 0.1f,  1e-3f, 2.0f,  1e30f,
                                    0.02f, 1e-30f, 0.3f, 0.6f, 0.9f,   0.11f, 12.5f, 0.25f, 0.33f};

TEST(PictureReader, FloatsComeBackToTheBit) {
  const test::TemporaryFolder folder;
  write(folder / "p.exr", {3, 2, kPixels}, {}, {});
  EXPECT_EQ(read_rgb(folder / "p.exr", 3, 2), kPixels);
}

TEST(PictureReader, RefusesOtherSizesAndOtherFilesInALine) {
  const test::TemporaryFolder folder;
  write(folder / "p.exr", {3, 2, kPixels}, {}, {});
  const std::string whole = test::file_text(folder / "p.exr");
  test::write_text(folder / "half.exr", whole.substr(0, whole.size() - 20));
  test::write_text(folder / "text.exr", "no picture");
  const auto line_of = [&](const char* name, std::uint32_t width, std::uint32_t height) {
    try {
      read_rgb(folder / name, width, height);
    } catch (const Failure& failure) {
      return std::string(failure.what());
    }
    return std::string();
  };
  EXPECT_NE(line_of("p.exr", 2, 3).find("3 x 2 pixels instead of 2 x 3"), std::string::npos);
  for (const char* name : {"half.exr", "text.exr", "none.exr"}) {
    const std::string line = line_of(name, 3, 2);
    EXPECT_NE(line.find(name), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

TEST(PictureReader, PngFilesInMemoryHoldTheBytes) {
  const std::vector<std::uint8_t> bytes = {0, 1, 2, 253, 254, 255};
  const test::TemporaryFolder folder;
  test::write_text(folder / "p.png", encode_png(2, 1, bytes));
  const test::PictureFile read = test::read_picture(folder / "p.png");
  ASSERT_EQ(read.values.size(), bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    EXPECT_FLOAT_EQ(255.0f * read.values[i], bytes[i]);
  }
}

}  // namespace
}  // namespace ppm::image
