#include "options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "bench_options.hpp"
#include "compare_options.hpp"
#include "exit_code.hpp"
#include "info_options.hpp"
#include "inspect_options.hpp"
#include "render_options.hpp"
#include "resume_options.hpp"
#include "view_options.hpp"

namespace ppm::cli {
namespace {

constexpr const char* kOverview =
    "ppm-vk renders glTF scenes by progressive photon mapping on Vulkan devices.\n"
    "\n"
    "  ppm-vk render SCENE.glb -o OUT.exr   render a scene\n"
    "  ppm-vk resume CHECKPOINT             go on with one that was stopped\n"
    "  ppm-vk view SCENE.glb                watch it in a window and move the camera\n"
    "  ppm-vk compare SCENE.glb -o REPORT/  render it by several methods for the same time\n"
    "  ppm-vk bench [SCENE...]              measure how fast it renders\n"
    "  ppm-vk inspect SCENE.glb             say what a scene holds and what memory it takes\n"
    "  ppm-vk info FILE                     say what a checkpoint or one of our EXRs holds\n"
    "  ppm-vk devices                       list the Vulkan devices and say which can serve\n"
    "  ppm-vk help [VERB]                   this text, or all options of a verb\n"
    "  ppm-vk --version                     the version\n"
    "\n"
    "Exit codes: 0 done, 1 scene, file or device, 2 usage, 130 interrupted.\n";

constexpr const char* kDevicesHelp =
    "Usage: ppm-vk devices\n"
    "\n"
    "Lists the Vulkan devices with the index that `ppm-vk render --device` takes, and says of "
    "each\n"
    "whether it can serve or what it lacks.\n";

Options usage_error(const std::string& what, const char* remedy) {
  std::string line = fmt::format("ppm-vk: error: {}: {}", what, remedy);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  std::fprintf(stderr, "%s\n", line.c_str());
  Options options;
  options.exit_code = kWrongUsage;
  return options;
}

Options printed(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  return {};
}

/// CLI11 counts values where one is missing or an option is there twice; this says which.
std::string explain(const CLI::ArgumentMismatch& error, const CLI::App& app) {
  const std::string text = error.what();
  const std::string name = text.substr(0, text.find(':'));
  const CLI::Option* const option = app.get_option_no_throw(name);
  if (!option) return text;
  return name + (option->count() > 1 ? ": is given more than once" : ": a value is missing");
}

/// Parses with what `declare` declares, then asks `check`; both name what CLI11 throws.
Options parse_verb(Verb verb, const std::string& name, std::vector<std::string> arguments,
                   const std::function<void(CLI::App&, Options&)>& declare,
                   const std::function<void(const CLI::App&, Options&)>& check) {
  Options options;
  CLI::App app("", "ppm-vk " + name);
  const std::string remedy = "see ppm-vk help " + name;
  try {
    declare(app, options);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    app.parse(arguments);
    check(app, options);
  } catch (const CLI::CallForHelp&) {
    return printed(app.help());
  } catch (const CLI::ArgumentMismatch& error) {
    return usage_error(explain(error, app), remedy.c_str());
  } catch (const CLI::ParseError& error) {
    return usage_error(error.what(), remedy.c_str());
  }
  options.verb = verb;
  return options;
}

/// `verb`: whose help complaints point to.
Options parse_render(const std::vector<std::string>& arguments, const char* verb = "render") {
  return parse_verb(
      Verb::render, verb, arguments,
      [](CLI::App& app, Options& options) { declare_render(app, options.render); },
      [](const CLI::App& app, Options& options) { check_render(app, options.render); });
}

Options parse_bench(const std::vector<std::string>& arguments) {
  return parse_verb(
      Verb::bench, "bench", arguments,
      [](CLI::App& app, Options& options) { declare_bench(app, options.bench); },
      [](const CLI::App& app, Options& options) { check_bench(app, options.bench); });
}

Options parse_compare(const std::vector<std::string>& arguments) {
  return parse_verb(
      Verb::compare, "compare", arguments,
      [](CLI::App& app, Options& options) { declare_compare(app, options.compare); },
      [](const CLI::App& app, Options& options) { check_compare(app, options.compare); });
}

Options parse_inspect(const std::vector<std::string>& arguments) {
  return parse_verb(
      Verb::inspect, "inspect", arguments,
      [](CLI::App& app, Options& options) { declare_inspect(app, options.inspect); },
      [](const CLI::App& app, Options& options) { check_inspect(app, options.inspect); });
}

Options parse_resume(const std::vector<std::string>& arguments) {
  RenderOptions scratch;
  return parse_verb(
      Verb::resume, "resume", arguments,
      [&](CLI::App& app, Options& options) { declare_resume(app, options.resume, scratch); },
      [](const CLI::App& app, Options& options) { check_resume(app, options.resume); });
}

Options parse_view(const std::vector<std::string>& arguments) {
  return parse_verb(
      Verb::view, "view", arguments,
      [](CLI::App& app, Options& options) { declare_view(app, options.view); },
      [](const CLI::App& app, Options& options) { check_view(app, options.view); });
}

Options parse_info(const std::vector<std::string>& arguments) {
  return parse_verb(
      Verb::info, "info", arguments,
      [](CLI::App& app, Options& options) { declare_info(app, options.info); },
      [](const CLI::App& app, Options& options) { check_info(app, options.info); });
}

Options parse_help(const std::vector<std::string>& arguments) {
  if (arguments.size() > 1)
    return usage_error(arguments[1] + ": one argument too many", "see ppm-vk help");
  if (arguments.empty() || arguments[0] == "help") return printed(kOverview);
  if (arguments[0] == "render") return parse_render({"--help"});
  if (arguments[0] == "compare") return parse_compare({"--help"});
  if (arguments[0] == "bench") return parse_bench({"--help"});
  if (arguments[0] == "inspect") return parse_inspect({"--help"});
  if (arguments[0] == "resume") return parse_resume({"--help"});
  if (arguments[0] == "view") return parse_view({"--help"});
  if (arguments[0] == "info") return parse_info({"--help"});
  if (arguments[0] == "devices") return printed(kDevicesHelp);
  return usage_error(arguments[0] + ": no such verb", "see ppm-vk help");
}

Options parse_devices(const std::vector<std::string>& arguments) {
  Options options;
  options.verb = Verb::devices;
  if (arguments.empty()) return options;
  if (arguments[0] == "--help" || arguments[0] == "-h") return printed(kDevicesHelp);
  return usage_error(arguments[0] + ": devices takes no options", "see ppm-vk help devices");
}

}  // namespace

Options parse(int argc, const char* const* argv) {
  if (argc < 2) return usage_error("no verb is given", "see ppm-vk help");
  const std::string verb = argv[1];
  const std::vector<std::string> rest(argv + 2, argv + argc);
  if (verb == "render") return parse_render(rest);
  if (verb == "compare") return parse_compare(rest);
  if (verb == "bench") return parse_bench(rest);
  if (verb == "inspect") return parse_inspect(rest);
  if (verb == "resume") return parse_resume(rest);
  if (verb == "view") return parse_view(rest);
  if (verb == "info") return parse_info(rest);
  if (verb == "devices") return parse_devices(rest);
  if (verb == "help" || verb == "--help" || verb == "-h") return parse_help(rest);
  if (verb == "--version") {
    if (!rest.empty()) return usage_error(rest[0] + ": one argument too many", "see ppm-vk help");
    return printed("ppm-vk " PPM_VERSION "\n");
  }
  return usage_error(verb + (verb.starts_with('-') ? ": no such option" : ": no such verb"),
                     "see ppm-vk help");
}

Options parse_resumed(const std::vector<std::string>& words) {
  return parse_render(words, "resume");
}

}  // namespace ppm::cli
