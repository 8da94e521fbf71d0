#include "compare_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "circumstances.hpp"
#include "compare.hpp"
#include "driver.hpp"
#include "exit_code.hpp"
#include "failure.hpp"
#include "fingerprint.hpp"
#include "load_gltf.hpp"
#include "machine.hpp"
#include "scene_settings.hpp"

namespace ppm::cli {
namespace {

constexpr double kReferenceFactor = 10.0;
// Unbiased, the best first.
constexpr std::string_view kCandidates[] = {"bdpt", "pt-mis", "pt"};
constexpr std::size_t kMostCandidates = 2;

/// Of the method, with the camera and the size that the scene has.
compare::Method method_for(const NamedMethod& named, const render::Settings& common) {
  compare::Method method{named.label, named.settings};
  method.settings.camera = common.camera;
  method.settings.width = common.width;
  method.settings.height = common.height;
  return method;
}

compare::Method method_by_name(std::string_view name, const render::Settings& common) {
  compare::Method method{std::string(name), common};
  method.settings.integrator = name;
  if (render::method_named(name).unit != render::PassUnit::photons) {
    method.settings.samples_per_pixel = 1;
  }
  return method;
}

compare::ReferencePlan reference_plan(const CompareOptions& options, const render::Settings& common,
                                      double seconds) {
  compare::ReferencePlan plan;
  plan.file = options.reference;
  plan.seconds = options.reference_seconds.value_or(kReferenceFactor * seconds);
  plan.seeds = options.reference_seeds;
  if (options.reference_method) {
    plan.method = method_for(*options.reference_method, common);
  }
  plan.photons = method_by_name("ppm", compare::reference_settings(common));
  for (const std::string_view name : kCandidates) {
    const bool takes_part =
        std::any_of(options.methods.begin(), options.methods.end(),
                    [&](const NamedMethod& method) { return method.settings.integrator == name; });
    if (takes_part || !render::is_method(name) || plan.candidates.size() == kMostCandidates)
      continue;
    plan.candidates.push_back(method_by_name(name, common));
  }
  return plan;
}

compare::FigurePlan figure_plan(const CompareOptions& options, const render::Settings& common,
                                const std::vector<compare::Method>& methods) {
  compare::FigurePlan plan;
  if (!options.figure5 && options.probes.empty()) return plan;
  const auto ppm = std::find_if(methods.begin(), methods.end(), [](const compare::Method& method) {
    return method.settings.integrator == "ppm";
  });
  plan.method = ppm != methods.end() ? *ppm : method_by_name("ppm", common);
  for (const glm::uvec2& probe : options.probes) plan.probes.push_back({probe.x, probe.y});
  plan.last_pass = options.figure_passes;
  if (options.figure5) plan.passes = compare::figure5_passes(plan.last_pass);
  return plan;
}

compare::Plan plan_for(const CompareOptions& options, const scene::Scene& scene, Log& log) {
  const render::Settings common = settings_for(options.render, scene, log);
  compare::Plan plan;
  plan.first_seed = common.seed;
  plan.seeds = options.seeds;
  plan.seconds = *options.render.seconds;
  plan.exposure = options.exposure;
  for (const NamedMethod& named : options.methods) {
    plan.methods.push_back(method_for(named, common));
  }
  plan.reference = reference_plan(options, common, plan.seconds);
  plan.figures = figure_plan(options, common, plan.methods);
  for (const glm::uvec4& crop : options.crops) {
    plan.crops.push_back({crop.x, crop.y, crop.z, crop.w});
  }
  return plan;
}

/// What must be the same where a folder is to go on.
compare::Options identity_of(const scene::Scene& scene, const render::Circumstances& circumstances,
                             const render::Settings& size) {
  render::Hash hash;
  render::add_scene(hash, scene);
  return {{"scene contents", fmt::format("{:016x}", hash.value())},
          {"width", std::to_string(size.width)},
          {"height", std::to_string(size.height)},
          {"program", circumstances.program},
          {"device", circumstances.device},
          {"driver", circumstances.driver}};
}

compare::Facts machine_facts(const scene::Scene& scene, const render::Circumstances& circumstances,
                             const render::Settings& size, const CompareOptions& options) {
  const bench::Machine machine = bench::describe_machine();
  compare::Facts facts = {{"scene", circumstances.scene.filename().string()},
                          {"triangles", std::to_string(scene.triangles.size())},
                          {"picture", fmt::format("{} x {} pixels", size.width, size.height)},
                          {"program", circumstances.program},
                          {"device", circumstances.device},
                          {"driver", circumstances.driver},
                          {"machine", fmt::format("{}: {} processors at {} MHz", machine.host_name,
                                                  machine.processors, machine.megahertz)},
                          {"host threads", std::to_string(thread_count(options.render.threads))},
                          {"report written", machine.date}};
  if (!machine.load_average.empty()) {
    facts.emplace_back("load of the machine, last minute",
                       fmt::format("{:.2f}", machine.load_average.front()));
  }
  return facts;
}

}  // namespace

int compare_command(const CompareOptions& options) {
  const render::Interruption interruption;
  Log log(options.render.verbosity);
  const MemoryLimits limits = memory_limits_for(options.render);
  const scene::Scene scene =
      scene::load_gltf(options.render.scene, log, load_options_for(options.render, limits));
  if (interruption.requested()) {
    log.warn("interrupted while the scene was read; nothing is written");
    return kInterrupted;
  }
  const compare::Plan plan = plan_for(options, scene, log);
  const render::Settings& size = plan.methods.front().settings;
  gpu::Device device(options.render.device);
  compare::Stage stage{.scene = scene,
                       .device = device,
                       .circumstances = circumstances_for(scene, options.render.load, device),
                       .threads = thread_count(options.render.threads),
                       .interrupted = [&] { return interruption.requested(); },
                       .tell =
                           [&](const std::string& line) {
                             if (options.render.verbosity == Verbosity::quiet) return;
                             std::fprintf(stderr, "ppm-vk: %s\n", line.c_str());
                           },
                       .admit =
                           [&](const render::Settings& settings) {
                             return fitting_settings(scene, settings, options.render, limits,
                                                     &device, log);
                           },
                       .warm = {}};
  const compare::Outcome outcome =
      compare::compare(stage, plan, options.report, identity_of(scene, stage.circumstances, size),
                       machine_facts(scene, stage.circumstances, size, options), log);
  check_validation(device);
  if (outcome == compare::Outcome::interrupted) {
    log.warn(fmt::format("interrupted; the same command goes on with what {} has",
                         options.report.string()));
    return kInterrupted;
  }
  log.note(fmt::format("wrote {}", (options.report / "index.html").string()));
  if (outcome == compare::Outcome::method_failed) {
    throw Failure((options.report / "index.html").string(), "",
                  "not every method could render this", "see there for what was wrong");
  }
  return kDone;
}

}  // namespace ppm::cli
