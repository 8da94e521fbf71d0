#include "integrator.hpp"

#include "failure.hpp"
#include "ppm.hpp"

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
  std::string_view name;
  Factory make;
};

constexpr Entry kIntegrators[] = {
    {"ppm", create<PpmIntegrator>},
};

}  // namespace

std::unique_ptr<Integrator> make_integrator(const Settings& settings, const scene::Scene& scene,
                                            gpu::Device& device, Log& log, unsigned threads) {
  for (const Entry& entry : kIntegrators) {
    if (entry.name == settings.integrator) return entry.make(settings, scene, device, log, threads);
  }
  throw Failure("", "--integrator", "unknown method '" + settings.integrator + "'",
                "see ppm-vk help render");
}

std::vector<std::string_view> integrator_names() {
  std::vector<std::string_view> names;
  for (const Entry& entry : kIntegrators) names.push_back(entry.name);
  return names;
}

}  // namespace ppm::render
