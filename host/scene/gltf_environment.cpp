#include "gltf_environment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>

#include "gltf_image.hpp"
#include "gltf_nodes.hpp"

namespace ppm::scene::gltf {
namespace {

constexpr const char* kName = "EXT_lights_image_based";
constexpr std::size_t kFaces = 6;
constexpr std::uint32_t kLargestFace = 1024;  // its map has 4096 x 2048 texels
constexpr std::uint64_t kLargestFaceBytes = std::uint64_t{8} * kLargestFace * kLargestFace;
constexpr double kLargestIntensity = 1e12;
constexpr float kLeastDivisor = 1.0f / 255.0f;

using Face = std::vector<glm::vec3>;  // size * size texels, row-major from the top
struct Cube {
  std::uint32_t size = 0;
  std::array<Face, kFaces> faces;  // +X, -X, +Y, -Y, +Z, -Z, as seen from the middle
};

int index_of(const Place& place, const tinygltf::Value& value) {
  const double number = value.IsNumber() ? value.GetNumberAsDouble() : -1.0;
  if (number != std::floor(number)) place.fail("is not a whole number", "write an index");
  return static_cast<int>(std::clamp(number, -1.0, 2147483647.0));
}

/// IEC 61966-2-1.
float srgb_to_linear(std::uint8_t code) {
  const float encoded = static_cast<float>(code) / 255.0f;
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

/// RGBD: colours divided by what stands for alpha.
Face decode_face(const Element<tinygltf::Image>& element) {
  const Image image = decode_image(element, true);
  Face face;
  const auto add = [&](glm::vec4 rgbd) {
    face.push_back(glm::vec3(rgbd) / std::max(rgbd.w, kLeastDivisor));
  };
  face.reserve(std::size_t{image.width} * image.height);
  for (const glm::u8vec4& code : image.rgba8) {
    add({srgb_to_linear(code.x), srgb_to_linear(code.y), srgb_to_linear(code.z),
         static_cast<float>(code.w) / 255.0f});
  }
  for (const glm::u16vec4& texel : image.halves) add(glm::unpackHalf(texel));
  return face;
}

void measure_face(const Element<tinygltf::Image>& element, std::uint32_t& size) {
  const ImageSize image = measure_image(element, kLargestFaceBytes);
  if (image.width > kLargestFace) {
    element.fail("its " + std::to_string(image.width) + " texels a side are too many",
                 "use faces of at most 1024");
  }
  if (image.width != image.height || (size != 0 && image.width != size)) {
    element.fail("is not square or not as large as the other faces", "export the light again");
  }
  size = image.width;
}

std::vector<Element<tinygltf::Image>> faces_of(const Extension& light) {
  const Place list = light.member("specularImages");
  const tinygltf::Value* const mips = light.value("specularImages");
  if (mips == nullptr || !mips->IsArray() || mips->ArrayLen() == 0 || !mips->Get(0).IsArray() ||
      mips->Get(0).ArrayLen() != kFaces) {
    list.fail("does not begin with a list of six faces", "export the light again");
  }
  std::vector<Element<tinygltf::Image>> faces;
  for (std::size_t i = 0; i < kFaces; ++i) {
    const Place place = list.item(0).item(i);
    const int index = index_of(place, mips->Get(0).Get(static_cast<int>(i)));
    faces.push_back(follow(place, index, light.model().images, "images"));
  }
  return faces;
}

Cube decode(const EnvironmentSource& source) {
  Cube cube{source.face_size, {}};
  for (std::size_t i = 0; i < kFaces; ++i) cube.faces[i] = decode_face(source.faces[i]);
  return cube;
}

glm::vec3 bilinear(const Cube& cube, std::size_t face, double s, double t) {
  const double last = cube.size - 1.0;
  const double x = std::clamp(s * cube.size - 0.5, 0.0, last);
  const double y = std::clamp(t * cube.size - 0.5, 0.0, last);
  const auto at = [&](double column, double row) {
    return cube
        .faces[face][static_cast<std::size_t>(row) * cube.size + static_cast<std::size_t>(column)];
  };
  const double left = std::floor(x), upper = std::floor(y);
  const double right = std::min(left + 1.0, last), lower = std::min(upper + 1.0, last);
  const auto fx = static_cast<float>(x - left), fy = static_cast<float>(y - upper);
  return glm::mix(glm::mix(at(left, upper), at(right, upper), fx),
                  glm::mix(at(left, lower), at(right, lower), fx), fy);
}

/// Each face as somebody in the middle sees it: +Y is up on the four around; +Y and -Y themselves
/// have +Z at the bottom and at the top.
glm::vec3 radiance_towards(const Cube& cube, glm::dvec3 d) {
  const glm::dvec3 size = glm::abs(d);
  std::size_t face = 0;
  double right = 0.0, down = 0.0, forward = 0.0;
  if (size.x >= size.y && size.x >= size.z) {
    face = d.x > 0.0 ? 0 : 1;
    forward = size.x;
    right = d.x > 0.0 ? d.z : -d.z;
    down = -d.y;
  } else if (size.y >= size.z) {
    face = d.y > 0.0 ? 2 : 3;
    forward = size.y;
    right = -d.x;
    down = d.y > 0.0 ? d.z : -d.z;
  } else {
    face = d.z > 0.0 ? 4 : 5;
    forward = size.z;
    right = d.z > 0.0 ? -d.x : d.x;
    down = -d.y;
  }
  return bilinear(cube, face, 0.5 + 0.5 * right / forward, 0.5 + 0.5 * down / forward);
}

/// From the light's own directions to the world's.
glm::dmat3 rotation_of(const Extension& light) {
  std::array<float, 4> q{0.0f, 0.0f, 0.0f, 1.0f};
  light.factors("rotation", q, -1.0, 1.0);
  const glm::dquat rotation(q[3], q[0], q[1], q[2]);
  if (!(glm::length(rotation) > 0.0)) {
    light.member("rotation").fail("is not a rotation", "write a unit quaternion x, y, z, w");
  }
  return glm::mat3_cast(glm::normalize(rotation));
}

Environment unfold(const Cube& cube, const EnvironmentSource& source) {
  constexpr double kPi = std::numbers::pi;
  Environment environment;
  environment.height = source.map_height();
  environment.width = 2 * environment.height;
  environment.texels.reserve(std::size_t{environment.width} * environment.height);
  const glm::dmat3 to_light = glm::transpose(source.to_world);
  for (std::uint32_t row = 0; row < environment.height; ++row) {
    const double polar = (row + 0.5) / environment.height * kPi;
    for (std::uint32_t column = 0; column < environment.width; ++column) {
      const double longitude = ((column + 0.5) / environment.width - 0.5) * 2.0 * kPi;
      const glm::dvec3 direction(std::sin(polar) * std::cos(longitude), std::cos(polar),
                                 std::sin(polar) * std::sin(longitude));
      environment.texels.push_back(radiance_towards(cube, to_light * direction));
    }
  }
  return environment;
}

}  // namespace

std::optional<EnvironmentSource> find_environment(Document& document, const std::string& wanted) {
  const auto scene = find_scene(document, wanted);
  if (!scene) return std::nullopt;
  const auto reference = Extension::find(*scene, (*scene)->extensions, kName);
  if (!reference || !reference->has("light")) return std::nullopt;
  const Place root(document, "");
  const auto definition = Extension::find(root, document.model.extensions, kName);
  const tinygltf::Value* const lights = definition ? definition->value("lights") : nullptr;
  const Place place = reference->member("light");
  const int index = index_of(place, *reference->value("light"));
  const int count =
      lights != nullptr && lights->IsArray() ? static_cast<int>(lights->ArrayLen()) : 0;
  if (index < 0 || index >= count || !lights->Get(index).IsObject()) {
    place.fail("refers to a light that the file does not have", "use an index of its lights");
  }
  const Extension light(definition->member("lights").item(static_cast<std::size_t>(index)),
                        lights->Get(index).Get<tinygltf::Value::Object>());
  const float intensity = light.factor("intensity", 1.0, 0.0, kLargestIntensity);
  if (intensity == 0.0f) return std::nullopt;
  EnvironmentSource source{intensity, rotation_of(light), faces_of(light), 0};
  for (const auto& face : source.faces) measure_face(face, source.face_size);
  return source;
}

Environment read_environment(const EnvironmentSource& source) {
  Environment environment = unfold(decode(source), source);
  environment.name = source.faces.front().document().file;
  environment.strength = source.intensity;
  return environment;
}

}  // namespace ppm::scene::gltf
