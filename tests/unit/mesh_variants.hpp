// The same two copies of a mesh, said in the different ways that glTF has for it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "made_document.hpp"

namespace ppm::test {

/// How far what a way of saying a mesh says may lie from what was meant, at most a coordinate.
struct Precision {
  double position = 1e-6;  ///< of the mesh's extent
  double normal = 1e-6;
  double texcoord = 1e-6;
  double color = 1e-6;
};

/// One way of saying it.
struct MeshVariant {
  std::string name;
  /// Writes the file into the folder and returns its name. With `furnish` the document gets
  /// materials, lights and cameras before it is written.
  std::function<std::filesystem::path(const TemporaryFolder&,
                                      const std::function<void(GltfDocument&)>& furnish)>
      write;
  Precision precision;
};

/// The first is the plain one, with which others are to be compared: floats, 32-bit indices and a
/// data URI. Meshes have positions, normals, texture coordinates and colours; they use material 0
/// where `furnish` writes one.
std::vector<MeshVariant> mesh_variants();

}  // namespace ppm::test
