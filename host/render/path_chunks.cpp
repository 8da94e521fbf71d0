#include "path_chunks.hpp"

#include <algorithm>

#include "failure.hpp"

namespace ppm::render {

std::optional<std::uint32_t> PathChunks::trace(std::uint32_t stream, std::uint32_t pass,
                                               std::uint32_t first, std::uint32_t paths,
                                               const std::function<bool()>& interrupted,
                                               const std::function<bool()>& use) {
  const std::uint32_t end = first + paths;
  std::uint32_t chunks = 0;
  while (first < end) {
    const std::uint32_t chunk = std::min(paths_, end - first);
    const PhotonTracer::Result result = tracer_.trace(stream, pass, first, chunk, interrupted);
    if (result == PhotonTracer::Result::interrupted) return std::nullopt;
    if (result == PhotonTracer::Result::overflow) {
      if (chunk == 1) {
        throw Failure("", "--photon-capacity " + std::to_string(tracer_.photon_share(1)),
                      "the photons of one path do not fit", "raise --photon-capacity");
      }
      paths_ = (chunk + 1) / 2;
      continue;
    }
    if (!use()) return std::nullopt;
    first += chunk;
    ++chunks;
  }
  return chunks;
}

}  // namespace ppm::render
