// An orthographic camera shows things as large as they are, wherever they stand.
#include "made_document.hpp"
#include "render_harness.hpp"

namespace ppm::test {
namespace {

using nlohmann::json;

class Orthographic : public RenderTest {};

/// A glowing square of edge 1 around the z axis and, far behind it, a black one that keeps the
/// frame.
scene::Scene glowing_square(double depth) {
  GltfDocument document;
  const std::size_t mesh = document.accessor<float>(
      {-0.5f, -0.5f, 0, 0.5f, -0.5f, 0, 0.5f, 0.5f, 0, -0.5f, 0.5f, 0}, "VEC3");
  json& primitive = document.mesh({{"POSITION", mesh}});
  primitive["mode"] = 6;
  primitive["material"] = 0;
  document.root["nodes"][0]["translation"] = {0, 0, depth};
  document.mesh({{"POSITION", mesh}})["mode"] = 6;
  document.root["meshes"][1]["primitives"][0]["material"] = 1;
  document.root["nodes"][1]["translation"] = {0, 0, -6};
  document.root["materials"] = {
      {{"emissiveFactor", {1, 0.5, 0.25}},
       {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}}},
      {{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 1}}}}};
  document.append("cameras",
                  {{"type", "orthographic"},
                   {"orthographic", {{"xmag", 2}, {"ymag", 1}, {"znear", 0}, {"zfar", 9}}}});
  document.append("nodes", {{"camera", 0}, {"translation", {0, 0, 1}}});
  return load(document);
}

// The square covers 8 x 8 of the 32 x 16 pixels of 1/8 each, to the edge.
TEST_F(Orthographic, SquaresKeepTheirSize) {
  for (const double depth : {0.5, -5.0}) {
    const scene::Scene scene = glowing_square(depth);
    const auto picture =
        render_scene(device(), scene, small_settings(scene, 32, 16, 100), 1).picture;
    for (std::uint32_t y = 0; y < 16; ++y) {
      for (std::uint32_t x = 0; x < 32; ++x) {
        const bool is_on_it = x >= 12 && x < 20 && y >= 4 && y < 12;
        const glm::dvec3 expected = is_on_it ? glm::dvec3(1.0, 0.5, 0.25) : glm::dvec3(0.0);
        EXPECT_LT(glm::length(pixel(picture, x, y) - expected), 1e-3)
            << depth << ": " << x << ", " << y;
      }
    }
  }
}

}  // namespace
}  // namespace ppm::test
