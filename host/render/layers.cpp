#include "layers.hpp"

#include <algorithm>

#include "failure.hpp"

namespace ppm::render {
namespace {

constexpr std::uint32_t kSamples = 16;

}  // namespace

const std::vector<LayerFacts>& all_layers() {
  static const std::vector<LayerFacts> facts = {
      {LayerKind::albedo, "albedo", {"Albedo.R", "Albedo.G", "Albedo.B"}, false, false},
      {LayerKind::normal, "normal", {"Ns.X", "Ns.Y", "Ns.Z"}, false, false},
      {LayerKind::geometric_normal, "geometric-normal", {"N.X", "N.Y", "N.Z"}, false, false},
      {LayerKind::depth, "depth", {"Z"}, true, false},
      {LayerKind::position, "position", {"P.X", "P.Y", "P.Z"}, true, false},
      {LayerKind::radius, "radius", {"Radius"}, true, true},
      {LayerKind::photons, "photons", {"Photons"}, true, true},
      {LayerKind::density, "density", {"Density"}, true, true},
      {LayerKind::direct_emission,
       "direct-emission",
       {"DirectEmission.R", "DirectEmission.G", "DirectEmission.B"},
       false,
       true},
  };
  return facts;
}

const LayerFacts& facts_of(LayerKind kind) {
  return all_layers()[static_cast<std::size_t>(kind)];
}

std::optional<LayerKind> layer_named(std::string_view name) {
  const auto found = std::ranges::find(all_layers(), name, &LayerFacts::name);
  if (found == all_layers().end()) return std::nullopt;
  return found->kind;
}

bool method_has_layer(std::string_view integrator, LayerKind kind) {
  // Hit points are what has a radius.
  return !facts_of(kind).of_hit_points || method_named(integrator).has_option("--radius");
}

image::Layer empty_layer(LayerKind kind, std::uint64_t pixels) {
  const LayerFacts& facts = facts_of(kind);
  return {std::string(facts.name), facts.channels,
          std::vector<float>(facts.channels.size() * pixels), facts.precise};
}

std::vector<image::Layer> layers_of(Integrator& integrator, std::span<const LayerKind> kinds) {
  if (kinds.empty()) return {};
  auto* const source = dynamic_cast<LayerSource*>(&integrator);
  std::vector<image::Layer> layers;
  if (source) layers = source->layers(kinds);
  if (layers.size() < kinds.size()) {
    throw Failure("", "--aov", "the method has no such layers", "leave them out");
  }
  return layers;
}

std::uint32_t layer_samples(const Settings& settings) {
  const bool drawn_at_once = method_named(settings.integrator).unit == PassUnit::photons;
  return drawn_at_once ? settings.samples_per_pixel : kSamples;
}

}  // namespace ppm::render
