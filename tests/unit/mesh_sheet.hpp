// A wavy sheet and the parts of documents that show it twice: what all variants are made of.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "made_document.hpp"

namespace ppm::test::variants {

constexpr int kColumns = 6, kRows = 4;

/// What a document is made of; positions lie in [-1,1]^3.
struct MeshData {
  std::vector<float> positions, normals, texcoords, colors;  // 3, 3, 2, 4 a vertex
  std::vector<std::uint32_t> indices;                        // of triangles

  std::size_t count() const { return positions.size() / 3; }
};

/// A wavy sheet.
MeshData sheet();

/// Where the two copies stand: one unevenly scaled and turned, one mirrored.
struct Stand {
  glm::dvec3 translation;
  glm::dquat rotation;
  glm::dvec3 scale;

  glm::dmat4 matrix() const;
};

extern const Stand kStands[2];

nlohmann::json as_json(const glm::dmat4& matrix);

/// Appends nodes that show the mesh `index` twice, each time through `inner`.
void place_twice(GltfDocument& document, std::size_t index,
                 const glm::dmat4& inner = glm::dmat4(1.0));
/// Appends a mesh without nodes and returns its only primitive.
nlohmann::json& add_mesh(GltfDocument& document, nlohmann::json attributes);
nlohmann::json float_attributes(GltfDocument& document, const MeshData& mesh);
nlohmann::json& add_float_mesh(GltfDocument& document, const MeshData& mesh);

/// Every third vertex of an accessor is put right by its sparse part; without `base` all are, on
/// zeros.
void make_sparse(GltfDocument& document, std::size_t accessor, const std::vector<float>& values,
                 std::size_t components, bool base);

/// As used and required.
void declare(GltfDocument& document, const char* extension);

/// An accessor of elements of `stride` bytes, packed by meshoptimizer.
std::size_t add_packed(GltfDocument& document, const Bytes& bytes, std::size_t stride,
                       const char* type, int component_type, const char* mode = "ATTRIBUTES",
                       const char* filter = "NONE", bool normalized = false);
/// The buffer that packed views lie in, which is not there. `GltfDocument::view` appends to
/// buffers[0] and rewrites the array, so this comes last.
void add_fallback_buffer(GltfDocument& document);
std::vector<glm::vec4> as_vectors(const std::vector<float>& values, std::size_t components);

// Compressed.
void packed_by_meshopt(GltfDocument& document, const char* index_mode);
/// Positions by the exponential filter, normals by the octahedral one.
void filtered_by_meshopt(GltfDocument& document);
void packed_by_draco(GltfDocument& document, bool sequential, int bits);

// Posed in other ways than by two nodes.
void copied(GltfDocument& document);
/// Both copies by EXT_mesh_gpu_instancing, under a node that is moved and moved back by its parent.
/// With `packed` rotations are 16-bit integers in meshoptimizer's filter.
void instanced(GltfDocument& document, bool packed);
/// A skin for each copy: two joints that stand where the copy does, one half as large and bound so.
/// The nodes that show the meshes stand elsewhere, which is to be ignored.
void skinned(GltfDocument& document);
/// Joints without inverse bind matrices, and four more influences a vertex.
void skinned_by_eight(GltfDocument& document);
/// Two targets that bring a bent sheet back, one sparse; the node's weights win over the mesh's.
void morphed(GltfDocument& document);

}  // namespace ppm::test::variants
