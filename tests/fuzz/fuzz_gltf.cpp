// One input: a file in memory, which must load into a scene that keeps its promises or be refused
// with one line.
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "failure.hpp"
#include "load_gltf.hpp"
#include "scene_check.hpp"

namespace ppm::fuzz {
namespace {

constexpr std::size_t kLongestLine = 1000;
constexpr std::size_t kMostWarnings = 100;

/// A folder in memory, with what files under test refer to beside them. It goes with the process.
class Scratch {
 public:
  Scratch() {
    std::filesystem::path base = "/dev/shm";
    if (access(base.c_str(), W_OK) != 0) base = std::filesystem::temp_directory_path();
    folder_ = base / ("ppm-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path put(const char* name, std::string_view bytes) const {
    const std::filesystem::path file = folder_ / name;
    std::FILE* stream = std::fopen(file.c_str(), "wb");
    const bool written =
        stream != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
    if (stream == nullptr || std::fclose(stream) != 0 || !written) std::abort();
    return file;
  }

 private:
  std::filesystem::path folder_;
};

void check_line(std::string_view line, std::string_view file) {
  bool is_sound = line.starts_with(file) && line.size() < file.size() + kLongestLine;
  for (const char c : line) is_sound = is_sound && static_cast<unsigned char>(c) >= 0x20;
  if (!is_sound) broken("a message is not one short line that begins with the file", line);
}

}  // namespace
}  // namespace ppm::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ppm;
  static const fuzz::Scratch scratch;
  static const bool is_furnished = [] {
    scratch.put("beside.bin", std::string(256, '\0'));
    return true;
  }();
  (void)is_furnished;
  const std::filesystem::path file =
      scratch.put("input", {reinterpret_cast<const char*>(data), size});
  Log log(Verbosity::quiet);
  try {
    fuzz::check_scene(scene::load_gltf(file, log));
  } catch (const Failure& failure) {
    fuzz::check_line(failure.what(), file.string());
  }
  for (const std::string& warning : log.warnings()) fuzz::check_line(warning, file.string());
  if (log.warnings().size() > fuzz::kMostWarnings) fuzz::broken("too many warnings", "");
  return 0;
}
