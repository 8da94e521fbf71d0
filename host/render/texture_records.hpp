// Textures, how materials use them, and what triangles need for it, as the kernels read them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scene.hpp"
#include "shared/layout.h"

namespace ppm::render {

/// The texels as the kernels read them, and how many bytes they take with the padding to whole
/// texels of 16 bytes.
std::span<const std::byte> texel_data(const scene::Texture& texture);
std::uint64_t texel_bytes(const scene::Texture& texture);

/// One for each texture of the scene, their texels one behind the other. Throws Failure where these
/// have more than 2^32 records of 16 bytes in all.
std::vector<shared::TextureRecord> make_texture_records(const scene::Scene& scene);

/// Appends to `uses` the textures that a material has, in the order of PPM_USE_*, and tells
/// `record` where they are. A normal map of the clear coat is left out: the coat has the base's
/// normals.
void add_texture_uses(const scene::Material& material, shared::MaterialRecord& record,
                      std::vector<shared::TextureUse>& uses);

/// What a triangle needs of Scene::details.
shared::TriangleDetail detail_record(const scene::TriangleDetail& detail);

}  // namespace ppm::render
