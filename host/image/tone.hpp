// How radiance becomes what a display shows.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace ppm::image {

/// Curves from exposed scene-linear colour to display-linear colour, both with BT.709 primaries.
enum class Tone {
  linear,    ///< as it is; what is above 1 is clipped
  reinhard,  ///< L / (1 + L) of the luminance: Reinhard, Stark, Shirley, Ferwerda: Photographic
             ///< Tone Reproduction for Digital Images, 2002, Eq. 3. Hue and saturation stay, so
             ///< that single channels may clip. Exposure stands for the paper's key
  aces,      ///< Hill's fit to the ACES 1.0 reference rendering and sRGB output transforms
             ///< (github.com/TheRealMJP/BakingLab, ACES.hlsl); 0.18 becomes some 0.10
  agx,  ///< Sobotka's AgX with its default contrast (github.com/sobotka/AgX, config.ocio), colour
        ///< brought back by the inverse of its inset as in Wrensch: Minimal AgX Implementation
  pbr_neutral,  ///< Khronos PBR Neutral (github.com/KhronosGroup/ToneMapping,
                ///< PBR_Neutral/README.md)
};

/// As the command line names them, in the order of Tone.
std::span<const std::string_view> tone_names();
std::optional<Tone> tone_named(std::string_view name);

using Rgb = std::array<double, 3>;

/// Linear colour to be clipped to [0,1] and encoded. With other curves than linear negative
/// channels and NaN count as 0; what is infinite, as very bright.
Rgb tone_mapped(Tone tone, Rgb exposed);

/// The contrast curve of AgX: from log2 of the inset colour, -10 to 6.5 stops about 0.18 as [0,1],
/// to a code for a display of gamma 2.2. Increasing, [0,1] onto itself.
double agx_contrast(double x);

}  // namespace ppm::image
