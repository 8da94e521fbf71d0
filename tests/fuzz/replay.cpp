// Without a fuzzer: `ppm_fuzz_replay FOLDER...` feeds the seeds and all files of the folders to the
// loader once; `ppm_fuzz_replay --write FOLDER` writes the seeds for a fuzzer to start from.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "seeds.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr double kLongestSeconds = 10.0;  // what the fuzzer allows

int failures = 0;

void replay(const std::string& name, const ppm::test::Bytes& bytes) {
  std::printf("%s\n", name.c_str());
  std::fflush(stdout);  // the last line names what ended the process
  const auto start = std::chrono::steady_clock::now();
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  if (spent.count() < kLongestSeconds) return;
  std::fprintf(stderr, "%s: took %.1f s\n", name.c_str(), spent.count());
  ++failures;
}

ppm::test::Bytes content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--write") {
    std::filesystem::create_directories(argv[2]);
    for (const ppm::fuzz::Seed& seed : ppm::fuzz::seeds()) {
      ppm::test::write_file(std::filesystem::path(argv[2]) / seed.name, seed.bytes);
    }
    return 0;
  }
  for (const ppm::fuzz::Seed& seed : ppm::fuzz::seeds()) replay(seed.name, seed.bytes);
  for (int i = 1; i < argc; ++i) {
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) {
      if (entry.is_regular_file()) replay(entry.path().filename(), content(entry.path()));
    }
  }
  return failures == 0 ? 0 : 1;
}
