// The options of `ppm-vk inspect`.
#pragma once

#include "options.hpp"

namespace CLI {
class App;
}

namespace ppm::cli {

void declare_inspect(CLI::App& app, InspectOptions& options);
/// What no option can tell alone; throws CLI::ParseError.
void check_inspect(const CLI::App& app, InspectOptions& options);

}  // namespace ppm::cli
