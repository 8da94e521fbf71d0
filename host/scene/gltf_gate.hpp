// What a file must pass before tinygltf sees it, and what tinygltf may read beside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace ppm::scene::gltf {

/// A regular file of at most `limit` bytes. Returns an explanation where that fails, else nothing.
std::string read_file(const std::filesystem::path& file, std::uint64_t limit,
                      std::vector<unsigned char>& bytes);

/// The files that URIs name: those beside or below the glTF file.
class Surroundings {
 public:
  explicit Surroundings(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// As read_file, of a decoded relative URI. All files together hold at most 4 GiB.
  std::string read(const std::string& uri, std::vector<unsigned char>& bytes);

 private:
  std::filesystem::path folder_;
  std::uint64_t budget_ = std::uint64_t{1} << 32;
};

/// What was found out about a document that passed.
struct Survey {
  bool is_binary = false;
  std::map<std::string, std::size_t> lengths;  ///< of the top-level arrays
  std::set<std::string> extensions;            ///< that are used anywhere or declared
};

/// Checks the content of a .gltf or .glb file for what tinygltf would not survive or misread: a
/// container that is cut short, JSON too deep or too large for its recursion and copies, integers
/// that it cuts to 32 bits. Throws Failure naming `file`.
Survey survey(const std::vector<unsigned char>& bytes, const std::string& file);

}  // namespace ppm::scene::gltf
