#include "sealed_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>

#define XXH_INLINE_ALL  // no library to be there where the program runs
#include <xxhash.h>

#include "failure.hpp"
#include "machine_memory.hpp"
#include "output_file.hpp"

namespace ppm {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they are");

constexpr std::size_t kMagicBytes = 24, kSealBytes = sizeof(XXH128_canonical_t);
constexpr std::size_t kPieceBytes = std::size_t{1} << 20;
constexpr const char* kOther = "name another file";
constexpr const char* kLost = "use another one or render anew";

std::size_t head_bytes(const SealedKind& kind) {
  return kMagicBytes + 2 * sizeof(std::uint32_t) + kind.sections * sizeof(std::uint64_t);
}

template <class T>
void append(std::string& text, T value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof value);
}

class Seal {
 public:
  Seal() { XXH3_128bits_reset(state_.get()); }
  void add(std::string_view bytes) {
    XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
  }
  std::string value() const {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_.get()));
    return {reinterpret_cast<const char*>(canonical.digest), sizeof canonical.digest};
  }

 private:
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state_{XXH3_createState()};
};

}  // namespace

void write_sealed(const std::filesystem::path& file, const SealedKind& kind,
                  std::span<const std::string_view> sections) {
  PPM_ASSERT(sections.size() == kind.sections, std::to_string(sections.size()));
  std::string head(kind.magic.data(), kind.magic.size());
  append(head, kind.version);
  append(head, kind.sections);
  for (const std::string_view section : sections) append(head, std::uint64_t{section.size()});

  Seal seal;
  seal.add(head);
  for (const std::string_view section : sections) seal.add(section);
  const std::string value = seal.value();
  std::vector<std::string_view> pieces{head};
  pieces.insert(pieces.end(), sections.begin(), sections.end());
  pieces.push_back(value);
  write_whole(file, pieces);
}

SealedFile::SealedFile(const std::filesystem::path& file, const SealedKind& kind) : file_(file) {
  // Without O_NONBLOCK opening a pipe would wait for its other end.
  descriptor_ = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) refuse(std::generic_category().message(errno), kOther);
  try {
    struct stat status {};
    if (fstat(descriptor_, &status) != 0) refuse(std::generic_category().message(errno), kOther);
    if (!S_ISREG(status.st_mode)) {
      refuse(S_ISDIR(status.st_mode) ? "is a folder" : "is not a regular file", kOther);
    }
    const auto file_size = static_cast<std::uint64_t>(status.st_size);
    check_head(kind, file_size);
    check_seal(file_size);
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

SealedFile::~SealedFile() {
  close(descriptor_);
}

void SealedFile::check_head(const SealedKind& kind, std::uint64_t file_size) {
  const std::string no_such = "is no " + std::string(kind.name);
  std::string head(std::min<std::uint64_t>(file_size, head_bytes(kind)), '\0');
  read_at(0, head.data(), head.size());
  const std::size_t magic_bytes = std::min(head.size(), kMagicBytes);
  if (head.empty() || std::memcmp(head.data(), kind.magic.data(), magic_bytes) != 0) {
    refuse(no_such, kOther);
  }
  const char* const cut = "is cut short";
  if (head.size() < kMagicBytes + 2 * sizeof(std::uint32_t)) refuse(cut, kLost);
  std::uint32_t version = 0, sections = 0;
  std::memcpy(&version, &head[kMagicBytes], sizeof version);
  std::memcpy(&sections, &head[kMagicBytes + sizeof version], sizeof sections);
  if (version != kind.version) {
    refuse("is a " + std::string(kind.name) + " of version " + std::to_string(version) +
               ", this program reads version " + std::to_string(kind.version),
           "use the program that wrote it or render anew");
  }
  if (sections != kind.sections) refuse("is damaged", kLost);
  if (head.size() < head_bytes(kind)) refuse(cut, kLost);
  sizes_.resize(kind.sections);
  std::memcpy(sizes_.data(), &head[kMagicBytes + 2 * sizeof(std::uint32_t)],
              kind.sections * sizeof sizes_[0]);

  std::uint64_t left = file_size - head_bytes(kind);
  for (const std::uint64_t size : sizes_) {
    if (size > left) refuse(cut, kLost);
    left -= size;
  }
  if (left < kSealBytes) refuse(cut, kLost);
  if (left > kSealBytes) refuse("is longer than it says", kLost);
}

void SealedFile::check_seal(std::uint64_t file_size) const {
  Seal seal;
  std::string piece;
  const std::uint64_t sealed = file_size - kSealBytes;
  for (std::uint64_t at = 0; at < sealed; at += piece.size()) {
    piece.resize(std::min<std::uint64_t>(kPieceBytes, sealed - at));
    read_at(at, piece.data(), piece.size());
    seal.add(piece);
  }
  std::string written(kSealBytes, '\0');
  read_at(sealed, written.data(), written.size());
  if (written != seal.value()) refuse("is damaged: it does not match its checksum", kLost);
}

std::vector<std::uint8_t> SealedFile::read(std::size_t section) const {
  std::uint64_t offset =
      kMagicBytes + 2 * sizeof(std::uint32_t) + sizes_.size() * sizeof(std::uint64_t);
  for (std::size_t i = 0; i < section; ++i) offset += sizes_[i];
  if (sizes_[section] > available_memory()) {
    refuse("is larger than the memory the machine has left", "free some memory");
  }
  std::vector<std::uint8_t> bytes(sizes_[section]);
  read_at(offset, bytes.data(), bytes.size());
  return bytes;
}

void SealedFile::read_at(std::uint64_t offset, void* data, std::size_t size) const {
  auto* bytes = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t count = pread(descriptor_, bytes, size, static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse(std::generic_category().message(errno), kOther);
    if (count == 0) refuse("became shorter while it was read", kLost);
    bytes += count;
    offset += static_cast<std::uint64_t>(count);
    size -= static_cast<std::size_t>(count);
  }
}

void SealedFile::refuse(std::string_view what, std::string_view remedy) const {
  throw Failure(file_.string(), "", what, remedy);
}

}  // namespace ppm
