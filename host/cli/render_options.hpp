// The options of `ppm-vk render`, and those that other verbs share with it.
#pragma once

#include "declarer.hpp"
#include "options.hpp"

namespace ppm::cli {

void declare_render(CLI::App& app, RenderOptions& options);
/// What no option can tell alone; throws CLI::ParseError.
void check_render(const CLI::App& app, RenderOptions& options);

/// Groups of options; help names the defaults that `options` has, and says of --passes what they
/// are.
void declare_method(Declarer& declare, RenderOptions& options, const char* passes);
void declare_outputs(Declarer& declare, RenderOptions& options, CLI::App& app);
void declare_pictures(Declarer& declare, RenderOptions& options, CLI::App& app);
void declare_encoding(Declarer& declare, RenderOptions& options);
void declare_passes(Declarer& declare, RenderOptions& options, const std::string& help);
void declare_time(Declarer& declare, RenderOptions& options);
void declare_camera(Declarer& declare, RenderOptions& options);
void declare_lights(Declarer& declare, RenderOptions& options);
void declare_memory(Declarer& declare, RenderOptions& options);
void declare_machine(Declarer& declare, RenderOptions& options);
void declare_testing(Declarer& declare, RenderOptions& options);
/// Once all are read: refuses what the method does not have, and makes --spp the number of passes
/// of methods whose passes are samples.
void take_method(const CLI::App& app, RenderOptions& options);
/// What is wrong with the camera's options together.
void check_camera(const RenderOptions& options);
/// Their part of the check, and arguments that nothing takes.
void check_shared(const CLI::App& app, const RenderOptions& options);
void check_extras(const CLI::App& app);
/// That it is not to be both quiet and verbose.
void check_verbosity(const CLI::App& app);

}  // namespace ppm::cli
