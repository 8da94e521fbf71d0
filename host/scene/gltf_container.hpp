// The bytes of a .gltf or .glb file and of the files beside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ppm::scene::gltf {

/// A regular file of at most `limit` bytes. Returns an explanation where that fails, else nothing.
std::string read_file(const std::filesystem::path& file, std::uint64_t limit,
                      std::vector<unsigned char>& bytes);

/// The whole of a .gltf or .glb file. Its first bytes and its length must agree with what they
/// claim before the rest is read. Throws Failure.
std::vector<unsigned char> read_container(const std::filesystem::path& file);

/// The files that URIs name: those beside or below the glTF file.
class Surroundings {
 public:
  /// `buffer_lengths`: what the first files to be read must hold at least, and are cut to.
  Surroundings(std::filesystem::path folder, std::vector<std::uint64_t> buffer_lengths)
      : folder_(std::move(folder)), buffer_lengths_(std::move(buffer_lengths)) {}

  /// As read_file, of a decoded relative URI. All files together hold at most 4 GiB.
  std::string read(const std::string& uri, std::vector<unsigned char>& bytes);

 private:
  std::filesystem::path folder_;
  std::vector<std::uint64_t> buffer_lengths_;
  std::size_t files_read_ = 0;
  std::uint64_t budget_ = std::uint64_t{1} << 32;
};

/// Where the JSON of a container stands.
struct JsonText {
  std::string_view text;
  bool is_binary = false;  ///< it is a chunk of a .glb
};

/// Throws Failure naming `file` where `bytes` are no container that is whole, or its JSON is larger
/// than 1 GiB.
JsonText json_text(const std::vector<unsigned char>& bytes, const std::string& file);

}  // namespace ppm::scene::gltf
