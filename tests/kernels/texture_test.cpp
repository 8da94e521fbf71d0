// Texture lookups on the device against glTF's rules in double.
#include <gtest/gtest.h>

#include <cmath>

#include "device_fixture.hpp"
#include "ppm_pass_test_shaders.hpp"
#include "randoms.hpp"
#include "scene_buffers.hpp"
#include "scene_pieces.hpp"

namespace ppm::tests {
namespace {

using scene::Texture;
using scene::Wrap;

struct RangePush {
  std::uint32_t first = 0, count = 0;
};

// Texel index of an unbounded one, by the definitions of OpenGL ES 3.2, section 8.14.2.
std::int64_t wrapped(std::int64_t index, std::int64_t size, Wrap wrap) {
  const auto modulo = [](std::int64_t a, std::int64_t b) { return ((a % b) + b) % b; };
  if (wrap == Wrap::clamp_to_edge) return std::clamp<std::int64_t>(index, 0, size - 1);
  if (wrap == Wrap::repeat) return modulo(index, size);
  const std::int64_t mirrored = modulo(index, 2 * size) - size;
  return (size - 1) - (mirrored >= 0 ? mirrored : -(1 + mirrored));
}

/// IEC 61966-2-1.
double srgb_to_linear(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

glm::dvec4 texel(const Texture& texture, double x, double y) {
  const auto column = wrapped(static_cast<std::int64_t>(x), texture.width, texture.wrap_s);
  const auto row = wrapped(static_cast<std::int64_t>(y), texture.height, texture.wrap_t);
  const auto index = static_cast<std::size_t>(row * texture.width + column);
  if (!texture.halves.empty()) {
    const auto& half = texture.halves[index];
    return glm::dvec4(glm::unpackHalf1x16(half.x), glm::unpackHalf1x16(half.y),
                      glm::unpackHalf1x16(half.z), glm::unpackHalf1x16(half.w));
  }
  const glm::dvec4 code = glm::dvec4(texture.rgba8[index]) / 255.0;
  if (!texture.srgb) return code;
  return {srgb_to_linear(code.x), srgb_to_linear(code.y), srgb_to_linear(code.z), code.w};
}

glm::dvec4 reference(const Texture& texture, double s, double t) {
  const double x = s * texture.width;
  const double y = t * texture.height;
  if (texture.nearest) return texel(texture, std::floor(x), std::floor(y));
  const double left = std::floor(x - 0.5);
  const double top = std::floor(y - 0.5);
  const double fx = x - 0.5 - left;
  const double fy = y - 0.5 - top;
  return (texel(texture, left, top) * (1.0 - fx) + texel(texture, left + 1, top) * fx) *
             (1.0 - fy) +
         (texel(texture, left, top + 1) * (1.0 - fx) + texel(texture, left + 1, top + 1) * fx) * fy;
}

enum class Texels { halves, srgb, data };

Texture random_texture(std::uint32_t width, std::uint32_t height, Wrap wrap_s, Wrap wrap_t,
                       bool nearest, Texels texels, Randoms& random) {
  Texture texture;
  texture.width = width;
  texture.height = height;
  texture.wrap_s = wrap_s;
  texture.wrap_t = wrap_t;
  texture.nearest = nearest;
  texture.srgb = texels == Texels::srgb;
  for (std::uint32_t i = 0; i < width * height; ++i) {
    const auto half = [&] { return glm::packHalf1x16(random.in(0.0f, 1.0f)); };
    const auto code = [&] { return static_cast<std::uint8_t>(random.in(0.0f, 255.99f)); };
    if (texels == Texels::halves) {
      texture.halves.push_back({half(), half(), half(), half()});
    } else {
      texture.rgba8.push_back({code(), code(), code(), code()});
    }
  }
  return texture;
}

struct Lookup {
  std::uint32_t texture;
  float s, t;
};

class TextureLookup : public DeviceTest {
 protected:
  std::vector<glm::vec4> look_up(const scene::Scene& scene, std::span<const Lookup> lookups) {
    const render::SceneBuffers buffers(scene, small_settings(), device(), 1);
    const gpu::Kernel kernel(device(), shaders::texture_probe);
    const gpu::Buffer in = gpu::make_buffer(device(), "lookups", lookups, gpu::Usage::storage);
    const gpu::Buffer out(device(), "colours", lookups.size() * 16, gpu::Usage::storage);
    gpu::BindingTable table;
    buffers.bind(table);
    table.set(PPM_BIND_TEST_0, in);
    table.set(PPM_BIND_TEST_1, out);
    device().run([&](gpu::Recorder& recorder) {
      recorder.dispatch(kernel, table, RangePush{}, lookups.size());
    });
    return out.download<glm::vec4>(lookups.size());
  }
};

scene::Scene textured_scene(Randoms& random) {
  scene::Scene scene = scene_of({make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
  const std::pair<std::uint32_t, std::uint32_t> sizes[] = {
      {1, 1}, {2, 2}, {5, 3}, {1, 7}, {64, 33}};
  for (const auto& [width, height] : sizes) {
    for (const Wrap s : {Wrap::repeat, Wrap::clamp_to_edge, Wrap::mirrored_repeat}) {
      for (const Wrap t : {Wrap::repeat, Wrap::clamp_to_edge, Wrap::mirrored_repeat}) {
        for (const bool nearest : {false, true}) {
          for (const Texels texels : {Texels::halves, Texels::srgb, Texels::data}) {
            scene.textures.push_back(random_texture(width, height, s, t, nearest, texels, random));
          }
        }
      }
    }
  }
  return scene;
}

TEST_F(TextureLookup, AgreesWithTheReference) {
  Randoms random(1);
  const scene::Scene scene = textured_scene(random);
  std::vector<Lookup> lookups;
  for (std::uint32_t texture = 0; texture < scene.textures.size(); ++texture) {
    for (int i = 0; i < 100; ++i) {
      const float range = i % 4 == 0 ? 3000.0f : i % 4 == 1 ? 1.0f : 4.0f;
      lookups.push_back({texture, random.in(-range, range), random.in(-range, range)});
    }
    // Exact places, negative zero and the rim among them.
    for (const float s : {0.0f, -0.0f, 0.5f, 1.0f, -1.0f, 2.0f, -2.0f, 3.0f, 1e6f})
      lookups.push_back({texture, s, 0.5f});
  }
  const std::vector<glm::vec4> colors = look_up(scene, lookups);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < lookups.size(); ++i) {
    const auto& [index, s, t] = lookups[i];
    const Texture& texture = scene.textures[index];
    if (texture.nearest) {
      // Within a few roundings of a texel's border either side will do; 2^-16 texels leaves them
      // out.
      const auto off_border = [](double x) { return std::abs(x - std::round(x)) > 0x1p-16; };
      const bool exact = s == std::round(s * 2.0f) * 0.5f && texture.width == 64;
      if (!exact &&
          (!off_border(double(s) * texture.width) || !off_border(double(t) * texture.height)))
        continue;
    }
    ++compared;
    // Places are within 4 periods; their products with the size round by 2^-24 of 4 * 64 texels,
    // which moves the weights by 2^-16, each direction and colour at most 1. Decoding adds less
    // than 1e-6.
    const glm::dvec4 off = glm::abs(glm::dvec4(colors[i]) - reference(texture, s, t));
    ASSERT_LT(std::max({off.x, off.y, off.z, off.w}), 4e-5)
        << texture.width << " x " << texture.height << " at " << s << ", " << t << ", wrap "
        << static_cast<int>(texture.wrap_s) << static_cast<int>(texture.wrap_t)
        << (texture.nearest ? " nearest" : " bilinear");
  }
  EXPECT_GT(compared, lookups.size() * 3 / 4);
}

// All codes, where alpha is none.
TEST_F(TextureLookup, DecodesEveryCodeOfSrgb) {
  scene::Scene scene = scene_of({make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
  Texture texture;
  texture.width = 256;
  texture.height = 1;
  texture.srgb = texture.nearest = true;
  std::vector<Lookup> lookups;
  for (int code = 0; code < 256; ++code) {
    const auto byte = static_cast<std::uint8_t>(code);
    texture.rgba8.push_back({byte, 255 - byte, byte, byte});
    lookups.push_back({0, (static_cast<float>(code) + 0.5f) / 256.0f, 0.5f});
  }
  scene.textures.push_back(texture);
  const std::vector<glm::vec4> colors = look_up(scene, lookups);
  for (int code = 0; code < 256; ++code) {
    const glm::vec4 color = colors[static_cast<std::size_t>(code)];
    const double linear = srgb_to_linear(code / 255.0);
    const double reverse = srgb_to_linear((255 - code) / 255.0);
    EXPECT_NEAR(color.r, linear, 1.2e-6 * linear) << code;
    EXPECT_NEAR(color.g, reverse, 1.2e-6 * reverse) << code;
    EXPECT_EQ(color.b, color.r) << code;
    EXPECT_NEAR(color.a, code / 255.0, 1e-7) << code;
  }
}

}  // namespace
}  // namespace ppm::tests
