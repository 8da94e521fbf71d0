// --aov: layers beside the picture.
#pragma once

#include "declarer.hpp"
#include "options.hpp"

namespace ppm::cli {

void declare_layers(Declarer& declare, RenderOptions& options);
/// Once method and files are known: what of the layers cannot be; throws CLI::ParseError.
void check_layers(const CLI::App& app, const RenderOptions& options);

}  // namespace ppm::cli
