#include "view_command.hpp"

#include "camera_choice.hpp"
#include "circumstances.hpp"
#include "driver.hpp"
#include "exit_code.hpp"
#include "load_gltf.hpp"
#include "scene_settings.hpp"
#include "viewer.hpp"

namespace ppm::cli {
namespace {

/// The camera that `render` chooses when it is given the options of the pose.
scene::Camera camera_of(const view::Pose& pose, RenderOptions options, const scene::Scene& scene) {
  options.camera_position = pose.position;
  options.camera_target = pose.target;
  options.camera_up.reset();
  if (pose.up != view::Pose().up) options.camera_up = pose.up;
  options.camera_fov.reset();
  if (!pose.half_height) options.camera_fov = pose.fov;
  Log silence(Verbosity::quiet);  // what there is to say of the camera was said of the first one
  return choose_camera(options, scene, silence);
}

}  // namespace

int view_command(const ViewOptions& view_options) {
  const RenderOptions& options = view_options.render;
  const render::Interruption interruption;
  const view::Desktop desktop;  // without one the scene need not be read
  Log log(options.verbosity);
  render::Outputs outputs;
  outputs.pictures = options.outputs;
  outputs.layers = options.layers;
  render::check_outputs(outputs);

  const MemoryLimits limits = memory_limits_for(options);
  scene::Scene scene = scene::load_gltf(options.scene, log, load_options_for(options, limits));
  if (interruption.requested()) return kInterrupted;
  render::Settings settings = settings_for(options, scene, log);
  const view::Pose pose = view::pose_of(settings.camera, scene, options.camera_target);
  gpu::Device device(options.device);
  settings = fitting_settings(scene, settings, options, limits, &device, log);
  const std::unique_ptr<render::Integrator> integrator =
      make_fitting_integrator(settings, scene, options, limits, device, log);
  scene::release_arrays(scene);

  const render::Circumstances circumstances = circumstances_for(scene, options.load, device);
  const view::Subject subject{settings, circumstances, options.passes, options.outputs,
                              options.layers};
  const view::Stance stance{pose, options.encoding, [&](const view::Pose& moved) {
                              return camera_of(moved, options, scene);
                            }};
  const render::Outcome outcome = view::view(desktop, *integrator, subject, stance, interruption);
  check_validation(device);
  return outcome == render::Outcome::interrupted ? kInterrupted : kDone;
}

}  // namespace ppm::cli
