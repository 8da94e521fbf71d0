// `ppm-vk inspect`: what a scene holds, as the renderer understands it. Needs no Vulkan device.
#pragma once

#include "options.hpp"

namespace ppm::cli {

/// Prints the summary to stdout; returns the exit code. Throws Failure for a scene that cannot be
/// rendered.
int inspect_command(const InspectOptions& options);

}  // namespace ppm::cli
