// The options of `ppm-vk resume`.
#pragma once

#include "declarer.hpp"
#include "options.hpp"

namespace ppm::cli {

/// `render` is a scratch pad: what counts are the words.
void declare_resume(CLI::App& app, ResumeOptions& options, RenderOptions& render);
/// Takes the words; throws CLI::ParseError.
void check_resume(const CLI::App& app, ResumeOptions& options);

/// The words of `render` that go on with the checkpoint's: those of `resume` count before
/// `checkpoint`'s of the same name, and any budget before all of its budgets; what concerned only
/// the first session is left out.
std::vector<std::string> resumed_words(const std::vector<std::string>& checkpoint,
                                       const ResumeOptions& resume);

}  // namespace ppm::cli
