// `ppm-vk view`: a window that shows the picture as it becomes.
#pragma once

#include "options.hpp"

namespace ppm::cli {

/// Returns the exit code: 0 the window was closed, 1 validation found fault, 130 interrupted.
/// Throws Failure for a scene, screen or device that cannot serve.
int view_command(const ViewOptions& options);

}  // namespace ppm::cli
