// The container of checkpoints: what is not to the last byte what was written is refused.
#include "sealed_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "failure.hpp"
#include "temporary_folder.hpp"

namespace ppm {
namespace {

using test::file_text;
using test::TemporaryFolder;
using test::write_text;

constexpr SealedKind kKind{"thing", {'a', ' ', 't', 'h', 'i', 'n', 'g', '\r', '\n'}, 3, 3};

class Sealed : public ::testing::Test {
 protected:
  /// Why `bytes` are no thing; empty: they are one.
  std::string refusal(const std::string& bytes) const {
    write_text(folder_ / "f", bytes);
    return refusal_of(folder_ / "f");
  }
  static std::string refusal_of(const std::filesystem::path& file) {
    try {
      const SealedFile sealed(file, kKind);
    } catch (const Failure& failure) {
      return failure.what();
    }
    return "";
  }
  std::string written(const std::vector<std::string_view>& sections) const {
    write_sealed(folder_ / "w", kKind, sections);
    return file_text(folder_ / "w");
  }
  static std::string text(const std::vector<std::uint8_t>& bytes) {
    return {bytes.begin(), bytes.end()};
  }

  TemporaryFolder folder_;
};

TEST_F(Sealed, GivesBackWhatWasWritten) {
  // More than one piece of a megabyte is read at a time, and sections may be empty.
  const std::string large(2500001, '\x7f'), odd("\0\n\xff", 3);
  const std::vector<std::vector<std::string_view>> cases = {
      {"", "", ""}, {"x", odd, ""}, {"", large, "end"}};
  for (const auto& sections : cases) {
    EXPECT_EQ(refusal(written(sections)), "");
    const SealedFile sealed(folder_ / "f", kKind);
    for (std::size_t i = 0; i < sections.size(); ++i) {
      EXPECT_EQ(sealed.size(i), sections[i].size());
      EXPECT_EQ(text(sealed.read(i)), sections[i]);
    }
  }
}

// The layout that the header promises, byte by byte; the checksum is what Debian's xxh128sum says
// of the bytes before it.
TEST_F(Sealed, HasTheLayoutThatIsWrittenDown) {
  const std::string bytes = written({"ab", "", "c"});
  ASSERT_EQ(bytes.size(), 24 + 4 + 4 + 3 * 8 + 3 + 16u);
  std::string expected("a thing\r\n");
  expected.resize(24, '\0');
  const auto number = [&](std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) expected.push_back(static_cast<char>(value >> (8 * i)));
  };
  number(3, 4);
  number(3, 4);
  for (const std::uint64_t size : {2, 0, 1}) number(size, 8);
  expected += "abc";
  EXPECT_EQ(bytes.substr(0, expected.size()), expected);
  std::string seal;
  for (const char byte : bytes.substr(expected.size())) {
    constexpr const char* kDigits = "0123456789abcdef";
    seal.push_back(kDigits[static_cast<unsigned char>(byte) >> 4]);
    seal.push_back(kDigits[byte & 15]);
  }
  EXPECT_EQ(seal, "0a22550186d321d4d0b1cb6abc5c1371");
}

TEST_F(Sealed, EveryTruncationIsRefused) {
  const std::string bytes = written({"abc", "", "defgh"});
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string why = refusal(bytes.substr(0, size));
    EXPECT_NE(why.find(size == 0 ? "is no thing" : "is cut short"), std::string::npos)
        << size << " " << why;
  }
  EXPECT_NE(refusal(bytes + "x").find("longer than it says"), std::string::npos);
}

TEST_F(Sealed, EveryFlippedBitIsRefused) {
  const std::string bytes = written({"abc", "", "defgh"});
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string other = bytes;
      other[at] = static_cast<char>(other[at] ^ (1 << bit));
      const std::string why = refusal(other);
      const char* const expected = at < 24   ? "is no thing"
                                   : at < 28 ? "of version"
                                   : at < 56 ? "is "  // damaged, cut short, longer
                                             : "checksum";
      EXPECT_NE(why.find(expected), std::string::npos) << at << " " << bit << " " << why;
    }
  }
}

// Sizes that add up to the file's by wrapping around, and others that no machine has.
TEST_F(Sealed, LiesAboutSizesAreRefused) {
  const std::string bytes = written({"abc", "", "defgh"});
  const std::vector<std::vector<std::uint64_t>> lies = {
      {~0ull, 4, 5}, {3, ~0ull, 6}, {1ull << 63, 1ull << 63, 8}, {1ull << 40, 0, 5}, {9, 0, 0},
      {8, 0, 0},     {0, 0, 8}};
  for (const auto& sizes : lies) {
    std::string other = bytes;
    std::memcpy(&other[32], sizes.data(), 3 * sizeof sizes[0]);
    EXPECT_NE(refusal(other), "") << testing::PrintToString(sizes);
  }
}

// Whatever is cut out, put in, doubled or set, by chance but always the same.
TEST_F(Sealed, RandomMutationsAreRefused) {
  const std::string bytes = written({"some words", std::string_view("\0\0\0\0", 4), "a state"});
  std::mt19937 random(1);
  const auto below = [&](std::size_t most) {
    return std::uniform_int_distribution<std::size_t>(0, most - 1)(random);
  };
  for (int round = 0; round < 2000; ++round) {
    std::string other = bytes;
    for (std::size_t changes = 1 + below(4); changes > 0 && !other.empty(); --changes) {
      const std::size_t at = below(other.size()), size = 1 + below(12);
      switch (below(4)) {
        case 0:
          other.erase(at, size);
          break;
        case 1:
          other.insert(at, other.substr(below(other.size()), size));
          break;
        case 2:
          other.replace(at, 1, 1, static_cast<char>(below(256)));
          break;
        default:
          other.replace(at, std::min(size, other.size() - at), size, '\xff');
      }
    }
    EXPECT_EQ(refusal(other).empty(), other == bytes) << round;
  }
}

TEST_F(Sealed, WhatIsNoFileIsRefused) {
  std::filesystem::create_directory(folder_ / "folder");
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_NE(refusal_of(folder_ / "folder").find("is a folder"), std::string::npos);
  EXPECT_NE(refusal_of(folder_ / "pipe").find("is not a regular file"), std::string::npos);
  EXPECT_NE(refusal_of(folder_ / "absent").find("No such file"), std::string::npos);
  EXPECT_NE(refusal("{\"asset\":{}}").find("is no thing"), std::string::npos);
}

}  // namespace
}  // namespace ppm
