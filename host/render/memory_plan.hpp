// What a rendering takes, reckoned before any of it is allocated.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "integrator.hpp"
#include "pass_capacities.hpp"
#include "scene_size.hpp"

namespace ppm::render {

/// What follows upon what; a part is held from one of these to another.
enum class Phase { load, build, upload, eye, render };
inline constexpr Phase kPhases[] = {Phase::load, Phase::build, Phase::upload, Phase::eye,
                                    Phase::render};

struct MemoryPart {
  std::string name;
  std::uint64_t bytes = 0;
  bool on_device = false;
  Phase first = Phase::load, last = Phase::render;
};

struct MemoryPlan {
  std::vector<MemoryPart> parts;
  bool is_complete = true;  ///< otherwise more may come

  /// The most that is held at a time, on host and device together, or on one of them.
  std::uint64_t peak() const;
  std::uint64_t host_peak() const;
  std::uint64_t device_peak() const;
  std::uint64_t held(Phase phase, bool on_device) const;
};

/// What the settings' method needs beside the scene: in the table of methods (integrator.cpp).
std::vector<MemoryPart> method_memory(const Settings& settings, const PassLimits& limits);
std::vector<MemoryPart> ppm_memory(const Settings& settings, const PassLimits& limits);
std::vector<MemoryPart> photon_map_memory(const Settings& settings, const PassLimits& limits);
std::vector<MemoryPart> path_tracer_memory(const Settings& settings, const PassLimits& limits);
std::vector<MemoryPart> bdpt_memory(const Settings& settings, const PassLimits& limits);
std::vector<MemoryPart> mlt_memory(const Settings& settings, const PassLimits& limits);
/// A film of so many pixels, and what it keeps as a pass begins.
MemoryPart film_memory(std::uint64_t pixels, bool keeps);

/// An estimate: counts and sizes of records are exact, what rays will find is not (so many hit
/// points are reckoned with for each eye path as the limits say, 0.4 nodes for each triangle).
MemoryPlan memory_plan(const scene::SceneSize& size, const Settings& settings,
                       const PassLimits& limits);

/// What a checkpoint takes on top of that while it is written or restored: the method's state, as
/// it comes from the device and as it goes to the disk.
MemoryPart checkpoint_memory(const Settings& settings, const PassLimits& limits);

/// Of those that are held at the peak, but for the program itself.
const MemoryPart& largest_part(const MemoryPlan& plan);
/// "triangles 1.4 GiB, textures 320 MiB": the parts that are held at the peak, the largest first,
/// small ones together.
std::string describe_peak(const MemoryPlan& plan);
/// "1.4 GiB", "320 MiB".
std::string size_text(std::uint64_t bytes);

}  // namespace ppm::render
