#include "run_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <utility>

#include "image.hpp"

namespace ppm::cli {
namespace {

/// Options whose values are paths.
constexpr std::array kPaths = {"SCENE",     "--env",   "--output",         "--checkpoint",
                               "--preview", "--stats", "--output-fallback"};

void interval(Declarer& declare, const char* name, double& seconds, const std::string& help) {
  declare.text(name, "T", help, [name, &seconds](const std::string& value) {
    const std::optional<double> duration = parse_duration(value);
    if (!duration) refuse(name, value, "a time such as 30, 90s, 10m or 2h");
    seconds = *duration;
  });
}

/// That nothing else is read from or written to the files that are written beside the pictures.
void check_files(const RenderOptions& options) {
  std::vector<std::filesystem::path> others = options.outputs;
  others.push_back(options.scene);
  if (!options.load.environment.empty()) others.push_back(options.load.environment);
  const std::pair<const char*, const std::filesystem::path&> files[] = {
      {"--checkpoint", options.run.checkpoint},
      {"--stats", options.stats},
      {"--preview", options.run.preview}};
  for (const auto& [option, file] : files) {
    if (file.empty()) continue;
    for (const auto& other : others) {
      if (same_file(file, other)) refuse(option, file.string(), "a file of its own");
    }
    others.push_back(file);
  }
}

}  // namespace

void declare_total_photons(Declarer& declare, RenderOptions& options) {
  declare.whole<std::uint64_t>(
      "--total-photons", options.run.total_photons, 1, std::uint64_t{1} << 53,
      "photon paths in all, rounded up to whole passes; of --passes, --time and\n"
      "--total-photons the first that is reached ends it");
}

void declare_run(Declarer& declare, RenderOptions& options, bool names_checkpoint) {
  RunOptions& run = options.run;
  declare.group("Long renderings");
  if (names_checkpoint) {
    declare.text("--checkpoint", "FILE",
                 "what `ppm-vk resume FILE` goes on from, however this ends",
                 [&](const std::string& value) {
                   if (value.empty()) refuse("--checkpoint", value, "a file name");
                   run.checkpoint = value;
                 });
  }
  interval(declare, "--checkpoint-every", run.checkpoint_seconds,
           fmt::format("time between two checkpoints (default {}s)", run.checkpoint_seconds));
  declare.text("--preview", "FILE.exr|.png|.hdr|.pfm", "the picture so far, from the first pass on",
               [&](const std::string& value) {
                 if (!image::has_known_extension(value)) {
                   refuse("--preview", value, "a file name that ends in .exr, .png, .hdr or .pfm");
                 }
                 run.preview = value;
               });
  interval(declare, "--preview-every", run.preview_seconds,
           fmt::format("time between two previews (default {}s)", run.preview_seconds));
  declare.text("--progress", "text|json", "json: an object a line on stderr (default text)",
               [&](const std::string& value) {
                 if (value != "text" && value != "json") {
                   refuse("--progress", value, "one of text, json");
                 }
                 run.progress_json = value == "json";
               });
  declare.text("--output-fallback", "FOLDER",
               "where files go that cannot be written where they should",
               [&](const std::string& value) {
                 if (value.empty()) refuse("--output-fallback", value, "a folder");
                 run.fallback = value;
               });
}

void check_run(const CLI::App& app, const RenderOptions& options) {
  const RunOptions& run = options.run;
  const render::Method method = render::method_named(options.settings.integrator);
  if (run.total_photons && method.unit != render::PassUnit::photons) {
    throw CLI::ValidationError("--total-photons",
                               fmt::format("is no option of --integrator {}", method.name));
  }
  if (app.count("--checkpoint-every") > 0 && run.checkpoint.empty()) {
    throw CLI::ValidationError("--checkpoint-every", "needs --checkpoint");
  }
  if (app.count("--preview-every") > 0 && run.preview.empty()) {
    throw CLI::ValidationError("--preview-every", "needs --preview");
  }
  check_files(options);
}

std::vector<std::string> words_of(const CLI::App& app) {
  std::vector<std::string> words;
  for (const CLI::Option* const option : app.get_options()) {
    const std::string name = option->get_name();
    const bool is_path = std::ranges::find(kPaths, name) != kPaths.end();
    for (const std::string& result : option->results()) {
      if (option->get_expected_max() == 0) {
        words.push_back(name);
        break;
      }
      if (result.empty()) continue;  // means the default wherever it is allowed
      const std::string value = is_path ? std::filesystem::absolute(result).string() : result;
      words.push_back(option->nonpositional() ? name + "=" + value : value);
    }
  }
  return words;
}

}  // namespace ppm::cli
