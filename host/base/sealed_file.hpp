// Files of several sections under one checksum: whoever reads one reads what was written, or is
// told why not.
//
//   24 bytes  magic, the kind's
//    4        version, the kind's
//    4        number of sections
//    8 each   their sizes in bytes
//             the sections, one after the other
//   16        XXH3, 128 bits, of all before
//
// Numbers are little-endian.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace ppm {

struct SealedKind {
  std::string_view name;         ///< in messages: "checkpoint of ppm-vk"
  std::array<char, 24> magic{};  ///< no other kind of file begins so
  std::uint32_t version = 1;     ///< of what the sections mean
  std::uint32_t sections = 1;    ///< as many as files of this version have
};

/// Writes it whole or not at all, as write_whole does.
void write_sealed(const std::filesystem::path& file, const SealedKind& kind,
                  std::span<const std::string_view> sections);

/// A sealed file that was found sound when it was opened.
class SealedFile {
 public:
  /// Throws Failure where the file cannot be read, is of another kind or version, is cut short or
  /// longer than it says, or does not match its checksum. Needs a megabyte, whatever the file
  /// claims.
  SealedFile(const std::filesystem::path& file, const SealedKind& kind);
  ~SealedFile();
  SealedFile(const SealedFile&) = delete;
  SealedFile& operator=(const SealedFile&) = delete;

  std::uint64_t size(std::size_t section) const { return sizes_[section]; }
  /// Throws Failure where the machine's memory does not hold it.
  std::vector<std::uint8_t> read(std::size_t section) const;

 private:
  void read_at(std::uint64_t offset, void* data, std::size_t size) const;
  void check_head(const SealedKind& kind, std::uint64_t file_size);
  void check_seal(std::uint64_t file_size) const;
  [[noreturn]] void refuse(std::string_view what, std::string_view remedy) const;

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::vector<std::uint64_t> sizes_;
};

}  // namespace ppm
