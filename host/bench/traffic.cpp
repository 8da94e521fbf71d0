#include "traffic.hpp"

#include <map>

#include "shared/layout.h"

namespace ppm::bench {
namespace {

constexpr double kPlane = 16.0;  // of hit points, statistics and photons
constexpr double kPhotonPlanes = 2.0, kHitPlanes = 4.0;
constexpr double kCounter = 2.0 * sizeof(std::uint32_t);  // read and written

struct Stream {
  double bytes_a_hit_point, bytes_a_photon;
};

const std::map<std::string, Stream> kStreams = {
    {"photon", {0.0, kPhotonPlanes* kPlane}},
    {"grid_count", {0.0, kPlane + kCounter}},
    {"grid_scatter", {0.0, 2.0 * kPhotonPlanes* kPlane + kCounter}},
    {"gather", {kHitPlanes * kPlane + kPlane, 0.0}},
    {"update", {kPlane + sizeof(shared::GatherSum), 0.0}},
};

}  // namespace

std::optional<double> streamed_bytes(const std::string& kernel, double hit_points, double photons) {
  const auto stream = kStreams.find(kernel);
  if (stream == kStreams.end()) return std::nullopt;
  return stream->second.bytes_a_hit_point * hit_points + stream->second.bytes_a_photon * photons;
}

}  // namespace ppm::bench
