// What inspect says of a scene that is made by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "gltf_writer.hpp"
#include "inspect_report.hpp"
#include "load_gltf.hpp"
#include "temporary_folder.hpp"

namespace ppm::tests {
namespace {

using nlohmann::json;

// A room of 4 units with a lamp of 2 x 0.5 that faces down, and a lamp in a point.
scene::Scene lamp_scene(Log& log) {
  test::GltfWriter writer;
  const std::size_t grey = writer.material(test::lambert(glm::dvec3(0.5)));
  writer.mesh(test::quad({-2.0f, 0.0f, 2.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -4.0f}), grey);
  json lamp = test::lambert(glm::dvec3(0.0));
  lamp["name"] = "lamp";
  lamp["emissiveFactor"] = {1.0, 0.5, 0.0};
  lamp["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 6.0;
  lamp["extensions"]["KHR_materials_sheen"] = json::object();
  writer.mesh(test::quad({-1.0f, 3.0f, -0.25f}, {2.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.5f}),
              writer.material(lamp));
  writer.point_light({0.0, 1.0, 0.0}, glm::dvec3(1.0, 1.0, 0.5), 3.0);
  writer.camera("above", {0.0, 2.0, 0.5}, {0.0, 0.0, 0.0}, 0.8, 2.0);
  const test::TemporaryFolder folder;
  writer.write(folder / "s.glb");
  return scene::load_gltf(folder / "s.glb", log);
}

render::Settings settings_of(const scene::Scene& scene) {
  render::Settings settings;
  settings.camera = scene.cameras.front();
  return settings;
}

TEST(Inspect, PowersAreThoseOfLambertsAndPoints) {
  Log log(Verbosity::quiet);
  const scene::Scene scene = lamp_scene(log);
  const cli::InspectReport report = cli::inspect(scene, settings_of(scene), log.warnings());
  ASSERT_EQ(report.lights.size(), 2u);
  // 4 pi times intensity; pi times radiance times area. Means over channels.
  const double point = 4.0 * std::numbers::pi * 3.0 * 2.5 / 3.0;
  const double lamp = std::numbers::pi * 6.0 * 1.5 / 3.0 * 1.0;
  EXPECT_EQ(report.lights[0].kind, "point");
  EXPECT_NEAR(report.lights[0].watts, point, 1e-5 * point);
  EXPECT_EQ(report.lights[1].kind, "emissive triangles");
  EXPECT_EQ(report.lights[1].name, "lamp");
  EXPECT_EQ(report.lights[1].count, 2u);
  EXPECT_NEAR(report.lights[1].watts, lamp, 1e-5 * lamp);
  EXPECT_NEAR(report.total_watts, point + lamp, 1e-5 * (point + lamp));
  EXPECT_NEAR(report.bounds_max.x, 2.0, 1e-6);
  EXPECT_NEAR(report.bounds_max.y, 3.0, 1e-6);
  EXPECT_NEAR(report.bounds_min.z, -2.0, 1e-6);
}

TEST(Inspect, TextAndJsonSayTheSame) {
  Log log(Verbosity::quiet);
  const scene::Scene scene = lamp_scene(log);
  const cli::InspectReport report = cli::inspect(scene, settings_of(scene), log.warnings());
  const json parsed = json::parse(cli::report_json(report));
  EXPECT_EQ(parsed["triangles"], 4);
  EXPECT_EQ(parsed["cameras"][0]["name"], "above");
  EXPECT_NEAR(parsed["cameras"][0]["position"][1].get<double>(), 2.0, 1e-6);
  EXPECT_NEAR(parsed["cameras"][0]["yfov_degrees"].get<double>(), 0.8 * 180 / std::numbers::pi,
              1e-4);
  EXPECT_EQ(parsed["materials"].size(), 2u);
  EXPECT_EQ(parsed["materials"][1]["triangles"], 2);
  EXPECT_EQ(parsed["lights"]["groups"][1]["material"], "lamp");
  EXPECT_EQ(parsed["warnings"].size(), log.warnings().size());
  EXPECT_EQ(parsed["memory"]["peak_bytes"], report.memory.peak());
  json sheen;
  for (const json& extension : parsed["extensions"]) {
    if (extension["name"] == "KHR_materials_sheen") sheen = extension;
  }
  EXPECT_EQ(sheen["treatment"],
            scene::treatment_name(scene::find_extension("KHR_materials_sheen")->treatment));
  EXPECT_EQ(sheen["required"], false);

  const std::string text = cli::report_text(report);
  for (const char* part :
       {"triangles: 4", "\"above\"", "\"lamp\"", "point", "emissive triangles",
        "KHR_materials_sheen", "memory of a rendering at 640 x 480", "diffuse", "W in all"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
  for (const std::string& warning : log.warnings()) {
    EXPECT_NE(text.find(warning), std::string::npos) << text;
  }
}

// A material's understanding, in words.
TEST(Inspect, MaterialsAreNamedByWhatLightMeets) {
  Log log(Verbosity::quiet);
  scene::Scene scene = lamp_scene(log);
  const auto surface = [&](const scene::Material& material) {
    scene.materials[0] = material;
    return cli::inspect(scene, settings_of(scene), {}).materials[0].surface;
  };
  scene::Material material;
  material.roughness = 0.0f;
  EXPECT_EQ(surface(material), "metallic mirror");
  material.roughness = 0.5f;
  EXPECT_EQ(surface(material), "metal, roughness 0.5");
  material.metallic = 0.0f;
  EXPECT_EQ(surface(material), "diffuse under gloss, roughness 0.5");
  material.specular = 0.0f;
  EXPECT_EQ(surface(material), "diffuse");
  material.transmission = 0.75f;
  material.roughness = 0.0f;
  material.solid = true;
  EXPECT_EQ(surface(material), "0.75 solid glass, ior 1.5; 0.25 diffuse");
}

}  // namespace
}  // namespace ppm::tests
