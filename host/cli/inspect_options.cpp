#include "inspect_options.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "declarer.hpp"
#include "render_options.hpp"

namespace ppm::cli {

void declare_inspect(CLI::App& app, InspectOptions& options) {
  set_usage(
      app,
      "Usage: ppm-vk inspect SCENE.glb|.gltf [--json] [OPTIONS]\n"
      "\n"
      "Says what a scene holds as it would be rendered, and what memory that would take; options\n"
      "are those of render.\n");
  app.allow_extras();
  Declarer declare(app);
  declare.text("SCENE", "", "glTF 2.0 file, .glb or .gltf",
               [&](const std::string& value) { options.render.scene = value; });
  declare.flag("--json", "print it as JSON", [&] { options.json = true; });
  declare_method(declare, options.render, "photon passes");
  declare_camera(declare, options.render);
  declare.group("Machine");
  declare_memory(declare, options.render);
}

void check_inspect(const CLI::App& app, InspectOptions& options) {
  check_extras(app);
  take_method(app, options.render);
  if (options.render.scene.empty()) throw CLI::ValidationError("SCENE", "no scene file is given");
  check_camera(options.render);
}

}  // namespace ppm::cli
