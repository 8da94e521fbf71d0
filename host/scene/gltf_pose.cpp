#include "gltf_pose.hpp"

#include <algorithm>
#include <cmath>

namespace ppm::scene::gltf {
namespace {

/// More than what rounding to 8 bits, eight times, makes of a sum of 1.
constexpr double kUnitSumTolerance = 0.02;

}  // namespace

NormalTransform::NormalTransform(const glm::dmat4& to_world) {
  glm::dmat3 m(to_world);
  double largest = 0.0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(m[column][row]));
  }
  if (largest > 0.0) m /= largest;
  matrix = {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
  mirrors = glm::dot(m[0], matrix[0]) < 0.0;
  if (mirrors) matrix = -matrix;
}

SkinReader::SkinReader(const std::vector<Placement>& placements) {
  for (const Placement& placement : placements) {
    const auto& nodes = placement.node.model().nodes;
    placements_[static_cast<int>(&*placement.node - nodes.data())] = &placement;
  }
}

std::shared_ptr<const Skin> SkinReader::read(const Element<tinygltf::Node>& node) {
  if (node->skin == -1) return nullptr;
  const auto element = follow(node.member("skin"), node->skin, node.model().skins, "skins");
  const auto known = known_.find(node->skin);
  if (known != known_.end()) return known->second;
  return known_.emplace(node->skin, read_new(element)).first->second;
}

std::shared_ptr<const Skin> SkinReader::read_new(const Element<tinygltf::Skin>& element) const {
  const Place joints = element.member("joints");
  if (element->joints.empty()) joints.fail("is empty", "give the skin a joint");
  std::optional<Accessor> inverse_binds;
  if (element->inverseBindMatrices != -1) {
    const Place place = element.member("inverseBindMatrices");
    inverse_binds.emplace(
        follow(place, element->inverseBindMatrices, element.model().accessors, "accessors"));
    if (inverse_binds->components() != 16) place.fail("are not of type MAT4", "write matrices");
    if (inverse_binds->count() < element->joints.size()) {
      place.fail("are fewer than the " + std::to_string(element->joints.size()) + " joints",
                 "write one for each");
    }
  }
  auto skin = std::make_shared<Skin>();
  for (std::size_t i = 0; i < element->joints.size(); ++i) {
    const int joint = element->joints[i];
    follow(joints.item(i), joint, element.model().nodes, "nodes");
    const auto placement = placements_.find(joint);
    if (placement == placements_.end()) {
      joints.item(i).warn("absent joints", "is not in the scene; the mesh is not skinned");
      return nullptr;
    }
    glm::dmat4 matrix = placement->second->to_world;
    if (inverse_binds) matrix = matrix * inverse_binds->mat4(i);
    for (int column = 0; column < 4; ++column) matrix[column][3] = column == 3 ? 1.0 : 0.0;
    skin->joints.push_back(matrix);  // what is not finite shows in the vertices
  }
  return skin;
}

Pose pose_of(const Placement& placement, const Element<tinygltf::Mesh>& mesh, SkinReader& skins) {
  const Element<tinygltf::Node>& node = placement.node;
  Pose pose{placement.to_world, mesh->weights, skins.read(node)};
  if (!node->weights.empty()) pose.morph_weights = node->weights;
  return pose;
}

PosedPrimitive::PosedPrimitive(const Primitive& primitive, const Pose& pose)
    : primitive_(primitive),
      to_world_(pose.to_world),
      skin_(primitive.influences.empty() ? nullptr : pose.skin.get()) {
  const std::size_t count = std::min(primitive.targets.size(), pose.morph_weights.size());
  for (std::size_t i = 0; i < count; ++i) {
    const double weight = pose.morph_weights[i];
    if (weight != 0.0) targets_.emplace_back(&primitive.targets[i], weight);
  }
}

glm::dvec3 PosedPrimitive::morphed(glm::dvec3 value, std::optional<Accessor> MorphTarget::*part,
                                   std::uint64_t vertex) const {
  for (const auto& [target, weight] : targets_) {
    if (const auto& accessor = target->*part) value += weight * accessor->vec3(vertex);
  }
  return value;
}

glm::dvec3 PosedPrimitive::position(std::uint64_t vertex) const {
  return morphed(primitive_.position.vec3(vertex), &MorphTarget::position, vertex);
}

glm::dvec3 PosedPrimitive::normal(std::uint64_t vertex) const {
  return morphed(primitive_.normal->vec3(vertex), &MorphTarget::normal, vertex);
}

glm::dvec4 PosedPrimitive::tangent(std::uint64_t vertex) const {
  const glm::dvec4 tangent = primitive_.tangent->vec4(vertex);
  return {morphed(glm::dvec3(tangent), &MorphTarget::tangent, vertex), tangent.w};
}

glm::dmat4 PosedPrimitive::blended_joints(std::uint64_t vertex) const {
  glm::dmat4 sum(0.0);
  double total = 0.0;
  for (const auto& [joints, weights] : primitive_.influences) {
    const glm::dvec4 weight = weights.vec4(vertex);
    for (int i = 0; i < 4; ++i) {
      if (weight[i] == 0.0) continue;
      const auto joint = static_cast<std::uint64_t>(joints.real(vertex, i));
      if (joint >= skin_->joints.size()) {
        primitive_.element.member("attributes")
            .fail("joint " + std::to_string(joint) + " of vertex " + std::to_string(vertex) +
                      " exceeds the skin's " + std::to_string(skin_->joints.size()),
                  "repair the skin");
      }
      sum += skin_->joints[joint] * weight[i];
      total += weight[i];
    }
  }
  if (!(std::abs(total - 1.0) <= kUnitSumTolerance)) {
    primitive_.element.warn("weights of joints",
                            "weights of joints that do not sum to 1 are scaled so");
  }
  if (!(std::abs(total) > 1e-6)) return skin_->joints.front();
  return sum / total;
}

}  // namespace ppm::scene::gltf
