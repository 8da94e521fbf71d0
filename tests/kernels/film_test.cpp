// The film against sums of 128 bits on the host: exact, whatever the order.
#include "film.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "counters.hpp"
#include "device_fixture.hpp"
#include "ppm_pass_test_shaders.hpp"
#include "randoms.hpp"

namespace ppm::tests {
namespace {

__extension__ using Wide = unsigned __int128;

struct Splat {
  std::uint32_t pixel;
  glm::vec3 radiance;
};
static_assert(sizeof(Splat) == 16);

shared::SceneConstants lit_scene(float total_power) {
  shared::SceneConstants scene{};
  scene.total_power = total_power;
  scene.bounding_radius = 1.5f;
  scene.width = 7;
  scene.height = 3;
  return scene;
}

Wide wide(const std::uint32_t* words) {
  return (Wide{words[2]} << 64) | (Wide{words[1]} << 32) | words[0];
}

/// Units of a value, rounded to nearest.
Wide units_of(float radiance, float scale) {
  int exponent;
  const double mantissa = std::frexp(static_cast<double>(radiance) * scale, &exponent);
  if (exponent <= 62) return static_cast<Wide>(std::nearbyint(std::ldexp(mantissa, exponent)));
  return static_cast<Wide>(std::ldexp(mantissa, 62)) << (exponent - 62);
}

class FilmOnDevice : public DeviceTest {
 protected:
  FilmOnDevice() : kernel_(device(), shaders::film_probe), counters_(device()) {}

  void add(render::Film& film, std::span<const Splat> splats) {
    const gpu::Buffer buffer = gpu::make_buffer(device(), "splats", splats, gpu::Usage::storage);
    gpu::BindingTable table;
    table.set(PPM_BIND_TEST_0, buffer);
    film.bind(table);
    counters_.bind(table);
    struct {
      std::uint32_t first, count;
    } push{};
    device().run([&](gpu::Recorder& recorder) {
      counters_.clear(recorder);
      recorder.dispatch(kernel_, table, push, splats.size());
      counters_.read(recorder);
    });
  }

  gpu::Kernel kernel_;
  render::Counters counters_;
};

// Magnitudes from half a unit on, most of them into few pixels, so that words wrap.
TEST_F(FilmOnDevice, SumsAreExactInAnyOrder) {
  const shared::SceneConstants scene = lit_scene(40.0f);
  const float scale = shared::film_scale(scene.total_power, scene.bounding_radius);
  Randoms random(1);
  std::vector<Splat> splats(100000);
  for (Splat& splat : splats) {
    splat.pixel = random.below(random.below(2) == 0 ? 2 : 21);
    const auto value = [&] {
      return std::ldexp(1.0f + random.in(0.0f, 1.0f), static_cast<int>(random.below(81)) - 1) /
             scale;
    };
    splat.radiance = {value(), value(), value()};
  }
  std::vector<Wide> expected(3 * 21);
  for (const Splat& splat : splats) {
    for (int c = 0; c < 3; ++c) {
      expected[21 * c + splat.pixel] += units_of(splat.radiance[c], scale);
    }
  }
  render::Film film(device(), scene);
  add(film, splats);
  const std::vector<std::uint32_t> words = film.save();
  ASSERT_EQ(words.size(), 3 * expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_TRUE(wide(&words[3 * i]) == expected[i]) << "sum " << i;
  }
  EXPECT_EQ(counters_[PPM_COUNTER_OVERFLOW], 0u);

  const render::Picture picture = film.resolve(1000.0);
  ASSERT_EQ(picture.rgb.size(), expected.size());
  for (std::size_t i = 0; i < 21; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = static_cast<double>(expected[21 * c + i]) / scale / 1000.0;
      EXPECT_FLOAT_EQ(picture.rgb[3 * i + c], static_cast<float>(value));
    }
  }

  render::Film another(device(), scene);
  ASSERT_TRUE(another.restore(film.save()));
  EXPECT_EQ(another.save(), words);
  EXPECT_FALSE(another.restore(std::span(words).first(5)));
  another.keep();
  add(another, splats);
  EXPECT_NE(another.save(), words);
  another.revert();
  EXPECT_EQ(another.save(), words);
  another.clear();
  std::ranges::reverse(splats);
  add(another, splats);
  EXPECT_EQ(another.save(), words);
}

TEST_F(FilmOnDevice, CountsWhatDoesNotFit) {
  const shared::SceneConstants scene = lit_scene(40.0f);
  render::Film film(device(), scene);
  const float infinity = std::numeric_limits<float>::infinity();
  add(film, std::vector<Splat>{{0, glm::vec3(std::nanf(""), 1.0f, 1.0f)},
                               {0, glm::vec3(infinity)},
                               {1, glm::vec3(1e37f, 0.0f, 2.0f)},
                               {2, glm::vec3(-3.0f, 1.0f, 1.0f)}});
  EXPECT_EQ(counters_[PPM_COUNTER_NON_FINITE], 2u);
  EXPECT_EQ(counters_[PPM_COUNTER_OVERFLOW], 1u);
  const render::Picture picture = film.resolve(1.0);
  EXPECT_EQ(picture.rgb[0], 0.0f);
  EXPECT_GT(picture.rgb[3], 1e13f);
  EXPECT_EQ(picture.rgb[5], 2.0f);
  EXPECT_EQ(picture.rgb[6], 0.0f);
  EXPECT_EQ(picture.rgb[7], 1.0f);
}

// A power of two, so that nothing is lost; within range for any light.
TEST(FilmScale, FollowsTheLight) {
  for (const float power : {0.0f, 1e-40f, 1e-30f, 1e-10f, 1.0f, 100.0f, 1e10f, 1e38f}) {
    int exponent;
    const float scale = shared::film_scale(power, 1.5f);
    EXPECT_EQ(std::frexp(scale, &exponent), 0.5f) << power;
    const double reference = power / (4.0 * M_PI * M_PI * 1.5 * 1.5);
    if (reference < 1e-24 || reference > 1e24) continue;
    EXPECT_LE(reference * scale, std::ldexp(2.0, PPM_FILM_FRACTION_BITS)) << power;
    EXPECT_GE(reference * scale, std::ldexp(0.999999, PPM_FILM_FRACTION_BITS)) << power;
  }
}

}  // namespace
}  // namespace ppm::tests
