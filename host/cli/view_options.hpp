// The options of `ppm-vk view`.
#pragma once

#include "options.hpp"

namespace CLI {
class App;
}

namespace ppm::cli {

void declare_view(CLI::App& app, ViewOptions& options);
/// What no option can tell alone; throws CLI::ParseError.
void check_view(const CLI::App& app, ViewOptions& options);

}  // namespace ppm::cli
