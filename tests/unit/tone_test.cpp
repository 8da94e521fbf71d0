// Tone curves held to what was published of them.
#include "tone.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "image.hpp"

namespace ppm::image {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Tone kTones[] = {Tone::linear, Tone::reinhard, Tone::aces, Tone::agx, Tone::pbr_neutral};
const Rgb kColours[] = {{0.0, 0.0, 0.0},  {0.18, 0.18, 0.18}, {1.0, 1.0, 1.0},  {0.8, 0.1, 0.05},
                        {0.02, 0.3, 0.9}, {4.0, 0.0, 0.0},    {0.5, 30.0, 2.0}, {1e-4, 2e-3, 1e-2}};

void expect_near(const Rgb& a, const Rgb& b, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

TEST(Tone, NamesGoThereAndBack) {
  ASSERT_EQ(tone_names().size(), std::size(kTones));
  for (std::size_t i = 0; i < std::size(kTones); ++i) {
    EXPECT_EQ(tone_named(tone_names()[i]), kTones[i]);
  }
  EXPECT_EQ(tone_named("filmic"), std::nullopt);
  EXPECT_EQ(tone_named(""), std::nullopt);
}

TEST(Tone, LinearIsTheColourItself) {
  for (const Rgb& colour : kColours) EXPECT_EQ(tone_mapped(Tone::linear, colour), colour);
}

TEST(Tone, GreysRiseAndStayGrey) {
  for (const Tone tone : kTones) {
    double before = -1.0;
    for (double grey = 0.0; grey < 60.0; grey = grey * 1.1 + 1e-4) {
      const Rgb shown = tone_mapped(tone, {grey, grey, grey});
      // Rows of the published matrices of AgX sum to 1 within 2e-4, those of ACES within 1e-5.
      const double tolerance = 1e-3 * std::max(shown[1], 1e-2);
      EXPECT_NEAR(shown[0], shown[1], tolerance) << tone_names()[static_cast<std::size_t>(tone)];
      EXPECT_NEAR(shown[2], shown[1], tolerance);
      // AgX ends at 6.5 stops above 0.18.
      EXPECT_GE(shown[1], before);
      before = shown[1];
    }
  }
}

TEST(Tone, NothingComesOutThatCannotBeShown) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Tone tone : kTones) {
    if (tone == Tone::linear) continue;
    for (const Rgb& colour :
         {Rgb{kInfinity, 0.0, 0.0}, Rgb{kInfinity, kInfinity, kInfinity}, Rgb{nan, 1.0, 1.0},
          Rgb{-1.0, -kInfinity, 0.5}, Rgb{1e68, 1e68, 1e68}}) {
      for (const double channel : tone_mapped(tone, colour)) EXPECT_TRUE(std::isfinite(channel));
    }
    expect_near(tone_mapped(tone, {-3.0, nan, 0.5}), tone_mapped(tone, {0.0, 0.0, 0.5}), 0.0);
  }
}

TEST(Tone, ReinhardIsEquation3OfTheLuminance) {
  expect_near(tone_mapped(Tone::reinhard, {1.0, 1.0, 1.0}), {0.5, 0.5, 0.5}, 1e-12);
  expect_near(tone_mapped(Tone::reinhard, {9.0, 9.0, 9.0}), {0.9, 0.9, 0.9}, 1e-12);
  for (const Rgb& colour : kColours) {
    const auto luminance = [](const Rgb& c) {
      return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];  // BT.709
    };
    const Rgb shown = tone_mapped(Tone::reinhard, colour);
    EXPECT_NEAR(luminance(shown), luminance(colour) / (1.0 + luminance(colour)), 1e-12);
    EXPECT_NEAR(shown[0] * colour[1], shown[1] * colour[0], 1e-12);  // the same hue
  }
}

// ---- ACES: the fit's matrices from the primaries that its comments name.

using Matrix = std::array<Rgb, 3>;

Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix product{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) product[i][j] += a[i][k] * b[k][j];
    }
  }
  return product;
}

Rgb operator*(const Matrix& m, const Rgb& c) {
  Rgb product{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) product[i] += m[i][k] * c[k];
  }
  return product;
}

Matrix inverse(const Matrix& m) {
  const auto minor = [&](std::size_t i, std::size_t j) {
    const std::size_t r = (i + 1) % 3, s = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[r][c] * m[s][d] - m[r][d] * m[s][c];
  };
  const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  Matrix result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) result[j][i] = minor(i, j) / determinant;
  }
  return result;
}

Matrix diagonal(const Rgb& d) {
  return {{{d[0], 0.0, 0.0}, {0.0, d[1], 0.0}, {0.0, 0.0, d[2]}}};
}

struct Chromaticity {
  double x, y;
};
Rgb xyz_of(Chromaticity c) {
  return {c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y};
}

/// RGB to XYZ.
Matrix primaries(Chromaticity red, Chromaticity green, Chromaticity blue, Chromaticity white) {
  const Rgb r = xyz_of(red), g = xyz_of(green), b = xyz_of(blue);
  const Matrix columns = {{{r[0], g[0], b[0]}, {r[1], g[1], b[1]}, {r[2], g[2], b[2]}}};
  return columns * diagonal(inverse(columns) * xyz_of(white));
}

Matrix bradford(Chromaticity from, Chromaticity to) {
  const Matrix cones = {
      {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
  const Rgb a = cones * xyz_of(from), b = cones * xyz_of(to);
  return inverse(cones) * diagonal({b[0] / a[0], b[1] / a[1], b[2] / a[2]}) * cones;
}

Matrix saturation(double amount, const Rgb& luminance) {
  Matrix result{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      result[i][j] = (1.0 - amount) * luminance[j] + (i == j ? amount : 0.0);
    }
  }
  return result;
}

TEST(Tone, AcesIsHillsFitBetweenThePrimariesOfAcesAndSrgb) {
  const Chromaticity d65{0.3127, 0.3290}, d60{0.32168, 0.33767};
  const Matrix srgb = primaries({0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, d65);
  const Matrix ap1 = primaries({0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, d60);
  // The transforms' saturation factors: 0.96 of the RRT, 0.93 of the ODT (aces-dev, ACESlib).
  const Matrix input = saturation(0.96, ap1[1]) * inverse(ap1) * bradford(d65, d60) * srgb;
  const Matrix output = inverse(srgb) * bradford(d60, d65) * ap1 * saturation(0.93, ap1[1]);
  for (const Rgb& colour : kColours) {
    Rgb inner = input * colour;
    for (double& v : inner) {
      v = (v * v + 0.0245786 * v - 9.0537e-5) / (0.983729 * v * v + 0.432951 * v + 0.238081);
    }
    // The published matrices have five digits.
    expect_near(tone_mapped(Tone::aces, colour), output * inner, 1e-4);
  }
  // ACES 1.0 shows 0.18 as 4.8 of 48 cd/m^2; the fit is a little brighter.
  EXPECT_NEAR(tone_mapped(Tone::aces, {0.18, 0.18, 0.18})[1], 0.10, 0.01);
  EXPECT_NEAR(tone_mapped(Tone::aces, {1e9, 1e9, 1e9})[1], 1.0 / 0.983729, 1e-4);
}

TEST(Tone, AgxContrastIsTheTableThatWasPublished) {
  // Rows of LUTs/AgX_Default_Contrast.spi1d (github.com/sobotka/AgX), 4096 entries over [0,1].
  const std::pair<int, double> rows[] = {{0, 0.0},          {1813, 0.1975091}, {1823, 0.2011228},
                                         {2481, 0.4996004}, {2482, 0.5000888}, {2483, 0.5005772},
                                         {2999, 0.7464072}, {3000, 0.7468467}, {4095, 1.0}};
  for (const auto& [row, code] : rows) EXPECT_NEAR(agx_contrast(row / 4095.0), code, 1e-7) << row;
  // A polynomial that was fitted to it (Wrensch: Minimal AgX Implementation), with coefficients of
  // four digits.
  for (int i = 0; i <= 1000; ++i) {
    const double x = i / 1000.0;
    const double fit =
        (((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x + 0.1191) * x - 0.00232;
    EXPECT_NEAR(agx_contrast(x), fit, 0.01) << x;
  }
}

TEST(Tone, AgxEndsAndMiddle) {
  // Middle grey is the pivot: code 0.5 on a display of gamma 2.2.
  const double middle = std::pow(0.5, 2.2);
  expect_near(tone_mapped(Tone::agx, {0.18, 0.18, 0.18}), {middle, middle, middle}, 2e-4);
  expect_near(tone_mapped(Tone::agx, {0.0, 0.0, 0.0}), {0.0, 0.0, 0.0}, 1e-9);
  expect_near(tone_mapped(Tone::agx, {1e6, 1e6, 1e6}), {1.0, 1.0, 1.0}, 5e-4);
  // The outset undoes the inset: below the bend, colours keep their order and most of their hue.
  const Rgb red = tone_mapped(Tone::agx, {0.3, 0.1, 0.1});
  EXPECT_GT(red[0], 1.5 * red[1]);
  EXPECT_NEAR(red[1], red[2], 1e-3);
}

TEST(Tone, PbrNeutralIsItsSpecification) {
  // "c_out = c_in - F90 for all input colors where 0.08 <= R, G, B <= 0.8".
  expect_near(tone_mapped(Tone::pbr_neutral, {0.08, 0.5, 0.8}), {0.04, 0.46, 0.76}, 1e-12);
  // Below: f = x - x^2 / 0.16.
  expect_near(tone_mapped(Tone::pbr_neutral, {0.04, 0.04, 0.04}), {0.01, 0.01, 0.01}, 1e-12);
  // Above, grey: p = 0.96, p_n = 1 - 0.24^2 / (0.96 + 1 - 1.52).
  const double grey = 1.0 - 0.0576 / 0.44;
  expect_near(tone_mapped(Tone::pbr_neutral, {1.0, 1.0, 1.0}), {grey, grey, grey}, 1e-12);
  // And red: p = 4, p_n = 1 - 0.0576 / 3.48, g = 1 / (0.15 (4 - p_n) + 1).
  const double peak = 1.0 - 0.0576 / 3.48, g = 1.0 / (0.15 * (4.0 - peak) + 1.0);
  expect_near(tone_mapped(Tone::pbr_neutral, {4.0, 0.0, 0.0}),
              {peak, peak * (1.0 - g), peak * (1.0 - g)}, 1e-12);
  for (const double edge : {0.08, 0.8}) {  // no steps
    expect_near(tone_mapped(Tone::pbr_neutral, {edge * (1.0 - 1e-9), 0.3, edge}),
                tone_mapped(Tone::pbr_neutral, {edge * (1.0 + 1e-9), 0.3, edge}), 1e-8);
  }
  for (const Rgb& colour : kColours) {
    for (const double channel : tone_mapped(Tone::pbr_neutral, colour)) {
      EXPECT_GE(channel, 0.0);
      EXPECT_LE(channel, 1.0);
    }
  }
}

TEST(Tone, BytesAreExposedToneMappedAndEncoded) {
  const std::vector<float> rgb = {0.2f, 0.5f, 4.0f, 1e-3f, 0.0f, 0.7f};
  for (const Tone tone : kTones) {
    const std::vector<std::uint8_t> bytes = srgb_bytes(rgb, {1.0, tone});
    ASSERT_EQ(bytes.size(), rgb.size());
    for (std::size_t pixel = 0; pixel < 2; ++pixel) {
      const Rgb shown = tone_mapped(
          tone, {2.0 * rgb[3 * pixel], 2.0 * rgb[3 * pixel + 1], 2.0 * rgb[3 * pixel + 2]});
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(bytes[3 * pixel + i], srgb_byte(static_cast<float>(shown[i]), 0.0));
      }
    }
  }
}

}  // namespace
}  // namespace ppm::image
