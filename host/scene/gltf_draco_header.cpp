#include "gltf_draco_header.hpp"

#include <algorithm>
#include <array>

namespace ppm::scene::gltf {
namespace {

constexpr int kDeepestMetadata = 16;

/// Reads from the front of a stream; what lies past its end is 0 and marks it as cut short.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool is_sound() const { return is_sound_; }
  void fail() { is_sound_ = false; }

  std::uint8_t byte() {
    if (bytes_.empty()) is_sound_ = false;
    if (!is_sound_) return 0;
    const std::uint8_t value = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return value;
  }
  /// Seven bits a byte, the lowest first.
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const std::uint8_t part = byte();
      value |= std::uint64_t{part & 0x7fu} << shift;
      if ((part & 0x80u) == 0) return value;
    }
    is_sound_ = false;
    return 0;
  }
  void skip(std::uint64_t count) {
    if (count > bytes_.size()) is_sound_ = false;
    if (is_sound_) bytes_ = bytes_.subspan(count);
  }

 private:
  std::span<const std::uint8_t> bytes_;
  bool is_sound_ = true;
};

void skip_metadata(Reader& reader, int depth) {
  if (depth > kDeepestMetadata) reader.fail();
  const std::uint64_t entries = reader.varint();
  for (std::uint64_t i = 0; i < entries && reader.is_sound(); ++i) {
    reader.skip(reader.byte());    // its name
    reader.skip(reader.varint());  // its value
  }
  const std::uint64_t children = reader.varint();
  for (std::uint64_t i = 0; i < children && reader.is_sound(); ++i) {
    reader.skip(reader.byte());
    skip_metadata(reader, depth + 1);
  }
}

void skip_all_metadata(Reader& reader) {
  const std::uint64_t attributes = reader.varint();
  for (std::uint64_t i = 0; i < attributes && reader.is_sound(); ++i) {
    reader.varint();  // the attribute's number
    skip_metadata(reader, 0);
  }
  skip_metadata(reader, 0);
}

DracoSizes edgebreaker_sizes(Reader& reader) {
  DracoSizes sizes;
  reader.byte();  // how faces are traversed
  sizes.vertices = reader.varint();
  sizes.faces = reader.varint();
  sizes.seams = reader.byte();
  const std::uint64_t symbols = reader.varint();
  const std::uint64_t splits = reader.varint();
  sizes.vertices += splits;
  if (symbols > sizes.faces || splits > symbols) reader.fail();
  return sizes;
}

}  // namespace

std::optional<DracoSizes> draco_sizes(std::span<const std::uint8_t> stream) {
  constexpr std::array<std::uint8_t, 8> kStart{'D', 'R', 'A', 'C', 'O', 2, 2, 1};  // 2.2, a mesh
  if (stream.size() < 11 || !std::equal(kStart.begin(), kStart.end(), stream.begin())) {
    return std::nullopt;
  }
  const std::uint8_t method = stream[8];
  const bool has_metadata = (stream[10] & 0x80u) != 0;
  Reader reader(stream.subspan(11));
  if (has_metadata) skip_all_metadata(reader);
  DracoSizes sizes;
  if (method == 0) {  // sequential
    sizes.faces = reader.varint();
    sizes.vertices = reader.varint();
  } else if (method == 1) {
    sizes = edgebreaker_sizes(reader);
  } else {
    return std::nullopt;
  }
  // Three corners a face: more vertices than that have none.
  if (!reader.is_sound() || sizes.vertices > 6 * sizes.faces) return std::nullopt;
  return sizes;
}

}  // namespace ppm::scene::gltf
