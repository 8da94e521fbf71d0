// When a rendering is complete.
#pragma once

#include "driver.hpp"
#include "options.hpp"

namespace ppm::cli {

/// What the options ask for; the usual number of passes where they and the method set no end.
render::Budget budget_for(const RenderOptions& options);

}  // namespace ppm::cli
