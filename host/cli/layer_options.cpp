#include "layer_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "image.hpp"
#include "layers.hpp"

namespace ppm::cli {
namespace {

constexpr const char* kName = "--aov";

std::string known_layers() {
  std::string names;
  for (const render::LayerFacts& layer : render::all_layers()) {
    names += (names.empty() ? "" : ", ") + std::string(layer.name);
  }
  return names;
}

std::vector<render::LayerKind> parse_layers(std::string_view text) {
  std::vector<render::LayerKind> layers;
  for (;;) {
    const std::size_t comma = text.find(',');
    const std::string name(text.substr(0, comma));
    const std::optional<render::LayerKind> layer = render::layer_named(name);
    if (!layer) refuse(kName, name, "one of " + known_layers());
    if (std::ranges::find(layers, *layer) == layers.end()) layers.push_back(*layer);
    if (comma == std::string_view::npos) return layers;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace

void declare_layers(Declarer& declare, RenderOptions& options) {
  declare.text(kName, "NAME,...",
               "layers beside the picture, in EXR by name, with PFM as files beside it\n"
               "(p.pfm: p.albedo.pfm ...). All methods: albedo, normal (shading),\n"
               "geometric-normal, depth, position, through mirrors and smooth glass;\n"
               "ppm and pm: radius, photons, density, direct-emission",
               [&](const std::string& value) { options.layers = parse_layers(value); });
}

void check_layers(const CLI::App& app, const RenderOptions& options) {
  if (app.count(kName) == 0) return;
  for (const render::LayerKind kind : options.layers) {
    if (render::method_has_layer(options.settings.integrator, kind)) continue;
    throw CLI::ValidationError(
        kName, fmt::format("{} is no layer of --integrator {}: it has no hit points",
                           render::facts_of(kind).name, options.settings.integrator));
  }
  if (std::ranges::none_of(options.outputs, image::takes_layers)) {
    throw CLI::ValidationError(kName, "needs a picture that ends in .exr or .pfm");
  }
  for (const auto& output : options.outputs) {
    if (!image::takes_layers(output)) continue;
    for (const render::LayerKind kind : options.layers) {
      const auto file = image::layer_file(output, std::string(render::facts_of(kind).name));
      const bool clash = same_file(file, options.scene) || same_file(file, options.stats) ||
                         std::ranges::any_of(options.outputs, [&](const auto& other) {
                           return other != output && same_file(file, other);
                         });
      if (clash) refuse(kName, file.string(), "a file of its own");
    }
  }
}

}  // namespace ppm::cli
