// Textures, how materials use them, and what triangles need for it, as the kernels read them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene.hpp"
#include "shared/layout.h"

namespace ppm::render {

struct TextureRecords {
  std::vector<shared::TextureRecord> records;  ///< one for each texture of the scene
  std::vector<glm::uvec4> texels;
};

/// Throws Failure where they have more than 2^32 records of 16 bytes in all.
TextureRecords make_texture_records(const scene::Scene& scene);

/// Appends to `uses` the textures that a material has, in the order of PPM_USE_*, and tells
/// `record` where they are. A normal map of the clear coat is left out: the coat has the base's
/// normals.
void add_texture_uses(const scene::Material& material, shared::MaterialRecord& record,
                      std::vector<shared::TextureUse>& uses);

/// Scene::details in leaf order (`order`: leaf slot -> triangle); empty where the scene has none.
std::vector<shared::TriangleDetail> make_details(const scene::Scene& scene,
                                                 std::span<const std::uint32_t> order);

}  // namespace ppm::render
