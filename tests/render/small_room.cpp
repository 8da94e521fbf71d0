#include "small_room.hpp"

#include <cstring>

namespace ppm::test {
namespace {

using nlohmann::json;

Mesh scaled(Mesh mesh, double scale) {
  for (glm::vec3& position : mesh.positions) position *= static_cast<float>(scale);
  return mesh;
}

// Six walls, front inwards, in the order -x, +x, -y, +y, -z, +z.
std::vector<Mesh> walls() {
  const Mesh room = inside_out(box(glm::vec3(-1.0f), glm::vec3(1.0f)));
  std::vector<Mesh> result(6);
  for (std::size_t wall = 0; wall < 6; ++wall) {
    result[wall].positions = room.positions;
    const auto first = room.indices.begin() + static_cast<std::ptrdiff_t>(6 * wall);
    result[wall].indices.assign(first, first + 6);
  }
  return result;
}

// Makes all root nodes the children of one that moves them.
void move_all(json& document, glm::dvec3 offset) {
  json& roots = document["scenes"][0]["nodes"];
  document["nodes"].push_back(
      {{"children", roots}, {"translation", {offset.x, offset.y, offset.z}}});
  roots = json::array({document["nodes"].size() - 1});
}

}  // namespace

GltfWriter small_room(double scale, glm::dvec3 offset) {
  GltfWriter writer;
  const auto white = writer.material(lambert(glm::dvec3(0.7)));
  const auto red = writer.material(lambert({0.7, 0.2, 0.1}));
  const auto brushed = writer.material(metal({0.8, 0.7, 0.5}, 0.4));
  const auto mirror = writer.material(metal(glm::dvec3(0.9)));
  const auto lamp = writer.material(emitter({8.0, 7.0, 6.0}));
  const auto ball = writer.material(glass(1.5, {0.7, 0.9, 0.8}, 0.5 * scale));
  const std::size_t materials[6] = {red, white, white, white, brushed, mirror};
  const std::vector<Mesh> sides = walls();
  for (std::size_t wall = 0; wall < 6; ++wall)
    writer.mesh(scaled(sides[wall], scale), materials[wall]);
  writer.mesh(scaled(quad({-0.3f, 0.95f, -0.3f}, {0.6f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.6f}), scale),
              lamp);
  writer.mesh(icosphere(2), ball, placed(scale * glm::dvec3(0.375, -0.5, -0.125), 0.375 * scale));
  writer.mesh(icosphere(1), mirror, placed(scale * glm::dvec3(-0.5, -0.625, -0.375), 0.25 * scale));
  const double area = scale * scale;
  writer.spot_light(scale * glm::dvec3(-0.75, 0.75, 0.5), {1.0, -1.5, -0.5}, {1.0, 0.8, 0.6},
                    4.0 * area, 0.1, 0.4);
  writer.point_light(scale * glm::dvec3(0.75, 0.25, 0.5), {0.3, 0.4, 1.0}, 0.5 * area);
  writer.camera("door", scale * glm::dvec3(0.0, 0.125, 0.875), scale * glm::dvec3(0.0, -0.25, -1.0),
                1.0);
  if (offset != glm::dvec3(0.0)) move_all(writer.document(), offset);
  return writer;
}

render::Settings room_settings(const scene::Scene& scene) {
  render::Settings settings = small_settings(scene, 24, 18, 5000);
  settings.samples_per_pixel = 4;
  return settings;
}

::testing::AssertionResult same_bits(const render::Picture& a, const render::Picture& b) {
  if (a.width != b.width || a.height != b.height || a.rgb.size() != b.rgb.size())
    return ::testing::AssertionFailure() << "pictures of different size";
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i)
    different += std::memcmp(&a.rgb[i], &b.rgb[i], sizeof(float)) != 0;
  if (different == 0) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << different << " of " << a.rgb.size() << " values are different";
}

}  // namespace ppm::test
