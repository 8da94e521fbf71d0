// How libFuzzer changes inputs: the container stays sound most of the time, so that mutations reach
// what lies in it.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "json_mutations.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace ppm::fuzz {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

/// The parts of a .glb; a .gltf has no `binary`.
struct Parts {
  bool is_glb = false;
  std::string text;
  Bytes binary;
};

std::uint32_t word(const std::uint8_t* at) {
  std::uint32_t value = 0;
  std::memcpy(&value, at, sizeof value);
  return value;
}

Parts parts_of(const std::uint8_t* data, std::size_t size) {
  if (size < 20 || std::memcmp(data, "glTF", 4) != 0) {
    return {false, std::string(reinterpret_cast<const char*>(data), size), {}};
  }
  const std::size_t length = std::min<std::size_t>(word(data + 12), size - 20);
  Parts parts{true, std::string(reinterpret_cast<const char*>(data) + 20, length), {}};
  const std::size_t binary = std::min(20 + length + 8, size);
  parts.binary.assign(data + binary, data + size);
  return parts;
}

void put_word(Bytes& out, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) {
    out.push_back(static_cast<std::uint8_t>(value >> shift & 0xffu));
  }
}

Bytes joined(Parts parts) {
  Bytes out;
  if (parts.is_glb) {
    while (parts.text.size() % 4 != 0) parts.text += ' ';
    while (parts.binary.size() % 4 != 0) parts.binary.push_back(0);
    out = {'g', 'l', 'T', 'F', 2, 0, 0, 0};
    put_word(out, 28 + parts.text.size() + parts.binary.size());
    put_word(out, parts.text.size());
    out.insert(out.end(), {'J', 'S', 'O', 'N'});
  }
  out.insert(out.end(), parts.text.begin(), parts.text.end());
  if (parts.is_glb) {
    put_word(out, parts.binary.size());
    out.insert(out.end(), {'B', 'I', 'N', 0});
    out.insert(out.end(), parts.binary.begin(), parts.binary.end());
  }
  return out;
}

/// CRC-32 of PNG (ISO 3309).
std::uint32_t crc32(const std::uint8_t* bytes, std::size_t size) {
  std::uint32_t crc = 0xffffffffu;
  for (std::size_t i = 0; i < size; ++i) {
    crc ^= bytes[i];
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

std::uint32_t big_word(const std::uint8_t* at) {
  return std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8 |
         at[3];
}

/// Rights the checksums of all PNG files in `bytes`, without which decoders look no further.
void mend_pngs(Bytes& bytes) {
  constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  auto found = std::search(bytes.begin(), bytes.end(), kMagic.begin(), kMagic.end());
  while (found != bytes.end()) {
    std::size_t at = static_cast<std::size_t>(found - bytes.begin()) + kMagic.size();
    while (at + 12 <= bytes.size()) {
      const std::size_t length = big_word(&bytes[at]);
      if (length > bytes.size() - at - 12) break;
      const std::uint32_t crc = crc32(&bytes[at + 4], length + 4);
      for (std::size_t i = 0; i < 4; ++i) {
        bytes[at + 8 + length + i] = static_cast<std::uint8_t>(crc >> (24 - 8 * i) & 0xffu);
      }
      at += 12 + length;
    }
    found = std::search(found + 1, bytes.end(), kMagic.begin(), kMagic.end());
  }
}

std::string text_of(const json& document) {
  return document.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// By libFuzzer's own means: bits, bytes, numbers, what comparisons were seen with.
template <typename Container>
void scramble(Container& bytes, std::size_t max_size) {
  const std::size_t room = std::min(max_size, bytes.size() + 64);
  const std::size_t size = bytes.size();
  bytes.resize(room);
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, room));
}

bool bend_text(std::string& text, std::minstd_rand& random) {
  json document = json::parse(text, nullptr, false);
  if (document.is_discarded()) return false;
  for (std::size_t count = 1 + random() % 3; count > 0; --count) bend(document, random);
  text = text_of(document);
  return true;
}

std::size_t put(const Parts& parts, std::uint8_t* data, std::size_t max_size) {
  const Bytes bytes = joined(parts);
  if (bytes.size() > max_size) return 0;
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}

}  // namespace
}  // namespace ppm::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  using namespace ppm::fuzz;
  std::minstd_rand random(seed);
  const std::size_t choice = random() % 20;
  if (choice == 0) return LLVMFuzzerMutate(data, size, max_size);
  Parts parts = parts_of(data, size);
  if (choice == 1 || (choice < 7 && parts.binary.empty())) {
    scramble(parts.text, max_size);
  } else if (choice < 7) {
    scramble(parts.binary, max_size);
    if (random() % 4 != 0) mend_pngs(parts.binary);
  } else if (!bend_text(parts.text, random)) {
    scramble(parts.text, max_size);
  }
  const std::size_t result = put(parts, data, max_size);
  return result != 0 ? result : LLVMFuzzerMutate(data, size, max_size);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* one, std::size_t one_size,
                                                 const std::uint8_t* two, std::size_t two_size,
                                                 std::uint8_t* out, std::size_t max_size,
                                                 unsigned seed) {
  using namespace ppm::fuzz;
  std::minstd_rand random(seed);
  Parts parts = parts_of(one, one_size);
  const Parts other = parts_of(two, two_size);
  if (random() % 4 == 0) {
    parts.binary = other.binary;
  } else {
    json document = json::parse(parts.text, nullptr, false);
    const json donor = json::parse(other.text, nullptr, false);
    if (document.is_discarded() || donor.is_discarded()) return 0;
    graft(document, donor, random);
    parts.text = text_of(document);
  }
  return put(parts, out, max_size);
}
