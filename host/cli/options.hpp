// The command line as plain values. CLI11 is known to options.cpp, *_options.* and declarer.*
// alone.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "glm/glm.hpp"
#include "image.hpp"
#include "integrator.hpp"
#include "layers.hpp"
#include "load_gltf.hpp"
#include "log.hpp"
#include "tev.hpp"

namespace ppm::cli {

/// Pixels of a picture's side, at most.
inline constexpr std::uint32_t kLargestSide = 32768;

enum class Verb { render, resume, view, compare, bench, inspect, info, devices, nothing };

/// How long a rendering goes on, beside passes and time, and what it leaves and tells on the way.
struct RunOptions {
  std::optional<std::uint64_t> total_photons;  ///< the pass that reaches them is finished
  std::filesystem::path checkpoint;            ///< empty: none is written
  double checkpoint_seconds = 60.0;            ///< between two of them
  std::filesystem::path preview;               ///< empty: none
  double preview_seconds = 5.0;                ///< between two of them
  std::filesystem::path fallback;              ///< folder; empty: none
  bool progress_json = false;
  /// The command line as render::Checkpoint::words has it.
  std::vector<std::string> words;
};

/// `ppm-vk render ...`, checked for all that can be checked without opening a file.
struct RenderOptions {
  std::filesystem::path scene;
  scene::LoadOptions load;  ///< what of the file is read
  std::vector<std::filesystem::path> outputs;
  std::optional<std::uint32_t> width,
      height;  ///< Settings::width and height follow once the camera is known
  std::optional<std::uint64_t> passes;
  std::uint64_t usual_passes = 64;  ///< where nothing says when it ends; 0: it does not
  std::optional<double> seconds;    ///< that the rendering may take
  std::string camera;               ///< name or index, empty: the first
  std::optional<glm::dvec3> camera_position, camera_target, camera_up;  ///< world units
  std::optional<double> camera_fov;  ///< full vertical angle, degrees
  image::Encoding encoding;
  std::vector<render::LayerKind> layers;
  std::filesystem::path stats;
  std::optional<display::TevAddress> display;
  unsigned threads = 0;                        ///< host threads, 0: all
  std::optional<std::uint64_t> memory_budget;  ///< bytes; nothing: what the machine has
  Verbosity verbosity = Verbosity::normal;
  gpu::DeviceOptions device;
  RunOptions run;
  render::Settings settings;  ///< all but width, height, camera

  std::uint64_t passes_or_usual() const { return passes.value_or(usual_passes); }
};

/// `ppm-vk view ...`, likewise.
struct ViewOptions {
  ViewOptions() { render.usual_passes = 0; }

  RenderOptions render;  ///< `outputs` are what the picture is written to when that is asked for
};

/// `ppm-vk bench ...`, likewise.
struct BenchOptions {
  BenchOptions() {
    render.usual_passes = 4;
    render.settings.samples_per_pixel = 1;
  }

  std::vector<std::string> scenes;  ///< built-in names and files; empty: all built-in ones
  unsigned repetitions = 5;
  std::uint64_t warmup = 1;       ///< passes left out
  bool aged = false;              ///< also once radii have halved
  bool scaling = false;           ///< the table of ratios instead of scenes
  std::string json;               ///< file, "-": stdout, empty: none
  std::filesystem::path compare;  ///< earlier results; empty: none
  std::filesystem::path with;     ///< later results, instead of measuring; empty: none
  double tolerance = 0.1;
  RenderOptions render;  ///< how each scene is rendered; `passes` are those timed a repetition
};

/// A method as `ppm-vk compare --methods` names it.
struct NamedMethod {
  std::string label;          ///< "ppm:alpha=0.8"
  render::Settings settings;  ///< as RenderOptions::settings
};

/// `ppm-vk compare ...`, likewise.
struct CompareOptions {
  RenderOptions render;  ///< what all methods have in common; `seconds` are those of each
  std::filesystem::path report;
  std::vector<NamedMethod> methods;
  unsigned seeds = 1;
  std::filesystem::path reference;  ///< of the user; empty: it is made
  std::optional<double> reference_seconds;
  std::optional<NamedMethod> reference_method;
  unsigned reference_seeds = 4;
  std::vector<glm::uvec2> probes;
  bool figure5 = false;
  std::uint64_t figure_passes = 1024;
  std::vector<glm::uvec4> crops;  ///< x, y, width, height
  std::optional<double> exposure;
};

/// `ppm-vk inspect ...`: `render` says of which rendering the memory is reckoned.
struct InspectOptions {
  RenderOptions render;
  bool json = false;
};

/// `ppm-vk resume ...`, likewise.
struct ResumeOptions {
  std::filesystem::path checkpoint;
  std::vector<std::string> words;  ///< what differs from those in the checkpoint, in their form
};

/// `ppm-vk info ...`, likewise.
struct InfoOptions {
  std::filesystem::path file;
  bool json = false;
};

struct Options {
  Verb verb = Verb::nothing;
  int exit_code =
      0;  ///< for Verb::nothing: help and version were printed (0) or usage is wrong (2)
  RenderOptions render;
  ViewOptions view;
  CompareOptions compare;
  BenchOptions bench;
  InspectOptions inspect;
  ResumeOptions resume;
  InfoOptions info;
};

/// Never throws for what a user can type: prints one line and yields Verb::nothing with exit
/// code 2.
Options parse(int argc, const char* const* argv);

/// Likewise, of the options of render with which a checkpoint goes on.
Options parse_resumed(const std::vector<std::string>& words);

}  // namespace ppm::cli
