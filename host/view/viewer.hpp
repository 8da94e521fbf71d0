// The window's side of the viewer: events to orders, deliveries to the screen.
#pragma once

#include <functional>

#include "driver.hpp"
#include "painter.hpp"
#include "pose.hpp"
#include "window.hpp"

namespace ppm::view {

/// How the subject is looked at to begin with.
struct Stance {
  Pose pose;  ///< of the settings' camera
  image::Encoding encoding;
  /// What `render` makes of camera_options(pose). Throws Failure where it refuses that.
  std::function<scene::Camera(const Pose&)> camera_of;
};

/// Opens a window and renders what it shows until it is closed (complete) or the program is
/// interrupted. Throws what the rendering throws.
render::Outcome view(const Desktop& desktop, render::Integrator& integrator, const Subject& subject,
                     const Stance& stance, const render::Interruption& interruption);

}  // namespace ppm::view
