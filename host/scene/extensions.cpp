#include "extensions.hpp"

#include <algorithm>
#include <array>

namespace ppm::scene {
namespace {

using enum Treatment;

// Sorted by name, which the unit tests check.
constexpr std::array kTable{
    ExtensionEntry{"EXT_lights_image_based", implemented, "the first mip of its specularImages"},
    ExtensionEntry{"EXT_mesh_gpu_instancing", implemented, ""},
    ExtensionEntry{"EXT_meshopt_compression", implemented, ""},
    ExtensionEntry{"EXT_texture_avif", ignored, "the texture's own image is read"},
    ExtensionEntry{"EXT_texture_webp", implemented, ""},
    ExtensionEntry{"KHR_animation_pointer", ignored, "animations are not played"},
    ExtensionEntry{"KHR_draco_mesh_compression", implemented, ""},
    ExtensionEntry{"KHR_lights_punctual", implemented, ""},
    ExtensionEntry{"KHR_materials_anisotropy", ignored, "highlights are round"},
    ExtensionEntry{"KHR_materials_clearcoat", implemented, "its normal map is ignored"},
    ExtensionEntry{"KHR_materials_diffuse_transmission", ignored,
                   "no light goes through diffusely"},
    ExtensionEntry{"KHR_materials_dispersion", implemented, ""},
    ExtensionEntry{"KHR_materials_emissive_strength", implemented, ""},
    ExtensionEntry{"KHR_materials_ior", implemented, ""},
    ExtensionEntry{"KHR_materials_iridescence", ignored, "there is no thin film"},
    ExtensionEntry{"KHR_materials_pbrSpecularGlossiness", ignored,
                   "superseded; the metallic-roughness values are read"},
    ExtensionEntry{"KHR_materials_sheen", ignored, "there is no sheen"},
    ExtensionEntry{"KHR_materials_specular", implemented, ""},
    ExtensionEntry{"KHR_materials_transmission", implemented, ""},
    ExtensionEntry{"KHR_materials_unlit", implemented, "lights nothing"},
    ExtensionEntry{"KHR_materials_variants", harmless, "the default materials are rendered"},
    ExtensionEntry{"KHR_materials_volume", implemented, "the thickness is what the ray finds"},
    ExtensionEntry{"KHR_mesh_quantization", implemented, ""},
    ExtensionEntry{"KHR_node_visibility", ignored, "all nodes are rendered"},
    ExtensionEntry{"KHR_texture_basisu", ignored, "the texture's own image is read"},
    ExtensionEntry{"KHR_texture_transform", implemented, ""},
    ExtensionEntry{"KHR_xmp_json_ld", harmless, "metadata"},
    ExtensionEntry{"MSFT_lod", ignored, "the finest level is rendered"},
    ExtensionEntry{"MSFT_texture_dds", ignored, "the texture's own image is read"},
};

}  // namespace

std::span<const ExtensionEntry> known_extensions() {
  return kTable;
}

const ExtensionEntry* find_extension(std::string_view name) {
  const auto found = std::ranges::find(kTable, name, &ExtensionEntry::name);
  return found == kTable.end() ? nullptr : &*found;
}

const char* treatment_name(Treatment treatment) {
  switch (treatment) {
    case implemented:
      return "implemented";
    case harmless:
      return "harmless";
    case ignored:
      return "ignored";
  }
  return "";
}

}  // namespace ppm::scene
