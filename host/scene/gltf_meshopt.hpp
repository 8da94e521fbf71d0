// EXT_meshopt_compression: bufferViews whose bytes are packed by meshoptimizer.
#pragma once

#include "gltf_document.hpp"

namespace ppm::scene::gltf {

/// The unpacked bytes of a compressed bufferView, or nothing where it is not compressed. Throws
/// Failure where its stream is malformed or claims more than a stream of its length can hold.
std::optional<std::vector<std::uint8_t>> unpacked_bytes(const Element<tinygltf::BufferView>& view);

}  // namespace ppm::scene::gltf
