// Bytes that kernels move for certain.
#pragma once

#include <optional>
#include <string>

namespace ppm::bench {

/// Bytes of the records that `kernel` reads and writes one after the other in a pass over
/// `hit_points` hit points and `photons` stored photons:
///   photon        the photons it stores
///   grid_count    positions read, counts of cells changed
///   grid_scatter  photons read and written, counts of cells changed
///   gather        hit points and their radii read
///   update        statistics and sums read
/// What is met again and again or only here and there (nodes, triangles, queues of paths, photons
/// that searches meet, hit points that change) is not counted, so that this is the least that is
/// moved. Nothing for kernels of which nothing can be said so.
std::optional<double> streamed_bytes(const std::string& kernel, double hit_points, double photons);

}  // namespace ppm::bench
