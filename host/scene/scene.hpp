// The scene as plain values: what a loader yields and everything else reads.
//
// Lengths are in the WORKING FRAME: x_working = (x_world - frame.centre) * frame.scale, with scale
// a power of two chosen so that all triangles lie within [-1,1]^3. This is what lets no absolute
// epsilon depend on the file's units or origin. Radiance and irradiance are the same in both
// frames; a radiant intensity (W/sr) is multiplied by scale^2, so that intensity / distance^2 is
// unchanged.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "extensions.hpp"

namespace ppm::scene {

/// World to working frame, see above. World units are those of the file (metres in glTF).
struct Frame {
  glm::dvec3 centre{0.0};
  double scale = 1.0;

  glm::dvec3 to_working(glm::dvec3 world) const { return (world - centre) * scale; }
  glm::dvec3 to_world(glm::dvec3 working) const { return working / scale + centre; }
};

/// One corner of a triangle.
struct Corner {
  glm::vec3 position;        ///< working frame
  glm::vec3 normal;          ///< unit shading normal; the geometric one where the file has none
  glm::vec2 texcoord{0.0f};  ///< TEXCOORD_0
  glm::vec4 color{1.0f};     ///< COLOR_0, linear, in [0,1]; multiplies the base colour and alpha
};

/// What few scenes need of a corner.
struct CornerDetail {
  glm::vec4 tangent{0.0f};    ///< unit vector of the working frame; w: 1 or -1, bitangent = w n x t
  glm::vec2 texcoord1{0.0f};  ///< TEXCOORD_1
};
using TriangleDetail = std::array<CornerDetail, 3>;

/// A triangle with positive area. Its front side is where the corners run counter-clockwise; the
/// front-side geometric normal is cross(c1-c0, c2-c0). A mirroring node transform has already
/// swapped corners so that this holds as glTF defines it.
struct Triangle {
  std::array<Corner, 3> corners;
  std::uint32_t material = 0;  ///< index into Scene::materials
};

enum class Wrap : std::uint32_t { repeat = 0, clamp_to_edge = 1, mirrored_repeat = 2 };

/// How a material uses a texture.
struct TextureUse {
  std::uint32_t texture = 0;       ///< index into Scene::textures
  std::uint32_t texcoord_set = 0;  ///< 0 or 1
  /// KHR_texture_transform: s = dot(row_s, (u, v, 1)), t = dot(row_t, (u, v, 1)).
  glm::vec3 row_s{1.0f, 0.0f, 0.0f}, row_t{0.0f, 1.0f, 0.0f};

  bool operator==(const TextureUse&) const = default;
};
using OptionalTextureUse = std::optional<TextureUse>;

enum class AlphaMode { opaque, mask, blend };

/// An image as textures use it, row-major from the top (glTF's v = 0), `width * height` texels in
/// one of the two vectors. The same image may be two textures, colours and data.
struct Texture {
  std::string name;
  std::uint32_t width = 0, height = 0;
  Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
  bool nearest = false;              ///< magFilter NEAREST; otherwise bilinear
  bool srgb = false;                 ///< the colours of rgba8 are sRGB codes; alpha never is
  std::vector<glm::u8vec4> rgba8;    ///< RGBA
  std::vector<glm::u16vec4> halves;  ///< RGBA in linear light as IEEE half floats
};

/// A surface in glTF's terms, extensions folded in. One per glTF material that is used, plus glTF's
/// default.
struct Material {
  std::string name;
  glm::vec3 base_color{1.0f};                     ///< linear, in [0,1]
  OptionalTextureUse base_color_texture;          ///< RGBA, multiplies base_color and alpha
  OptionalTextureUse metallic_roughness_texture;  ///< G multiplies roughness, B metallic
  OptionalTextureUse normal_texture;
  OptionalTextureUse emissive_texture;             ///< RGB, multiplies emission
  OptionalTextureUse transmission_texture;         ///< R multiplies transmission
  OptionalTextureUse specular_texture;             ///< A multiplies specular
  OptionalTextureUse specular_color_texture;       ///< RGB, multiplies specular_color
  OptionalTextureUse clearcoat_texture;            ///< R multiplies clearcoat
  OptionalTextureUse clearcoat_roughness_texture;  ///< G multiplies clearcoat_roughness
  float normal_scale = 1.0f;
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha = 1.0f;              ///< in [0,1]; coverage where alpha_mode says so
  float alpha_cutoff = 0.5f;       ///< MASK: covered where alpha is not below
  float metallic = 1.0f;           ///< in [0,1]
  float roughness = 1.0f;          ///< perceptual, in [0,1]; GGX alpha is its square
  float specular = 1.0f;           ///< KHR_materials_specular: 0 makes a dielectric Lambertian
  glm::vec3 specular_color{1.0f};  ///< idem, multiplies the reflectance at normal incidence
  float ior = 1.5f;                ///< KHR_materials_ior, at least 1, or 0: see there
  float transmission = 0.0f;       ///< KHR_materials_transmission, in [0,1]
  float dispersion = 0.0f;         ///< KHR_materials_dispersion: 20 / Abbe number
  float clearcoat = 0.0f, clearcoat_roughness = 0.0f;  ///< KHR_materials_clearcoat, in [0,1]
  bool unlit = false;                                  ///< KHR_materials_unlit
  /// Of two media that overlap the one of higher priority counts, or else the denser one.
  int priority = 0;
  bool solid = false;  ///< KHR_materials_volume with thickness > 0: refracts, attenuates
  glm::vec3 attenuation_color{1.0f};  ///< transmittance after attenuation_distance
  float attenuation_distance = std::numeric_limits<float>::infinity();  ///< working frame
  glm::vec3 emission{0.0f};   ///< emitted radiance, W/(m^2 sr) a channel
  bool double_sided = false;  ///< emits from both sides (every surface scatters on both)
};

/// Of all kinds, in the order of the kernels' PPM_USE_*.
inline std::array<const OptionalTextureUse*, 9> texture_uses(const Material& material) {
  return {&material.base_color_texture,
          &material.metallic_roughness_texture,
          &material.normal_texture,
          &material.emissive_texture,
          &material.transmission_texture,
          &material.specular_texture,
          &material.specular_color_texture,
          &material.clearcoat_texture,
          &material.clearcoat_roughness_texture};
}

enum class PunctualKind { point, spot, directional };

/// A light without extent (KHR_lights_punctual).
struct PunctualLight {
  std::string name;
  PunctualKind kind = PunctualKind::point;
  glm::vec3 position{0.0f};   ///< working frame; point and spot
  glm::vec3 direction{0.0f};  ///< unit, the way the light travels; spot and directional
  /// point, spot: radiant intensity on the axis in W/sr times frame.scale^2; directional:
  /// irradiance on a plane facing the light in W/m^2.
  glm::vec3 intensity{0.0f};
  float inner_cone_angle = 0.0f;  ///< radians from the axis; spot
  float outer_cone_angle = 0.0f;  ///< radians from the axis, in (inner, pi/2]; spot
  /// Working units; where the light's window reaches zero; point and spot.
  float range = std::numeric_limits<float>::infinity();
};

/// Light from infinitely far away, as a map over longitude and latitude: row-major from +Y down to
/// -Y, the middle of each row towards +X, +Z a quarter of the width to its right. Bilinear between
/// the texels' centres.
struct Environment {
  std::string name;
  std::uint32_t width = 0, height = 0;
  std::vector<glm::vec3> texels;  ///< radiance by channel, finite and not negative
  float strength = 1.0f;          ///< multiplies it; W/(m^2 sr)
  double rotation = 0.0;          ///< about +Y, radians, counter-clockwise seen from above
};

/// A camera that looks along `forward`: a pinhole or, with `ymag`, orthographic.
struct Camera {
  std::string name;
  glm::dvec3 position{0.0};                                                     ///< working frame
  glm::dvec3 right{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0}, forward{0.0, 0.0, -1.0};  ///< orthonormal
  double yfov = 0.7853981633974483;  ///< full vertical angle, radians, in (0, pi)
  std::optional<double> aspect;      ///< width / height, where the file gives one
  std::optional<double> ymag;        ///< orthographic: half the height seen, working frame
};

/// What the loader found beside what is rendered: for people, and for nothing else.
struct Findings {
  std::uint64_t file_bytes = 0;  ///< of all files that were read
  /// Of compressed geometry while the file was read, and what its decoders took besides.
  std::uint64_t decoded_bytes = 0, decoder_bytes = 0;
  std::vector<UsedExtension> extensions;     ///< by name
  std::uint64_t triangles_without_area = 0,  ///< left out
      triangles_too_small = 0;               ///< left out: no area in single precision
};

struct Scene {
  std::string file;  ///< as the user named it
  Frame frame;
  std::vector<Triangle> triangles;
  std::vector<TriangleDetail> details;  ///< one a triangle, or none where no material needs them
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<PunctualLight> punctual_lights;
  std::vector<Camera> cameras;
  std::optional<Environment> environment;

  glm::vec3 bounds_min{0.0f}, bounds_max{0.0f};  ///< of the triangles, working frame
  Findings findings;
};

}  // namespace ppm::scene
