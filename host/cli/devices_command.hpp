// `ppm-vk devices`: what there is to render on.
#pragma once

#include <string>
#include <vector>

#include "device.hpp"

namespace ppm::cli {

/// One paragraph a device: index, name, type, driver, Vulkan version, memory, and whether it can
/// serve or why not.
std::string describe_devices(const std::vector<gpu::DeviceDescription>& devices);

/// Prints them to stdout; returns the exit code, 1 where none can serve. Throws Failure without any
/// Vulkan.
int devices_command();

}  // namespace ppm::cli
