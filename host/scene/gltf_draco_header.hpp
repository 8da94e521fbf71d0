// What a Draco stream says of its size, before any of it is unpacked.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace ppm::scene::gltf {

struct DracoSizes {
  std::uint64_t faces = 0;
  std::uint64_t vertices = 0;  ///< that the unpacker makes room for
  std::uint64_t seams = 0;     ///< sets of attributes with connectivity of their own
};

/// Reads the beginning of a Draco 2.2 stream of a mesh, as its specification says; nothing where it
/// is another kind of stream or malformed.
std::optional<DracoSizes> draco_sizes(std::span<const std::uint8_t> stream);

}  // namespace ppm::scene::gltf
