// The bytes of a glTF file: its container, the buffers and images it refers to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "gltf_json.hpp"

namespace ppm::scene::gltf {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// A .gltf or .glb file as read. The views point into `bytes`; moving the struct keeps them valid.
struct Container {
  Bytes bytes;
  std::string_view json;
  std::optional<ByteView> binary;  ///< the BIN chunk of a .glb
};

/// Reads the whole file and, for a .glb (told by its first bytes, not its name), finds the chunks.
/// Throws Failure where the file cannot be read or is cut short.
Container read_container(const std::filesystem::path& file);

/// The document's buffers, each loaded when first asked for.
class Buffers {
 public:
  /// `binary` is the .glb's BIN chunk; `folder` is where relative URIs start.
  Buffers(std::optional<ByteView> binary, std::filesystem::path folder)
      : binary_(binary), folder_(std::move(folder)) {}

  /// The bytes of a bufferView, in bounds. They stay valid as long as this object.
  ByteView view(const Element& buffer_view);
  /// The bytes that a "uri" member stands for: a data URI, or a file beside or below the glTF file.
  /// Reads at most `limit` bytes. Throws Failure for URIs that lead elsewhere.
  Bytes load_uri(const Element& uri, std::uint64_t limit) const;

 private:
  ByteView buffer(std::uint32_t index, const Element& element);

  std::optional<ByteView> binary_;
  std::filesystem::path folder_;
  std::map<std::uint32_t, Bytes> loaded_;
};

}  // namespace ppm::scene::gltf
