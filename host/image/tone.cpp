#include "tone.hpp"

#include <algorithm>
#include <cmath>

namespace ppm::image {
namespace {

constexpr std::string_view kNames[] = {"linear", "reinhard", "aces", "agx", "pbr-neutral"};

using Matrix = std::array<Rgb, 3>;  // rows

Rgb operator*(const Matrix& m, const Rgb& c) {
  Rgb product{};
  for (std::size_t i = 0; i < 3; ++i) {
    product[i] = m[i][0] * c[0] + m[i][1] * c[1] + m[i][2] * c[2];
  }
  return product;
}

template <class Curve>
Rgb each(const Rgb& c, Curve curve) {
  return {curve(c[0]), curve(c[1]), curve(c[2])};
}

Rgb reinhard(const Rgb& c) {
  const double luminance = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  return each(c, [&](double channel) { return channel / (1.0 + luminance); });
}

Rgb aces(const Rgb& c) {
  // sRGB, D65 to D60, AP1, the saturation of the reference rendering transform; and back.
  constexpr Matrix kInput = {
      {{0.59719, 0.35458, 0.04823}, {0.07600, 0.90834, 0.01566}, {0.02840, 0.13383, 0.83777}}};
  constexpr Matrix kOutput = {{{1.60475, -0.53108, -0.07367},
                               {-0.10208, 1.10813, -0.00605},
                               {-0.00327, -0.07276, 1.07602}}};
  return kOutput * each(kInput * c, [](double v) {
           return (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
         });
}

Rgb agx(const Rgb& c) {
  constexpr Matrix kInset = {{{0.842479062253094, 0.0784335999999992, 0.0792237451477643},
                              {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
                              {0.0423756549057051, 0.0784336, 0.879142973793104}}};
  constexpr Matrix kOutset = {{{1.19687900512017, -0.0980208811401368, -0.0990297440797205},
                               {-0.0528968517574562, 1.15190312990417, -0.0989611768448433},
                               {-0.0529716355144438, -0.0980434501171241, 1.15107367264116}}};
  constexpr double kDarkest = -12.47393, kBrightest = 4.026069;  // log2
  const Rgb codes = kOutset * each(kInset * c, [=](double v) {
                      const double stops = std::clamp(std::log2(v), kDarkest, kBrightest);
                      return agx_contrast((stops - kDarkest) / (kBrightest - kDarkest));
                    });
  return each(codes, [](double code) { return std::pow(std::max(code, 0.0), 2.2); });
}

Rgb pbr_neutral(const Rgb& c) {
  constexpr double kF90 = 0.04, kStart = 0.8 - kF90, kDesaturation = 0.15;
  const double least = std::min({c[0], c[1], c[2]});
  const double offset = least <= 2.0 * kF90 ? least - least * least / (4.0 * kF90) : kF90;
  const Rgb shifted = each(c, [&](double channel) { return channel - offset; });
  const double peak = std::max({shifted[0], shifted[1], shifted[2]});
  if (peak <= kStart) return shifted;
  const double compressed = 1.0 - (1.0 - kStart) * (1.0 - kStart) / (peak + 1.0 - 2.0 * kStart);
  const double kept = 1.0 / (kDesaturation * (peak - compressed) + 1.0);
  return each(shifted, [&](double channel) {
    return channel * (compressed / peak) * kept + compressed * (1.0 - kept);
  });
}

}  // namespace

std::span<const std::string_view> tone_names() {
  return kNames;
}

std::optional<Tone> tone_named(std::string_view name) {
  const auto* const found = std::ranges::find(kNames, name);
  if (found == std::end(kNames)) return std::nullopt;
  return static_cast<Tone>(found - std::begin(kNames));
}

double agx_contrast(double x) {
  // A line of slope 2 through the pivot, bent towards (0,0) and (1,1) by these powers.
  constexpr double kPivot = 20.0 / 33.0, kCode = 0.5, kSlope = 2.0;
  const double power = x < kPivot ? 3.0 : 3.25;
  const double reach = x < kPivot ? kPivot : 1.0 - kPivot;
  const double rise = x < kPivot ? kCode : 1.0 - kCode;
  const double bend = (std::pow(kSlope * reach / rise, power) - 1.0) / std::pow(reach, power);
  const double offset = x - kPivot;
  return kCode +
         kSlope * offset * std::pow(1.0 + bend * std::pow(std::abs(offset), power), -1.0 / power);
}

Rgb tone_mapped(Tone tone, Rgb exposed) {
  if (tone == Tone::linear) return exposed;
  constexpr double kBrightest = 1e100;  // its square can be said
  exposed = each(exposed, [=](double v) { return v > 0.0 ? std::min(v, kBrightest) : 0.0; });
  switch (tone) {
    case Tone::reinhard:
      return reinhard(exposed);
    case Tone::aces:
      return aces(exposed);
    case Tone::agx:
      return agx(exposed);
    default:
      return pbr_neutral(exposed);
  }
}

}  // namespace ppm::image
