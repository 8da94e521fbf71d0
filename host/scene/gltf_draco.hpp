// KHR_draco_mesh_compression: primitives whose vertices and triangles are packed by Draco.
#pragma once

#include "gltf_accessor.hpp"

namespace ppm::scene::gltf {

/// The unpacked bytes of a primitive. They lie as their accessors say, but tightly packed; what the
/// stream does not hold is not there.
class DracoMesh {
 public:
  /// Nothing where the primitive is not compressed. Throws Failure where its stream is malformed,
  /// does not agree with the accessors, or claims more than a stream of its length is likely to
  /// hold.
  static std::optional<DracoMesh> read(const Element<tinygltf::Primitive>& primitive);

  /// Of the attribute `name`, if it is in the stream.
  std::optional<ByteView> attribute(const std::string& name) const;
  ByteView indices() const { return indices_; }
  /// The accessor that says how they are to be read.
  int index_accessor() const { return index_accessor_; }

 private:
  std::map<std::string, std::vector<std::uint8_t>> attributes_;
  std::vector<std::uint8_t> indices_;
  int index_accessor_ = -1;
};

}  // namespace ppm::scene::gltf
