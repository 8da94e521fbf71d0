#include "circumstances.hpp"

#include <fmt/format.h>

#include <numbers>

#include "failure.hpp"

namespace ppm::cli {

render::Circumstances circumstances_for(const scene::Scene& scene, const scene::LoadOptions& load,
                                        const gpu::Device& device) {
  render::Circumstances circumstances;
  circumstances.program = "ppm-vk " PPM_VERSION;
  circumstances.device = device.description().name;
  circumstances.driver = device.description().driver;
  circumstances.scene = scene.file;
  circumstances.frame = scene.frame;
  circumstances.load_attributes = {{"ppm-vk:luminous_efficacy", load.luminous_efficacy}};
  if (scene.environment) {
    const scene::Environment& environment = *scene.environment;
    circumstances.load_attributes.insert(
        circumstances.load_attributes.end(),
        {{"ppm-vk:environment", std::filesystem::path(environment.name).filename().string()},
         {"ppm-vk:environment_rotation", environment.rotation * 180.0 / std::numbers::pi},
         {"ppm-vk:environment_strength", static_cast<double>(environment.strength)}});
  }
  circumstances.device_memory_bytes = [&device] { return device.peak_bytes(); };
  return circumstances;
}

void check_validation(const gpu::Device& device) {
  if (const std::uint64_t messages = device.validation_messages(); messages > 0) {
    throw Failure(device.description().name, "--validate",
                  fmt::format("{} validation messages", messages), "see the lines above");
  }
}

}  // namespace ppm::cli
