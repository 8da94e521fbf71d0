// Files that say the same in different ways give the same picture, but for noise.
#include <cmath>

#include "load_gltf.hpp"
#include "mesh_variants.hpp"
#include "render_harness.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;

class Variants : public RenderTest {};

/// The sheets seen from the front, coloured by their vertices, under two lights.
void furnish(GltfDocument& document) {
  json& root = document.root;
  root["materials"] = {
      {{"pbrMetallicRoughness", {{"metallicFactor", 0.2}, {"roughnessFactor", 0.6}}},
       {"doubleSided", true}}};
  const json spot = {{"type", "spot"}, {"intensity", 20}, {"spot", {{"outerConeAngle", 0.5}}}};
  root["extensions"]["KHR_lights_punctual"]["lights"] = {spot, spot};
  document.append("cameras",
                  {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}});
  const std::size_t first = root["nodes"].size();
  document.append("nodes", {{"camera", 0}, {"translation", {0, 0, 8}}});
  for (int i = 0; i < 2; ++i) {
    document.append("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}},
                              {"translation", {3 * i - 1.5, i, 6}}});
  }
  if (!root.contains("scenes")) return;
  for (std::size_t i = 0; i < 3; ++i) root["scenes"][0]["nodes"].push_back(first + i);
}

double difference(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i] - b[i], a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

// Block means differ by no more than those of the plain file with another seed do; a sheet that is
// absent, moved, turned inside out or of another colour differs by several times that.
TEST_F(Variants, GivePicturesEqualToNoise) {
  const auto blocks = [](const MeshVariant& variant, std::uint32_t seed) {
    const TemporaryFolder folder;
    Log log(Verbosity::quiet);
    const scene::Scene scene = scene::load_gltf(variant.write(folder, furnish), log);
    render::Settings settings = small_settings(scene, 40, 24, 60000);
    settings.samples_per_pixel = 4;
    settings.seed = seed;
    return block_means(render_scene(device(), scene, settings, 2).picture, 8);
  };
  const std::vector<MeshVariant> variants = mesh_variants();
  const auto plain = blocks(variants.front(), 0);
  const double noise = difference(plain, blocks(variants.front(), 1));
  double brightness = 0.0;
  for (const glm::dvec3& block : plain) brightness = std::max(brightness, block.y);
  ASSERT_GT(brightness, 8.0 * noise);
  for (const MeshVariant& variant : variants) {
    for (const char* chosen : {"quantised", "Draco", "skinned"}) {
      if (variant.name != chosen) continue;
      EXPECT_LT(difference(plain, blocks(variant, 0)), 2.0 * noise) << variant.name;
    }
  }
}

}  // namespace
}  // namespace ppm::test
