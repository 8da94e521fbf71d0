#include "integrator.hpp"

#include <algorithm>

#include "bdpt.hpp"
#include "failure.hpp"
#include "memory_plan.hpp"
#include "mlt.hpp"
#include "path_tracer.hpp"
#include "pm.hpp"
#include "portions.hpp"
#include "ppm.hpp"
#include "scene_buffers.hpp"

namespace ppm::render {
namespace {

using Factory = std::unique_ptr<Integrator> (*)(const Settings&, const scene::Scene&, gpu::Device&,
                                                Log&, unsigned);

template <class Method>
std::unique_ptr<Integrator> create(const Settings& settings, const scene::Scene& scene,
                                   gpu::Device& device, Log& log, unsigned threads) {
  return std::make_unique<Method>(settings, scene, device, log, threads);
}

struct Entry {
  Method method;
  Factory make;
  std::vector<MemoryPart> (*memory)(const Settings&, const PassLimits&);
  Portions (*portions)(const Settings&, const PassLimits&);
};

constexpr Entry kIntegrators[] = {
    {{"ppm", "progressive photon mapping", PassUnit::photons, "--photons --alpha --radius"},
     create<PpmIntegrator>,
     ppm_memory,
     ppm_portions},
    {{"pt", "path tracing, one light sampled at each surface", PassUnit::samples, ""},
     create<PathTracer>,
     path_tracer_memory,
     path_tracer_portions},
    {{"pt-mis", "the same, with multiple importance sampling", PassUnit::samples, ""},
     create<PathTracer>,
     path_tracer_memory,
     path_tracer_portions},
    {{"bdpt", "bidirectional path tracing", PassUnit::samples, ""},
     create<BdptIntegrator>,
     bdpt_memory,
     bdpt_portions},
    {{"lt", "light tracing: what light paths show the lens", PassUnit::samples, ""},
     create<BdptIntegrator>,
     bdpt_memory,
     bdpt_portions},
    {{"mlt", "Metropolis light transport over bidirectional samples", PassUnit::mutations, ""},
     create<MltIntegrator>,
     mlt_memory,
     mlt_portions},
    {{"pm", "classic photon mapping: one map, the nearest photons", PassUnit::photons,
      "--photons --map-photons --nearest --radius", true},
     create<PhotonMapIntegrator>,
     photon_map_memory,
     photon_map_portions},
};

const Entry& entry_named(std::string_view name) {
  for (const Entry& entry : kIntegrators) {
    if (entry.method.name == name) return entry;
  }
  throw Failure("", "--integrator", "unknown method '" + std::string(name) + "'",
                "see ppm-vk help render");
}

}  // namespace

std::unique_ptr<Integrator> make_integrator(const Settings& settings, const scene::Scene& scene,
                                            gpu::Device& device, Log& log, unsigned threads) {
  require_light(scene);
  return entry_named(settings.integrator).make(settings, scene, device, log, threads);
}

Statistics Statistics::of_scene() const {
  Statistics kept;
  kept.triangles = triangles;
  kept.lights = lights;
  for (const char* const part : {"bvh", "upload", "pipelines"}) {
    if (const auto entry = seconds.find(part); entry != seconds.end()) kept.seconds.insert(*entry);
  }
  return kept;
}

bool Method::has_option(std::string_view option) const {
  for (std::string_view rest = options; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == option) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

std::vector<Method> methods() {
  std::vector<Method> all;
  for (const Entry& entry : kIntegrators) all.push_back(entry.method);
  return all;
}

bool is_method(std::string_view name) {
  return std::ranges::find(kIntegrators, name, [](const Entry& entry) {
           return entry.method.name;
         }) != std::end(kIntegrators);
}

Method method_named(std::string_view name) {
  return entry_named(name).method;
}

std::vector<MemoryPart> method_memory(const Settings& settings, const PassLimits& limits) {
  return entry_named(settings.integrator).memory(settings, limits);
}

Portions method_portions(const Settings& settings, const PassLimits& limits) {
  return entry_named(settings.integrator).portions(settings, limits);
}

}  // namespace ppm::render
