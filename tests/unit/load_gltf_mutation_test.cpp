// No file whatsoever does anything but load or be refused: seeded mutations of a sound one.
#include <gtest/gtest.h>

#include <random>

#include "made_document.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;

/// Flips bits, overwrites, cuts, repeats: one to eight times.
void mutate(Bytes& bytes, std::mt19937& random) {
  const auto below = [&](std::size_t limit) { return random() % limit; };
  for (std::size_t i = 0, count = 1 + below(8); i < count && bytes.size() > 1; ++i) {
    const std::size_t at = below(bytes.size());
    switch (below(6)) {
      case 0:
        bytes[at] ^= static_cast<std::uint8_t>(1u << below(8));
        break;
      case 1:
        bytes[at] = static_cast<std::uint8_t>(random());
        break;
      case 2:
        bytes[at] = static_cast<std::uint8_t>("0919e-[]{},\":"[below(13)]);
        break;
      case 3:
        bytes[at] = 0xff;
        break;
      case 4:
        bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      default:
        if (below(20) == 0) bytes.resize(at);
    }
  }
}

TEST(LoadGltfMutations, MutatedFilesLoadOrAreRefused) {
  const TemporaryFolder folder;
  const Bytes good = everything().glb();
  std::mt19937 random(2008);
  int loaded = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    Bytes bytes = good;
    mutate(bytes, random);
    write_file(folder / "a.glb", bytes);
    ASSERT_NO_THROW(++(refusal(folder / "a.glb").empty() ? loaded : refused)) << "mutation " << i;
  }
  EXPECT_GT(loaded, 100);  // mutations reach behind the first check, too
  EXPECT_GT(refused, 100);
}

/// Replaces a random value of the document by one that does not belong there.
void bend(json& value, std::mt19937& random) {
  json* target = &value;
  while (target->is_structured() && !target->empty() && random() % 5 != 0) {
    auto item = target->begin();
    std::advance(item, static_cast<std::ptrdiff_t>(random() % target->size()));
    target = &*item;
  }
  const std::vector<json> misfits{nullptr,
                                  -1,
                                  0,
                                  1,
                                  2,
                                  255,
                                  65536,
                                  4294967296,
                                  1e300,
                                  -0.5,
                                  "",
                                  "data:;base64,AAAA",
                                  true,
                                  json::array(),
                                  json::object(),
                                  {0, 0},
                                  {1e38, 0, 0},
                                  {{"count", 3}}};
  *target = misfits[random() % misfits.size()];
}

TEST(LoadGltfMutations, BentDocumentsLoadOrAreRefused) {
  const TemporaryFolder folder;
  const GltfDocument good = everything();
  std::mt19937 random(1409060);
  int loaded = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    GltfDocument document = good;
    for (std::size_t bends = 1 + random() % 3; bends > 0; --bends) bend(document.root, random);
    write_file(folder / "a.glb", document.glb());
    ASSERT_NO_THROW(++(refusal(folder / "a.glb").empty() ? loaded : refused)) << "bend " << i;
  }
  EXPECT_GT(loaded, 30);
  EXPECT_GT(refused, 100);
}

TEST(LoadGltfMutations, MutatedImagesLoadOrAreRefused) {
  const TemporaryFolder folder;
  std::vector<std::uint8_t> rgba(4 * 16 * 16);
  std::mt19937 random(1216199);
  for (std::uint8_t& code : rgba) code = static_cast<std::uint8_t>(random());
  const Bytes good = png_of(16, 16, rgba);
  for (int i = 0; i < 1000; ++i) {
    Bytes image = good;
    mutate(image, random);
    with_image(image).write_glb(folder / "a.glb");
    ASSERT_NO_THROW(refusal(folder / "a.glb")) << "mutation " << i;
  }
}

TEST(LoadGltfMutations, MutatedJpegsLoadOrAreRefused) {
  const TemporaryFolder folder;
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::mt19937 random(918);
  for (int i = 0; i < 1000; ++i) {
    std::string text = kGreyJpegBase64;
    for (std::size_t count = 1 + random() % 4; count > 0; --count) {
      text[8 + random() % (text.size() - 16)] = digits[random() % digits.size()];
    }
    GltfDocument document = everything();
    document.root["images"][0] = {{"uri", "data:image/jpeg;base64," + text}};
    write_file(folder / "a.glb", document.glb());
    ASSERT_NO_THROW(refusal(folder / "a.glb")) << "mutation " << i;
  }
}

}  // namespace
}  // namespace ppm::test
