// The options of `ppm-vk compare`.
#pragma once

#include "options.hpp"

namespace CLI {
class App;
}

namespace ppm::cli {

void declare_compare(CLI::App& app, CompareOptions& options);
/// What no option can tell alone, methods and their own options among it; throws CLI::ParseError.
void check_compare(const CLI::App& app, CompareOptions& options);

}  // namespace ppm::cli
