// What a pass or tile adds to the statistics once it is complete.
#pragma once

#include "counters.hpp"
#include "integrator.hpp"

namespace ppm::render {

struct Tally {
  std::uint64_t photons_stored = 0, photon_rays = 0;
  std::uint64_t paths_cut = 0, non_finite = 0, clamped = 0, overflow = 0;

  /// Of the photon or eye paths that were traced.
  void add(const Counters& counters) {
    paths_cut += counters[PPM_COUNTER_PATHS_CUT];
    non_finite += counters[PPM_COUNTER_NON_FINITE];
    clamped += counters[PPM_COUNTER_CLAMPED];
    photon_rays += counters[PPM_COUNTER_PHOTON_RAYS];
  }

  Tally& operator+=(const Tally& more) {
    photons_stored += more.photons_stored;
    photon_rays += more.photon_rays;
    paths_cut += more.paths_cut;
    non_finite += more.non_finite;
    clamped += more.clamped;
    overflow += more.overflow;
    return *this;
  }

  void add_to(Statistics& statistics) const {
    statistics.photons_stored += photons_stored;
    statistics.photon_rays += photon_rays;
    statistics.paths_cut += paths_cut;
    statistics.rejected["non_finite"] += non_finite;
    statistics.rejected["clamped"] += clamped;
    statistics.rejected["overflow"] += overflow;
  }
};

}  // namespace ppm::render
