#include "inspect_command.hpp"

#include <cstdio>

#include "exit_code.hpp"
#include "inspect_report.hpp"
#include "load_gltf.hpp"
#include "scene_settings.hpp"

namespace ppm::cli {

int inspect_command(const InspectOptions& options) {
  Log log(Verbosity::quiet);  // warnings are part of the summary
  const RenderOptions& render = options.render;
  const MemoryLimits limits = memory_limits_for(render);
  const scene::Scene scene = scene::load_gltf(render.scene, log, load_options_for(render, limits));
  const render::Settings settings =
      fitting_settings(scene, settings_for(render, scene, log), render, limits, nullptr, log);
  const InspectReport report = inspect(scene, settings, log.warnings());
  std::fputs((options.json ? report_json(report) : report_text(report)).c_str(), stdout);
  return kDone;
}

}  // namespace ppm::cli
