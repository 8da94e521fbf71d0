// The options that say how long a rendering goes on and what it leaves and tells on the way.
#pragma once

#include <string>
#include <vector>

#include "declarer.hpp"
#include "options.hpp"

namespace ppm::cli {

/// In the group of the method: when the rendering is complete.
void declare_total_photons(Declarer& declare, RenderOptions& options);
/// In a group of their own. --checkpoint itself only where `names_checkpoint` says so.
void declare_run(Declarer& declare, RenderOptions& options, bool names_checkpoint);

/// What no option can tell alone; throws CLI::ParseError.
void check_run(const CLI::App& app, const RenderOptions& options);

/// What was given, in the form of render::Checkpoint::words.
std::vector<std::string> words_of(const CLI::App& app);

}  // namespace ppm::cli
