// The options of `ppm-vk bench`.
#pragma once

#include "options.hpp"

namespace CLI {
class App;
}

namespace ppm::cli {

/// Whether SCENE may be this: a built-in scene or the name of a file.
bool is_scene(const std::string& name);

void declare_bench(CLI::App& app, BenchOptions& options);
/// What no option can tell alone; throws CLI::ParseError.
void check_bench(const CLI::App& app, BenchOptions& options);

}  // namespace ppm::cli
