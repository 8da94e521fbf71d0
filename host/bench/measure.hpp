// Renders scenes over and over and notes what every part takes.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "device.hpp"
#include "integrator.hpp"
#include "log.hpp"
#include "results.hpp"
#include "scene.hpp"

namespace ppm::bench {

/// What is rendered.
struct Case {
  std::string name;  ///< that rows begin with; unique
  std::function<scene::Scene(Log&)> load;
  std::function<render::Settings(const scene::Scene&, Log&)> settings;
};

/// How often, and on what.
struct Plan {
  unsigned repetitions = 5;
  std::uint64_t warmup = 1;  ///< passes left out, at least the first
  std::uint64_t passes = 4;  ///< that are timed, a repetition
  bool aged = false;         ///< also once radii have halved
  gpu::DeviceOptions device;
  unsigned threads = 1;  ///< of the host
};

/// Passes until all radii have halved where every pass lands as many photons a unit area: after i
/// passes R^2 has been multiplied by (j + alpha) / (j + 1) for every j < i, by [HOJ08] Eqs. 7
/// and 9.
std::uint64_t passes_until_half(double alpha);

/// Measures all cases in turn, `plan.repetitions` times over, so that a machine whose speed wanders
/// treats them alike. Every repetition starts anew: device, scene, tree, eye pass, pilot. Rows:
///   compile                      what the first dispatches of all kernels took more than later
///                                ones, each alone as counter K_seconds; share: of the first start
///   CASE/start, CASE/start:PART  from nothing to the picture after one pass, wall time
///   CASE/start/kernel:K          device time before the first pass
///   CASE/pass, CASE/kernel:K     a pass, and the device time of K in it
///   CASE/aged/...                the same once radii have halved
/// Returns nothing when `interrupted` said so. Throws Failure for what cannot be rendered, and when
/// validation had anything to say. Tells `tell` of every step, a line without its end.
std::optional<std::vector<Row>> measure(const std::vector<Case>& cases, const Plan& plan,
                                        const std::function<bool()>& interrupted, Log& log,
                                        const std::function<void(const std::string&)>& tell);

}  // namespace ppm::bench
