#include "gltf_container.hpp"

#include <algorithm>
#include <array>
#include <fstream>

#include "failure.hpp"

namespace ppm::scene::gltf {
namespace {

constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;
// What a .glb can hold; sparse files would otherwise claim any amount of memory.
constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 32;
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004e4942;  // "BIN\0"

/// The first `limit` bytes of a regular file, or all. An error is an explanation.
std::optional<Bytes> read_file(const std::filesystem::path& file, std::uint64_t limit,
                               std::string& error) {
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) {
    error = "there is no such file";
    return std::nullopt;
  }
  if (!std::filesystem::is_regular_file(status)) {
    error = "is not a regular file";
    return std::nullopt;
  }
  std::ifstream stream(file, std::ios::binary);
  const std::uint64_t size = std::filesystem::file_size(file, code);
  if (!stream || code) {
    error = "cannot be opened for reading";
    return std::nullopt;
  }
  if (size > kLargestFile) {
    error = "is larger than 4 GiB";
    return std::nullopt;
  }
  Bytes bytes(std::min(size, limit));
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::uint64_t>(stream.gcount()) != bytes.size()) {
    error = "cannot be read to its end";
    return std::nullopt;
  }
  return bytes;
}

std::uint32_t little_endian(ByteView bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 16 |
         static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

std::string_view as_text(ByteView bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

[[noreturn]] void fail_glb(const std::string& file, const std::string& what) {
  throw Failure(file, "", what, "export or copy the file again");
}

/// One chunk of a .glb; `rest` moves behind it.
struct Chunk {
  std::uint32_t type;
  ByteView data;
};

Chunk take_chunk(ByteView& rest, const std::string& file) {
  if (rest.size() < kChunkHeaderBytes) fail_glb(file, "the .glb ends within a chunk header");
  const std::uint32_t length = little_endian(rest, 0);
  const std::uint32_t type = little_endian(rest, 4);
  rest = rest.subspan(kChunkHeaderBytes);
  if (length > rest.size()) {
    fail_glb(file, "the .glb is cut short: a chunk claims " + std::to_string(length) + " bytes, " +
                       std::to_string(rest.size()) + " are left");
  }
  const Chunk chunk{type, rest.first(length)};
  // Writers that do not pad the last chunk to four bytes are forgiven.
  rest =
      rest.subspan(std::min<std::size_t>(rest.size(), (length + std::size_t{3}) & ~std::size_t{3}));
  return chunk;
}

void find_chunks(Container& container, const std::string& file) {
  ByteView all = container.bytes;
  if (all.size() < kHeaderBytes) fail_glb(file, "the .glb ends within its header");
  const std::uint32_t version = little_endian(all, 4);
  if (version != 2) {
    throw Failure(file, "", "is a .glb of version " + std::to_string(version),
                  "export it as glTF 2.0");
  }
  const std::uint32_t length = little_endian(all, 8);
  if (length < kHeaderBytes || length > all.size()) {
    fail_glb(file, "the .glb is cut short: its header claims " + std::to_string(length) +
                       " bytes, the file has " + std::to_string(all.size()));
  }
  ByteView rest = all.subspan(kHeaderBytes, length - kHeaderBytes);
  const Chunk first = take_chunk(rest, file);
  if (first.type != kJsonChunk) fail_glb(file, "the first chunk of the .glb is not JSON");
  container.json = as_text(first.data);
  while (!rest.empty() && !container.binary) {
    const Chunk chunk = take_chunk(rest, file);
    if (chunk.type == kBinaryChunk) container.binary = chunk.data;
  }
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// Resolves %XX. Nothing where such a sequence is malformed.
std::optional<std::string> percent_decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      result += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    const int high = hex_digit(text[i + 1]), low = hex_digit(text[i + 2]);
    if (high < 0 || low < 0) return std::nullopt;
    result += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return result;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  if (c == '/') return 63;
  return -1;
}

/// RFC 4648, section 4, padding optional. Nothing where it is malformed.
std::optional<Bytes> base64_decoded(std::string_view text) {
  for (int padding = 0; padding < 2 && text.ends_with('='); ++padding) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  Bytes bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit < 0) return std::nullopt;
    bits = (bits << 6 | static_cast<std::uint32_t>(digit)) & 0xffffu;
    bit_count += 6;
    if (bit_count >= 8) {
      bit_count -= 8;
      bytes.push_back(static_cast<std::uint8_t>(bits >> bit_count & 0xffu));
    }
  }
  return bytes;
}

Bytes decode_data_uri(const Element& uri) {
  const std::string_view text = uri.text();
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || !text.substr(0, comma).ends_with(";base64")) {
    uri.fail("is not a base64 data URI", "write data:application/octet-stream;base64,...");
  }
  std::optional<Bytes> bytes = base64_decoded(text.substr(comma + 1));
  if (!bytes) uri.fail("has malformed base64", "encode it again");
  return std::move(*bytes);
}

/// The path below the glTF file's folder that a relative URI names.
std::filesystem::path relative_path(const Element& uri) {
  const std::optional<std::string> decoded = percent_decoded(uri.text());
  if (!decoded || decoded->empty() || decoded->find('\0') != std::string::npos) {
    uri.fail("is not a file name", "write a relative path such as \"textures/wood.png\"");
  }
  const std::size_t colon = decoded->find(':');
  if (colon != std::string::npos && decoded->find('/') > colon) {
    uri.fail("\"" + printable(*decoded) + "\" has a scheme",
             "only files beside the glTF file and data URIs are read");
  }
  const std::filesystem::path path(*decoded);
  const bool climbs = std::find(path.begin(), path.end(), "..") != path.end();
  if (climbs || path.is_absolute() || decoded->find('\\') != std::string::npos) {
    uri.fail("\"" + printable(*decoded) + "\" leads outside the folder of the file",
             "put the data beside the glTF file or below");
  }
  return path;
}

}  // namespace

Container read_container(const std::filesystem::path& file) {
  std::string error;
  std::optional<Bytes> bytes = read_file(file, std::numeric_limits<std::uint64_t>::max(), error);
  if (!bytes)
    throw Failure(file.string(), "", error, "name a .gltf or .glb file that you may read");
  Container container{std::move(*bytes), {}, {}};
  const std::string_view text = as_text(container.bytes);
  if (text.starts_with("glTF")) {
    find_chunks(container, file.string());
    return container;
  }
  const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  if (first == std::string_view::npos || text[first] != '{') {
    throw Failure(file.string(), "", "is neither a .gltf (JSON) nor a .glb file",
                  "export the scene as glTF 2.0");
  }
  container.json = text;
  return container;
}

Bytes Buffers::load_uri(const Element& uri, std::uint64_t limit) const {
  if (uri.text().starts_with("data:")) return decode_data_uri(uri);
  const std::filesystem::path path = relative_path(uri);
  std::string error;
  std::optional<Bytes> bytes = read_file(folder_ / path, limit, error);
  if (!bytes) {
    uri.fail("\"" + printable(path.string()) + "\": " + error, "put the file beside the glTF file");
  }
  return std::move(*bytes);
}

ByteView Buffers::buffer(std::uint32_t index, const Element& element) {
  const std::uint64_t length = element.require("byteLength").whole();
  const std::optional<Element> uri = element.find("uri");
  ByteView bytes;
  if (uri) {
    auto found = loaded_.find(index);
    if (found == loaded_.end()) found = loaded_.emplace(index, load_uri(*uri, length)).first;
    bytes = found->second;
  } else if (index == 0 && binary_) {
    bytes = *binary_;
  } else {
    element.fail("has neither a uri nor a chunk of a .glb", "add the data");
  }
  if (bytes.size() < length) {
    element.fail(
        "claims " + std::to_string(length) + " bytes but has " + std::to_string(bytes.size()),
        "the data was cut short: export or copy it again");
  }
  return bytes.first(length);
}

ByteView Buffers::view(const Element& buffer_view) {
  const std::uint32_t index = buffer_view.index("buffer", "buffers");
  const ByteView bytes = buffer(index, buffer_view.follow("buffer", "buffers"));
  const std::uint64_t offset = buffer_view.whole_or("byteOffset", 0);
  const std::uint64_t length = buffer_view.require("byteLength").whole();
  if (offset > bytes.size() || length > bytes.size() - offset) {
    buffer_view.fail("ends at byte " + std::to_string(offset + length) + " of a buffer of " +
                         std::to_string(bytes.size()),
                     "correct byteOffset and byteLength");
  }
  return bytes.subspan(offset, length);
}

}  // namespace ppm::scene::gltf
