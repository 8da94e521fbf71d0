#include "info_options.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "render_options.hpp"

namespace ppm::cli {

void declare_info(CLI::App& app, InfoOptions& options) {
  set_usage(app,
            "Usage: ppm-vk info FILE [--json]\n"
            "\n"
            "Says what a checkpoint, or an EXR that ppm-vk wrote, holds.\n");
  app.allow_extras();
  Declarer declare(app);
  declare.text("FILE", "", "checkpoint or .exr",
               [&](const std::string& value) { options.file = value; });
  declare.flag("--json", "print it as JSON", [&] { options.json = true; });
}

void check_info(const CLI::App& app, InfoOptions& options) {
  check_extras(app);
  if (options.file.empty()) throw CLI::ValidationError("FILE", "no file is given");
}

}  // namespace ppm::cli
