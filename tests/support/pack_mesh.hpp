// Meshes packed by the libraries that the loader unpacks them with.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

namespace ppm::test {

/// Elements of `stride` bytes as a stream of EXT_meshopt_compression; `mode` as there. Filters are
/// up to the caller.
std::vector<std::uint8_t> meshopt_packed(const std::vector<std::uint8_t>& bytes, std::size_t stride,
                                         const std::string& mode);

/// Vectors filtered by meshoptimizer to `stride` bytes each, for the filter of that name: unit
/// vectors (OCTAHEDRAL), unit quaternions (QUATERNION) or any (EXPONENTIAL, stride / 4 components).
std::vector<std::uint8_t> meshopt_filtered(const std::vector<glm::vec4>& values, std::size_t stride,
                                           const std::string& filter);

/// A mesh to be packed by Draco.
struct DracoInput {
  std::map<std::string, std::vector<float>> attributes;  ///< by glTF's name
  std::map<std::string, int> components;                 ///< of each of them
  std::vector<std::uint32_t> indices;
};

struct DracoOutput {
  std::vector<std::uint8_t> stream;
  std::map<std::string, int> attributes;  ///< numbers in the stream
  std::size_t vertices = 0, triangles = 0;
};

/// Positions and the rest are quantised to `bits` bits, or kept where 0.
DracoOutput draco_packed(const DracoInput& input, bool sequential, int bits);

}  // namespace ppm::test
