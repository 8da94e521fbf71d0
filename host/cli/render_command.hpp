// `ppm-vk render`: from a scene file to pictures.
#pragma once

#include "options.hpp"

namespace ppm::cli {

/// Returns the exit code: 0 done, 1 validation found fault, 130 interrupted (the picture so far is
/// written). Throws Failure for a scene, file or device that cannot serve.
int render_command(const RenderOptions& options);

}  // namespace ppm::cli
