// Scenes built in a test and written as .glb files. Units are glTF's: metres, W/(m^2 sr), W/sr,
// radians.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ppm::test {

/// Triangles by index, three indices each, counter-clockwise seen from the front. `normals`,
/// `texcoords` and `colors` are empty or one per position; without normals the surface is
/// flat-shaded.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> texcoords;
  std::vector<glm::vec3> colors;
};

enum class Shading { smooth, flat };

/// A parallelogram, front towards cross(edge_u, edge_v), texture coordinates (0,0) at `corner` to
/// (1,1).
Mesh quad(glm::vec3 corner, glm::vec3 edge_u, glm::vec3 edge_v);
/// An axis-aligned box, front outwards, 12 triangles, flat.
Mesh box(glm::vec3 low, glm::vec3 high);
/// The unit sphere about the origin in 20 * 4^subdivisions triangles with their corners on it,
/// front outwards. Smooth: normals are the sphere's own.
Mesh icosphere(unsigned subdivisions, Shading shading = Shading::smooth);
/// The regular polygon of `segments` corners on the unit circle in the plane y = 0, front towards
/// +Y.
Mesh disc(unsigned segments);
/// The same surface with its front where its back was; normals turn with it.
Mesh inside_out(Mesh mesh);

/// A transform that scales evenly, then moves.
glm::dmat4 placed(glm::dvec3 position, double scale = 1.0);

/// Materials as glTF JSON. Add to them what a test needs, for example `m["doubleSided"] = true`.
nlohmann::json lambert(glm::dvec3 albedo);
/// Black but for its emission of `radiance` per channel from the front.
nlohmann::json emitter(glm::dvec3 radiance);
/// `with_emission(lambert(a), e)` is a furnace's wall.
nlohmann::json with_emission(nlohmann::json material, glm::dvec3 radiance);
nlohmann::json metal(glm::dvec3 color, double roughness = 0.0);
/// A smooth solid that refracts. `attenuation_color` is what is left after `attenuation_distance`
/// metres.
nlohmann::json glass(double ior, glm::dvec3 attenuation_color = glm::dvec3(1.0),
                     std::optional<double> attenuation_distance = std::nullopt);
/// A smooth sheet without thickness, transmitted light tinted by `tint`.
nlohmann::json thin_glass(double ior, glm::dvec3 tint = glm::dvec3(1.0));

/// Collects a scene, then writes it. Every object becomes a root node of the one scene, in order of
/// the calls.
class GltfWriter {
 public:
  GltfWriter();

  /// Any glTF material; its extensions are declared by themselves. Returns its index.
  std::size_t material(nlohmann::json material);
  /// Throws std::invalid_argument where `mesh` breaks its own rules.
  void mesh(const Mesh& mesh, std::size_t material, const glm::dmat4& transform = glm::dmat4(1.0));
  void camera(std::string_view name, glm::dvec3 eye, glm::dvec3 target, double yfov,
              std::optional<double> aspect = std::nullopt, glm::dvec3 up = {0.0, 1.0, 0.0});
  void point_light(glm::dvec3 position, glm::dvec3 color, double intensity);
  void spot_light(glm::dvec3 position, glm::dvec3 direction, glm::dvec3 color, double intensity,
                  double inner_cone_angle, double outer_cone_angle);
  void directional_light(glm::dvec3 direction, glm::dvec3 color, double irradiance);

  /// The document so far, for tests that bend it before `write`.
  nlohmann::json& document() { return document_; }

  /// Throws std::runtime_error when the file cannot be written.
  void write(const std::filesystem::path& file) const;

 private:
  template <class Vector>
  std::size_t accessor(const std::vector<Vector>& values, std::string_view type, int target);
  void node(nlohmann::json node, const glm::dmat4& transform);
  void light(nlohmann::json light, const glm::dmat4& transform);
  void declare(const std::string& extension);

  nlohmann::json document_;
  std::vector<std::uint8_t> binary_;
};

}  // namespace ppm::test
