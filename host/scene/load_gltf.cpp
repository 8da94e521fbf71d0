#include "load_gltf.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <numbers>

#include "alpha.hpp"
#include "failure.hpp"
#include "gltf_camera.hpp"
#include "gltf_environment.hpp"
#include "gltf_instancing.hpp"
#include "gltf_light.hpp"
#include "gltf_material.hpp"
#include "gltf_mesh.hpp"
#include "load_environment.hpp"
#include "media.hpp"

namespace ppm::scene {
namespace {

using namespace gltf;

constexpr std::uint64_t kMostTriangles = std::uint64_t{1} << 25;  // 4.6 GB of them
constexpr int kExtremeExponent = 40;  // extents from 1e-12 to 1e12 keep all products in range

/// The meshes that nodes use, each read once. Element addresses in a map are stable.
using Meshes = std::map<int, std::vector<Primitive>>;

/// A mesh's primitives as a node poses them, and the copies that it makes of them.
struct Instance {
  const std::vector<Primitive>* primitives;
  Pose pose;
  std::optional<Copies> copies;

  std::uint64_t count() const { return copies ? copies->count() : 1; }
};

void check_version(const Place& root) {
  const tinygltf::Asset& asset = root.model().asset;
  const bool is_enough = asset.minVersion.empty() || asset.minVersion == "2.0";
  if (!asset.version.starts_with("2.") || !is_enough) {
    root.member("asset.version")
        .fail("is not 2.0 but " + printable(asset.version), "export the scene as glTF 2.0");
  }
}

std::vector<Instance> place_meshes(const std::vector<Placement>& placements,
                                   MaterialUses& materials, Meshes& meshes) {
  std::vector<Instance> instances;
  SkinReader skins(placements);
  for (const Placement& placement : placements) {
    const Element<tinygltf::Node>& node = placement.node;
    if (node->mesh == -1) continue;
    const auto element = follow(node.member("mesh"), node->mesh, node.model().meshes, "meshes");
    auto mesh = meshes.find(node->mesh);
    if (mesh == meshes.end()) {
      mesh = meshes.emplace(node->mesh, read_primitives(element, materials)).first;
    }
    instances.push_back({&mesh->second, pose_of(placement, element, skins), Copies::read(node)});
  }
  return instances;
}

/// Calls `visit` with every primitive as posed, copies included.
template <typename Visitor>
void for_each_posed(const std::vector<Instance>& instances, Visitor&& visit) {
  for (const Instance& instance : instances) {
    for (std::uint64_t i = 0; i < instance.count(); ++i) {
      Pose pose = instance.pose;
      if (instance.copies) pose.to_world = pose.to_world * instance.copies->to_node(i);
      for (const Primitive& primitive : *instance.primitives)
        visit(PosedPrimitive(primitive, pose));
    }
  }
}

std::uint64_t checked_triangle_count(const std::vector<Instance>& instances, const Place& root) {
  std::uint64_t count = 0;
  for (const Instance& instance : instances) {
    for (const Primitive& primitive : *instance.primitives) {
      // Both factors are below 2^48; the first is at least 1.
      const std::uint64_t most = (kMostTriangles - count) / instance.count();
      if (primitive.triangle_count > most) {
        root.fail("the scene has more than " + std::to_string(kMostTriangles) + " triangles",
                  "simplify its meshes or use fewer instances");
      }
      count += instance.count() * primitive.triangle_count;
    }
  }
  if (count == 0) root.fail("the scene has no triangles", "export some geometry");
  return count;
}

Box box_of(const std::vector<Instance>& instances) {
  Box box;
  for_each_posed(instances, [&](const PosedPrimitive& posed) { extend(box, posed); });
  return box;
}

Frame frame_of(const Box& box, const Place& root) {
  const glm::dvec3 half = 0.5 * box.high - 0.5 * box.low;
  const double extent = std::max({half.x, half.y, half.z});
  int exponent = 0;
  const double mantissa = std::frexp(extent, &exponent);  // in [0.5, 1), or 0
  if (mantissa == 0.5) --exponent;                        // so that the largest lies in (0.5, 1]
  if (mantissa == 0.0) root.fail("the scene has no extent: all vertices coincide", "scale it up");
  if (std::abs(exponent) > kExtremeExponent) {
    root.fail("the scene's extent is beyond 1e-12 to 1e12", "scale it");
  }
  return {0.5 * box.low + 0.5 * box.high, std::ldexp(1.0, -exponent)};
}

std::uint64_t emissive_triangle_count(const std::vector<Instance>& instances,
                                      const std::vector<Material>& materials) {
  std::uint64_t count = 0;
  for (const Instance& instance : instances) {
    for (const Primitive& primitive : *instance.primitives) {
      const bool emits = materials[primitive.material].emission != glm::vec3(0.0f);
      count += emits ? instance.count() * primitive.triangle_count : 0;
    }
  }
  return count;
}

/// Needs the scene's frame and materials.
void bake_triangles(const std::vector<Instance>& instances, const SceneSize& size,
                    const Place& root, Scene& scene, Log& log) {
  Baked baked;
  baked.with_details = size.details;
  baked.triangles.reserve(size.triangles);
  if (baked.with_details) baked.details.reserve(size.triangles);
  std::vector<DetailNeeds> needs;
  for (const Material& material : scene.materials) needs.push_back(needs_of(material));
  for_each_posed(instances, [&](const PosedPrimitive& posed) {
    bake(posed, scene.frame, needs.at(posed.primitive().material), baked);
  });
  scene.triangles = std::move(baked.triangles);
  scene.details = std::move(baked.details);
  const LeftOut& left_out = baked.left_out;
  scene.findings.triangles_without_area = left_out.without_area;
  scene.findings.triangles_too_small = left_out.too_small;
  if (left_out.without_area > 0) {
    log.warn(scene.file + ": " + std::to_string(left_out.without_area) +
             " triangles without area were left out");
  }
  if (left_out.too_small > 0) {
    log.warn(scene.file + ": " + std::to_string(left_out.too_small) +
             " triangles are too small beside the scene's extent and were left out");
  }
  if (scene.triangles.empty()) {
    root.fail("no triangle of the scene has any area", "export some geometry");
  }
}

void measure_bounds(Scene& scene) {
  scene.bounds_min = scene.bounds_max = scene.triangles.front().corners[0].position;
  for (const Triangle& triangle : scene.triangles) {
    for (const Corner& corner : triangle.corners) {
      scene.bounds_min = glm::min(scene.bounds_min, corner.position);
      scene.bounds_max = glm::max(scene.bounds_max, corner.position);
    }
  }
}

void read_materials(const MaterialUses& uses, const Place& root, MaterialReader& reader,
                    Scene& scene) {
  const Place list = root.member("materials");
  for (const std::optional<int>& index : uses.in_order()) {
    if (index) {
      const auto element = follow(list, *index, root.model().materials, "materials");
      scene.materials.push_back(reader.read(element, scene.frame.scale));
    } else {
      scene.materials.push_back({});
      scene.materials.back().name = "default";
    }
  }
}

/// What follows from the scene's materials and lights.
void complete(SceneSize& size, const std::vector<Instance>& instances, const Scene& scene) {
  size.materials = scene.materials.size();
  size.details = std::ranges::any_of(
      scene.materials, [](const Material& material) { return needs_of(material).any(); });
  size.lights = scene.punctual_lights.size() + emissive_triangle_count(instances, scene.materials);
}

Scene read_scene(const std::filesystem::path& file, const LoadOptions& options, Log& log) {
  if (options.admit) {
    SceneSize size;
    std::error_code unknown;  // what cannot be measured cannot be read either, which is told below
    const auto bytes = std::filesystem::file_size(file, unknown);
    if (!unknown) size.file_bytes = bytes;
    options.admit(size, nullptr);
  }
  Document document = read_document(file, log);
  document.admit = options.admit;
  document.ask_admission();
  const Place root(document, "");
  check_version(root);
  const std::vector<Placement> placements = place_nodes(document, options.scene);
  MaterialUses uses;
  Meshes meshes;
  const std::vector<Instance> instances = place_meshes(placements, uses, meshes);

  Scene scene;
  scene.file = document.file;
  scene.findings.extensions = document.extensions;
  scene.findings.file_bytes = document.size.file_bytes;
  document.size.triangles = checked_triangle_count(instances, root);
  document.ask_admission();
  const Box box = box_of(instances);
  scene.frame = frame_of(box, root);
  scene.bounds_min = scene.frame.to_working(box.low);
  scene.bounds_max = scene.frame.to_working(box.high);
  for (const Placement& placement : placements) {
    if (auto light = read_light(placement, scene.frame, options.luminous_efficacy))
      scene.punctual_lights.push_back(*light);
    if (auto camera = read_camera(placement, scene.frame)) scene.cameras.push_back(*camera);
  }
  MaterialReader reader(scene.textures);
  read_materials(uses, root, reader, scene);
  std::optional<EnvironmentSource> environment;
  if (options.environment.empty()) environment = find_environment(document, options.scene);

  if (environment) document.size.environment_texels = environment->texels();
  if (!options.environment.empty()) {
    document.size.environment_texels = environment_texels(options.environment);
  }
  complete(document.size, instances, scene);
  scene.findings.decoded_bytes = document.size.decoded_bytes;
  scene.findings.decoder_bytes = document.size.decoder_bytes;
  document.ask_admission(&scene);

  reader.decode_textures();
  bake_triangles(instances, document.size, root, scene, log);
  measure_bounds(scene);
  settle_alpha_modes(scene);
  let_touching_media_overlap(scene);
  if (environment) scene.environment = read_environment(*environment);
  return scene;
}

}  // namespace

Scene load_gltf(const std::filesystem::path& file, Log& log, const LoadOptions& options) {
  try {
    Scene scene = read_scene(file, options, log);
    if (!options.environment.empty()) {
      scene.environment = load_environment(options.environment, log);
      scene.environment->rotation = options.environment_rotation * std::numbers::pi / 180.0;
      scene.environment->strength = static_cast<float>(options.environment_strength);
    }
    return scene;
  } catch (const std::bad_alloc&) {
    throw Failure(file.string(), "", "needs more memory than there is", "use a smaller scene");
  }
}

Camera frame_camera(const Scene& scene) {
  const glm::dvec3 low(scene.bounds_min), high(scene.bounds_max);
  const double radius = 0.5 * glm::length(high - low);
  Camera camera;
  camera.name = "automatic";
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.0, 0.35, 1.0));
  // A sphere touches the upper and lower edge when seen from radius / sin(fov / 2); a tenth is left
  // as margin.
  camera.position = 0.5 * (low + high) + direction * (1.1 * radius / std::sin(0.5 * camera.yfov));
  camera.forward = -direction;
  camera.right = glm::normalize(glm::cross(camera.forward, glm::dvec3(0.0, 1.0, 0.0)));
  camera.up = glm::cross(camera.right, camera.forward);
  return camera;
}

}  // namespace ppm::scene
