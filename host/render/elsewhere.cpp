#include "elsewhere.hpp"

#include <fmt/format.h>

#include "failure.hpp"

namespace ppm::render {

void Elsewhere::write(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write) {
  try {
    write(file);
    return;
  } catch (const Failure& failure) {
    if (folder_.empty()) throw;
    log_.warn(failure.what());
  }
  std::filesystem::path other = folder_ / file.filename();
  for (int number = 2; !taken_.insert(other.filename().string()).second; ++number) {
    other =
        folder_ / fmt::format("{}-{}{}", file.stem().string(), number, file.extension().string());
  }
  write(other);
  log_.warn(fmt::format("wrote {} instead", other.string()));
}

}  // namespace ppm::render
