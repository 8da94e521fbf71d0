#include "gltf_instancing.hpp"

#include <cmath>

namespace ppm::scene::gltf {

std::optional<Copies> Copies::read(const Element<tinygltf::Node>& node) {
  const auto extension = Extension::find(node, node->extensions, "EXT_mesh_gpu_instancing");
  if (!extension) return std::nullopt;
  const Place attributes = extension->member("attributes");
  Copies copies(attributes);
  for (const auto& [name, index] : extension->indices("attributes")) {
    std::optional<Accessor>* const target = name == "TRANSLATION" ? &copies.translation_
                                            : name == "ROTATION"  ? &copies.rotation_
                                            : name == "SCALE"     ? &copies.scale_
                                                                  : nullptr;
    const Place place = attributes.member(printable(name));
    if (!target) {
      if (!name.starts_with('_')) place.warn("attributes of copies", "is ignored");
      continue;
    }
    target->emplace(follow(place, index, node.model().accessors, "accessors"));
    const Accessor& accessor = **target;
    if (accessor.components() != (name == "ROTATION" ? 4 : 3)) {
      place.fail("has a type that this attribute cannot have", "use VEC4 for ROTATION, else VEC3");
    }
    if (copies.count_ != 0 && accessor.count() != copies.count_) {
      place.fail("has " + std::to_string(accessor.count()) + " elements beside " +
                     std::to_string(copies.count_),
                 "give every attribute as many");
    }
    copies.count_ = accessor.count();
  }
  if (copies.count_ == 0) attributes.fail("places no copy", "write TRANSLATION, ROTATION or SCALE");
  return copies;
}

glm::dmat4 Copies::to_node(std::uint64_t i) const {
  glm::dmat3 linear(1.0);
  if (rotation_) {
    const auto turn = rotation(rotation_->vec4(i));
    if (!turn) {
      place_.member("ROTATION")
          .fail("element " + std::to_string(i) + " is not a rotation",
                "write unit quaternions x, y, z, w");
    }
    linear = *turn;
  }
  if (scale_) {
    const glm::dvec3 scale = scale_->vec3(i);
    for (int axis = 0; axis < 3; ++axis) linear[axis] *= scale[axis];
  }
  glm::dmat4 matrix(linear);
  if (translation_) matrix[3] = {translation_->vec3(i), 1.0};
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (std::isfinite(matrix[column][row])) continue;
      place_.fail("element " + std::to_string(i) + " is not finite", "repair the file");
    }
  }
  return matrix;
}

}  // namespace ppm::scene::gltf
