// `ppm-vk info`.
#pragma once

#include "options.hpp"

namespace ppm::cli {

/// Returns the exit code; throws Failure for what is neither a checkpoint nor an EXR of ours.
int info_command(const InfoOptions& options);

}  // namespace ppm::cli
