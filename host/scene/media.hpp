// The media that fill solids: which there are, which outranks which, and what is done where their
// surfaces touch.
#pragma once

#include <cstdint>
#include <vector>

#include "scene.hpp"

namespace ppm::scene {

/// Whether light gets inside of such a material.
bool has_inside(const Material& material);

/// Index of refraction, KHR_materials_ior's 0 (reflects everything) as one so high that it does.
float index_of(const Material& material);

/// Media are numbered from 1 by rank; 0 is the air.
struct MediaRanking {
  std::vector<std::uint32_t> example;      ///< the first material of each medium, by rank
  std::vector<std::uint32_t> of_material;  ///< number of the medium behind each, 0 for none
};

/// Materials with the same index, attenuation, dispersion and priority have one medium. A medium
/// outranks those of lower priority, of a lower index of refraction and those that come later, in
/// this order.
MediaRanking rank_media(const std::vector<Material>& materials);

/// What surfaces of solids that may touch another medium are moved outwards by, working units: four
/// times the offset of rays' origins.
inline constexpr float kMediaOverlap = 0x1p-18f;

/// Where solids of different media touch, light meets two surfaces at one place, and would meet air
/// between them or miss one. So all media but that of the best rank grow by a hair wherever their
/// box meets another medium's: surfaces that touched overlap then, which ranks resolve.
void let_touching_media_overlap(Scene& scene);

}  // namespace ppm::scene
