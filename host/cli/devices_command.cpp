#include "devices_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "exit_code.hpp"
#include "failure.hpp"

namespace ppm::cli {

std::string describe_devices(const std::vector<gpu::DeviceDescription>& devices) {
  std::string text;
  for (const gpu::DeviceDescription& device : devices) {
    text += fmt::format("{}: {}\n", device.index, device.name);
    text += fmt::format("   {}, {}, Vulkan {}, {:.1f} GiB\n", device.type, device.driver,
                        device.api_version, static_cast<double>(device.memory_bytes) / (1u << 30));
    if (device.obstacles.empty()) text += "   can serve\n";
    for (const std::string& obstacle : device.obstacles) {
      text += fmt::format("   cannot serve: {}\n", obstacle);
    }
  }
  return text;
}

int devices_command() {
  const std::vector<gpu::DeviceDescription> devices = gpu::list_devices();
  std::fputs(describe_devices(devices).c_str(), stdout);
  const bool one_can_serve = std::any_of(
      devices.begin(), devices.end(), [](const auto& device) { return device.obstacles.empty(); });
  if (!one_can_serve) {
    throw Failure("Vulkan", "", "no device can serve",
                  "install a driver, such as Mesa's lavapipe for the CPU");
  }
  return kDone;
}

}  // namespace ppm::cli
