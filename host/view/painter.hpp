// The rendering's side of the viewer: passes, pictures and answers, on a thread of its own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "driver.hpp"
#include "integrator.hpp"
#include "layers.hpp"
#include "mailbox.hpp"

namespace ppm::view {

/// What is rendered, and where it is written to.
struct Subject {
  render::Settings settings;
  const render::Circumstances& circumstances;
  std::optional<std::uint64_t> passes;  ///< after which the rendering rests; nothing: any number
  std::vector<std::filesystem::path> files;  ///< empty: numbered ones after the scene
  std::vector<render::LayerKind> layers;     ///< in files that take them
};

class Painter {
 public:
  /// All must outlive it. `integrator`: new.
  Painter(render::Integrator& integrator, const Subject& subject, Mailbox& mailbox);

  /// Renders until the mailbox says that it is to end. From each camera a first picture is shown
  /// even when the next camera waits already: who drags wants to see where to.
  void run();

 private:
  bool spent();
  bool rests();
  void follow(const Orders& orders);
  /// False: it is to end.
  bool render_on();
  std::uint64_t passes_at_a_time() const;
  void look_at_picture();
  void answer();
  void show();
  void save(const image::Encoding& encoding);
  Reading reading_of(glm::uvec2 pixel);
  std::uint64_t passes() { return integrator_.statistics().passes; }

  render::Integrator& integrator_;
  render::Settings settings_;
  const Subject& subject_;
  Mailbox& mailbox_;
  bool prepared_ = false;
  std::uint64_t camera_number_ = 0;
  std::shared_ptr<const render::Picture> picture_;  // shown last, of this camera
  std::uint64_t shown_passes_ = 0;                  // that it has
  double next_ = 0.0;                               // reading of the clock; it stays that long
  double pass_seconds_ = 0.0;
  std::optional<glm::uvec2> watched_;  // pixel
  bool asked_ = false;                 // to tell of it
  std::optional<image::Encoding> save_as_;
};

}  // namespace ppm::view
