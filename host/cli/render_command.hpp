// `ppm-vk render`: from a scene file to pictures.
#pragma once

#include "checkpoint.hpp"
#include "options.hpp"

namespace ppm::cli {

/// Returns the exit code: 0 done, 1 validation found fault, 130 interrupted (the picture so far is
/// written). Throws Failure for a scene, file or device that cannot serve.
int render_command(const RenderOptions& options);

/// The same for a rendering that goes on from `checkpoint`, which options.run.checkpoint held.
int render_from(const RenderOptions& options, render::Checkpoint checkpoint);

}  // namespace ppm::cli
