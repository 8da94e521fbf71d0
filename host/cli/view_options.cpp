#include "view_options.hpp"

#include <CLI/CLI.hpp>

#include "controls.hpp"
#include "declarer.hpp"
#include "layer_options.hpp"
#include "render_options.hpp"

namespace ppm::cli {

void declare_view(CLI::App& app, ViewOptions& options) {
  set_usage(
      app,
      "Usage: ppm-vk view SCENE.glb|.gltf [-o FILE ...] [OPTIONS]\n"
      "\n"
      "Shows the picture in a window as it becomes. Options are those of render; the files are\n"
      "written when the key o is pressed (without -o numbered ones, after the scene). Keys and\n"
      "mouse:\n"
      "\n" +
          view::keys_text());
  app.allow_extras();
  Declarer declare(app);
  declare.text("SCENE", "", "glTF 2.0 file, .glb or .gltf",
               [&](const std::string& value) { options.render.scene = value; });
  declare_pictures(declare, options.render, app);
  declare_encoding(declare, options.render);
  declare_method(declare, options.render, "passes from each camera, then it rests");
  declare_camera(declare, options.render);
  declare_lights(declare, options.render);
  declare_machine(declare, options.render);
  declare_testing(declare, options.render);
}

void check_view(const CLI::App& app, ViewOptions& options) {
  check_extras(app);
  take_method(app, options.render);
  if (options.render.scene.empty()) throw CLI::ValidationError("SCENE", "no scene file is given");
  check_layers(app, options.render);
  check_shared(app, options.render);
}

}  // namespace ppm::cli
