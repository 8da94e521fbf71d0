// The media that fill a scene's solids, as the kernels read them (shared/media.h).
#pragma once

#include <cstdint>
#include <vector>

#include "scene.hpp"
#include "shared/layout.h"

namespace ppm::render {

struct MediaTable {
  std::vector<shared::MediumRecord> records;  ///< by rank: number 1 first
  std::vector<std::uint32_t> of_material;     ///< number of the medium behind each, 0 for none
};

/// Throws Failure where there are more media than paths can tell apart.
MediaTable make_media_table(const scene::Scene& scene);

}  // namespace ppm::render
