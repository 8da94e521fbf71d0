// Units and origin of a file are its author's: the same scene in millimetres or far away is the
// same picture.
#include <algorithm>
#include <cmath>

#include "small_room.hpp"

namespace ppm::test {
namespace {

constexpr unsigned kPasses = 3;

class Invariance : public RenderTest {
 protected:
  static render::Picture picture_of(double scale, glm::dvec3 offset,
                                    render::RadiusMode mode = render::RadiusMode::automatic) {
    const scene::Scene scene = load(small_room(scale, offset));
    render::Settings settings = room_settings(scene);
    settings.radius_mode = mode;
    settings.radius = 0.05 * scale;
    return render_scene(device(), scene, settings, kPasses).picture;
  }
};

// Powers of two change exponents alone: positions, intensities and radii are exact multiples, and
// so is everything computed from them.
TEST_F(Invariance, PowersOfTwoChangeNothing) {
  for (const auto mode : {render::RadiusMode::automatic, render::RadiusMode::fixed}) {
    const render::Picture expected = picture_of(1.0, {}, mode);
    for (const double scale : {0x1p-10, 0x1p13})
      EXPECT_TRUE(same_bits(picture_of(scale, {}, mode), expected)) << "scale " << scale;
  }
}

// Corners are 24-bit numbers above 2^-30 or so; with an offset below 2^17 their sum fits the 53
// bits of the double precision in which nodes are applied and the scene's centre is taken off
// again.
TEST_F(Invariance, FarFromTheOriginChangesNothing) {
  const render::Picture expected = picture_of(1.0, {});
  EXPECT_TRUE(same_bits(picture_of(1.0, {1e5, -1e5, 5e4}), expected));
}

struct Difference {
  double most = 0.0;    // of a 6 x 6 block's mean, relative
  double pixels = 0.0;  // share of pixels off by more than 1e-3, relative
};

Difference compare(const render::Picture& a, const render::Picture& b) {
  Difference result;
  const auto relative = [](glm::dvec3 x, glm::dvec3 y) {
    const glm::dvec3 d = glm::abs(x - y) / glm::max(glm::abs(y), glm::dvec3(1e-3));
    return std::max({d.x, d.y, d.z});
  };
  const auto blocks_a = block_means(a, 6), blocks_b = block_means(b, 6);
  for (std::size_t i = 0; i < blocks_a.size(); ++i)
    result.most = std::max(result.most, relative(blocks_a[i], blocks_b[i]));
  const auto pixels_a = block_means(a, 1), pixels_b = block_means(b, 1);
  for (std::size_t i = 0; i < pixels_a.size(); ++i)
    result.pixels += relative(pixels_a[i], pixels_b[i]) > 1e-3 ? 1.0 : 0.0;
  result.pixels /= static_cast<double>(pixels_a.size());
  return result;
}

// Other factors round every corner anew, and the working frame is not quite as large. The photons
// are the same up to that rounding of 1e-7. Most pixels therefore agree to a few digits less, but
// each bounce off a ball multiplies the error of a direction by some 10, so that a path that stays
// between mirror, glass and rough metal for five or six bounces lands elsewhere. A pixel has some
// 200 photons in its discs: one that leaves or enters changes it by 5e-3, and its block of 36
// pixels, whose discs overlap, by a fraction of that. Measured: 6 % of the pixels differ by more
// than 1e-3, blocks by up to 6e-3; renderings with another seed differ in all pixels, and in blocks
// by 5 % and more.
TEST_F(Invariance, OtherScalesChangeRoundingAlone) {
  const render::Picture expected = picture_of(1.0, {});
  const auto expect_close = [&](double scale, glm::dvec3 offset) {
    const Difference difference = compare(picture_of(scale, offset), expected);
    EXPECT_LT(difference.most, 0.02) << "scale " << scale;
    EXPECT_LT(difference.pixels, 0.15) << "scale " << scale;
  };
  expect_close(1e-3, {});
  expect_close(1e4, {});
  expect_close(1e-3, {1e2, 1e2, -1e2});

  const scene::Scene scene = load(small_room());
  render::Settings other_seed = room_settings(scene);
  other_seed.seed = 1;
  const Difference noise =
      compare(render_scene(device(), scene, other_seed, kPasses).picture, expected);
  EXPECT_GT(noise.most, 0.04) << "the limits above would not tell chance from rounding";
  EXPECT_GT(noise.pixels, 0.8);
}

}  // namespace
}  // namespace ppm::test
