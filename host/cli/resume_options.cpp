#include "resume_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include "render_options.hpp"
#include "run_options.hpp"

namespace ppm::cli {
namespace {

/// Of --spp and --passes, which mean the same where passes are samples, each replaces the other.
constexpr std::array<std::string_view, 4> kBudgets = {"--passes", "--spp", "--time",
                                                      "--total-photons"};
/// Of one session alone.
constexpr std::array<std::string_view, 7> kOfOneSession = {
    "--quiet", "--verbose", "--validate", "--stats", "--progress", "--checkpoint", "--display"};

std::string_view name_in(std::string_view word) {
  return word.starts_with("--") ? word.substr(0, word.find('=')) : "SCENE";
}

bool is_among(std::string_view name, const auto& names) {
  return std::ranges::find(names, name) != names.end();
}

/// Whether passes are eye paths of each pixel, so that --spp is no part of the picture.
bool counts_samples(const std::vector<std::string>& words) {
  constexpr std::string_view kOption = "--integrator=";
  for (const std::string_view word : words) {
    if (!word.starts_with(kOption)) continue;
    const auto methods = render::methods();
    const auto method =
        std::ranges::find(methods, word.substr(kOption.size()), &render::Method::name);
    return method != methods.end() && method->unit != render::PassUnit::photons;
  }
  return false;
}

}  // namespace

void declare_resume(CLI::App& app, ResumeOptions& options, RenderOptions& render) {
  set_usage(
      app,
      "Usage: ppm-vk resume CHECKPOINT [-o FILE.exr|.png|.hdr|.pfm ...] [OPTIONS]\n"
      "\n"
      "Goes on where a rendering with --checkpoint stopped, and keeps the same checkpoint. All\n"
      "options are as they were unless given; those that shape the picture cannot be.\n");
  app.allow_extras();
  Declarer declare(app);
  declare.text("CHECKPOINT", "", "file that was written by render --checkpoint",
               [&](const std::string& value) { options.checkpoint = value; });
  declare_outputs(declare, render, app);
  declare.group("When it ends, counted from the very beginning");
  declare_passes(declare, render, "passes in all");
  declare_time(declare, render);
  declare_total_photons(declare, render);
  declare_run(declare, render, false);
  declare_machine(declare, render);
  declare_testing(declare, render);
}

void check_resume(const CLI::App& app, ResumeOptions& options) {
  const std::vector<std::string> extras = app.remaining();
  if (!extras.empty()) {
    const bool is_option = extras.front().starts_with('-');
    throw CLI::ValidationError(
        extras.front(), is_option ? "no option of resume; what shapes the picture stays as it was"
                                  : "one argument too many");
  }
  if (options.checkpoint.empty()) {
    throw CLI::ValidationError("CHECKPOINT", "no checkpoint is given");
  }
  check_verbosity(app);
  for (std::string& word : words_of(app)) {
    if (word.starts_with("--")) options.words.push_back(std::move(word));
  }
}

std::vector<std::string> resumed_words(const std::vector<std::string>& checkpoint,
                                       const ResumeOptions& resume) {
  std::vector<std::string_view> given;
  for (const std::string& word : resume.words) given.push_back(name_in(word));
  const bool has_budget =
      std::ranges::any_of(given, [](std::string_view name) { return is_among(name, kBudgets); });
  const bool samples = counts_samples(checkpoint);

  std::vector<std::string> words;
  for (const std::string& word : checkpoint) {
    const std::string_view name = name_in(word);
    const bool is_budget = is_among(name, kBudgets) && (name != "--spp" || samples);
    if (is_among(name, given) || is_among(name, kOfOneSession)) continue;
    if (has_budget && is_budget) continue;
    words.push_back(word);
  }
  words.insert(words.end(), resume.words.begin(), resume.words.end());
  words.push_back("--checkpoint=" + resume.checkpoint.string());
  return words;
}

}  // namespace ppm::cli
