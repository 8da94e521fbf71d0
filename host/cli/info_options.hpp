// The options of `ppm-vk info`.
#pragma once

#include "declarer.hpp"
#include "options.hpp"

namespace ppm::cli {

void declare_info(CLI::App& app, InfoOptions& options);
/// Throws CLI::ParseError.
void check_info(const CLI::App& app, InfoOptions& options);

}  // namespace ppm::cli
