#include "gltf_container.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <span>

#include "failure.hpp"
#include "input_file.hpp"

namespace ppm::scene::gltf {
namespace {

constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
constexpr std::uint64_t kLargestFile = (std::uint64_t{1} << 32) - 16;  // tinygltf counts in 32 bits
constexpr std::uint64_t kLargestText = std::uint64_t{1} << 30;
constexpr const char* kNameAnother = "name a .gltf or .glb file that you may read";

using Bytes = std::span<const unsigned char>;

std::uint32_t word(Bytes bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);  // little-endian, as the hosts of Vulkan
  return value;
}

[[noreturn]] void fail_glb(const std::string& file, const std::string& what) {
  throw Failure(file, "", what, "export or copy the file again");
}

/// The length that the chunk at `at` claims, which must lie before `end`.
std::uint32_t chunk_length(Bytes bytes, std::size_t at, std::size_t end, const std::string& file) {
  const std::uint32_t length = word(bytes, at);
  const std::size_t left = end - at - kChunkHeaderBytes;
  if (length <= left) return length;
  fail_glb(file, "the .glb is cut short: a chunk claims " + std::to_string(length) + " bytes, " +
                     std::to_string(left) + " are left");
}

bool is_glb(Bytes head) {
  constexpr std::array<unsigned char, 4> kMagic{'g', 'l', 'T', 'F'};
  return head.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), head.begin());
}

/// The first bytes of a file of `file_size` bytes: is it a glTF file at all, and as long as it
/// says?
void check_head(Bytes head, std::uint64_t file_size, const std::string& file) {
  if (!is_glb(head)) {
    constexpr std::string_view kBlank = " \t\r\n\xef\xbb\xbf";
    const auto first = std::ranges::find_if(
        head, [&](unsigned char c) { return kBlank.find(static_cast<char>(c)) == kBlank.npos; });
    if (first == head.end() ? head.size() == file_size : *first != '{') {
      throw Failure(file, "", "is neither a .gltf (JSON) nor a .glb file",
                    "export the scene as glTF 2.0");
    }
    if (file_size > kLargestText) {
      throw Failure(file, "", "its JSON is larger than 1 GiB", "put the data into buffers");
    }
    return;
  }
  if (head.size() < kHeaderBytes + kChunkHeaderBytes) {
    fail_glb(file, "the .glb ends within its header");
  }
  if (word(head, 4) != 2) {
    throw Failure(file, "", "is a .glb of version " + std::to_string(word(head, 4)),
                  "export it as glTF 2.0");
  }
  const std::uint32_t size = word(head, 8);
  if (size < kHeaderBytes + kChunkHeaderBytes || size > file_size) {
    fail_glb(file, "the .glb is cut short: its header claims " + std::to_string(size) +
                       " bytes, the file has " + std::to_string(file_size));
  }
  if (word(head, 16) != 0x4e4f534a) fail_glb(file, "the first chunk of the .glb is not JSON");
}

/// The JSON chunk of a .glb. The chunk behind it is checked, too: tinygltf 2.7.0 forgets its header
/// when it compares lengths.
std::string_view json_chunk(const std::vector<unsigned char>& bytes, const std::string& file) {
  constexpr std::size_t kStart = kHeaderBytes + kChunkHeaderBytes;
  const std::uint32_t size = word(bytes, 8);
  const std::uint32_t length = chunk_length(bytes, kHeaderBytes, size, file);
  const std::size_t next = kStart + length;
  if (next + kChunkHeaderBytes <= size) chunk_length(bytes, next, size, file);
  return {reinterpret_cast<const char*>(bytes.data()) + kStart, length};
}

bool leads_outside(const std::filesystem::path& path) {
  return path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end();
}

/// Opens what read_file reads. Returns an explanation or nothing.
std::string open_file(const std::filesystem::path& file, std::uint64_t limit, std::ifstream& stream,
                      std::uint64_t& size) {
  const std::string error = why_unreadable(file);
  if (!error.empty()) return error;
  std::error_code code;
  stream.open(file, std::ios::binary);
  size = std::filesystem::file_size(file, code);
  if (!stream || code) return "cannot be opened for reading";
  return size > limit ? "is too large" : "";
}

std::string read_to_end(std::ifstream& stream, std::uint64_t size,
                        std::vector<unsigned char>& bytes) {
  bytes.resize(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  return static_cast<std::uint64_t>(stream.gcount()) == size ? "" : "cannot be read to its end";
}

}  // namespace

std::string read_file(const std::filesystem::path& file, std::uint64_t limit,
                      std::vector<unsigned char>& bytes) {
  std::ifstream stream;
  std::uint64_t size = 0;
  const std::string error = open_file(file, limit, stream, size);
  return error.empty() ? read_to_end(stream, size, bytes) : error;
}

std::vector<unsigned char> read_container(const std::filesystem::path& file) {
  std::ifstream stream;
  std::uint64_t size = 0;
  std::string error = open_file(file, kLargestFile, stream, size);
  if (!error.empty()) throw Failure(file.string(), "", error, kNameAnother);
  std::array<unsigned char, 4096> head{};
  stream.read(reinterpret_cast<char*>(head.data()), head.size());
  const auto head_size = static_cast<std::size_t>(stream.gcount());
  check_head(Bytes(head).first(head_size), size, file.string());
  stream.clear();
  stream.seekg(0);
  std::vector<unsigned char> bytes;
  error = read_to_end(stream, size, bytes);
  if (!error.empty()) throw Failure(file.string(), "", error, kNameAnother);
  return bytes;
}

std::string Surroundings::read(const std::string& uri, std::vector<unsigned char>& bytes) {
  if (uri.find('\0') != std::string::npos) return "is not a file name";
  if (uri.substr(0, uri.find('/')).find(':') != std::string::npos) {
    return "has a scheme; only files beside the glTF file and base64 data URIs are read";
  }
  const std::filesystem::path path(uri);
  if (leads_outside(path) || uri.find('\\') != std::string::npos) {
    return "leads outside the folder of the glTF file";
  }
  const std::string error = read_file(folder_ / path, budget_, bytes);
  if (!error.empty()) return error;
  budget_ -= bytes.size();
  const std::size_t position = files_read_++;
  if (position >= buffer_lengths_.size()) return "";
  const std::uint64_t length = buffer_lengths_[position];
  if (bytes.size() < length) {
    return "has " + std::to_string(bytes.size()) + " bytes, but byteLength claims " +
           std::to_string(length);
  }
  bytes.resize(length);
  return "";
}

JsonText json_text(const std::vector<unsigned char>& bytes, const std::string& file) {
  check_head(bytes, bytes.size(), file);
  const bool is_binary = is_glb(bytes);
  const std::string_view text =
      is_binary ? json_chunk(bytes, file)
                : std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first == std::string_view::npos || text[first] != '{') {
    fail_glb(file, "the JSON of the .glb is no object");
  }
  if (text.size() > kLargestText) {
    throw Failure(file, "", "its JSON is larger than 1 GiB", "put the data into buffers");
  }
  return {text, is_binary};
}

}  // namespace ppm::scene::gltf
