#include "figures.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "failure.hpp"
#include "output_file.hpp"
#include "rendering.hpp"

namespace ppm::compare {
namespace {

constexpr const char* kProbes = "probes.json";

/// All that the run depends on beside the method's options.
std::string figures_name(const FigurePlan& plan) {
  std::string name = fmt::format("figures-{}", plan.last_pass);
  for (const std::uint64_t passes : plan.passes) {
    if (passes != plan.last_pass) name += fmt::format("-{}", passes);
  }
  for (const PixelPosition& probe : plan.probes) name += fmt::format("_{}.{}", probe.x, probe.y);
  return name;
}

std::string probes_json(const std::vector<ProbeCurve>& curves) {
  nlohmann::json json = nlohmann::json::array();
  for (const ProbeCurve& curve : curves) {
    nlohmann::json samples = nlohmann::json::array();
    for (const auto& [passes, reading] : curve.samples) {
      samples.push_back({passes, reading.photons, reading.radius, reading.radiance[0],
                         reading.radiance[1], reading.radiance[2]});
    }
    json.push_back({{"x", curve.at.x}, {"y", curve.at.y}, {"samples", samples}});
  }
  return json.dump() + "\n";
}

std::vector<ProbeCurve> read_probes(const std::filesystem::path& file) {
  try {
    std::ifstream stream(file, std::ios::binary);
    std::vector<ProbeCurve> curves;
    for (const auto& entry : nlohmann::json::parse(stream)) {
      ProbeCurve& curve = curves.emplace_back();
      curve.at = {entry.at("x"), entry.at("y")};
      for (const auto& sample : entry.at("samples")) {
        curve.samples.push_back(
            {sample.at(0),
             {sample.at(1), sample.at(2), {sample.at(3), sample.at(4), sample.at(5)}}});
      }
    }
    return curves;
  } catch (const nlohmann::json::exception&) {
    throw Failure(file.string(), "", "no readings of probes",
                  "remove its folder to have it rendered again");
  }
}

}  // namespace

std::optional<Figures> make_figures(Stage& stage, const ReportFolder& folder, const Plan& plan) {
  if (!plan.figures.method) return std::nullopt;
  std::vector<ProbeCurve> probes;
  for (const PixelPosition& probe : plan.figures.probes) probes.push_back({probe, {}});
  Schedule schedule;
  schedule.passes = plan.figures.passes;
  schedule.last_pass = plan.figures.last_pass;
  schedule.pass_by_pass = !probes.empty();
  schedule.after_passes = [&](render::Integrator& integrator) {
    for (ProbeCurve& curve : probes) {
      const auto reading = integrator.probe(curve.at.x, curve.at.y);
      if (reading) curve.samples.push_back({integrator.statistics().passes, *reading});
    }
  };
  const std::string name = figures_name(plan.figures);
  const auto record = rendering(
      stage, folder, name, *plan.figures.method, plan.first_seed, schedule,
      [&](const std::filesystem::path& part) { write_whole(part / kProbes, probes_json(probes)); });
  if (!record) return std::nullopt;
  return Figures{read_probes(folder.run_folder(name) / kProbes), *record, name};
}

}  // namespace ppm::compare
