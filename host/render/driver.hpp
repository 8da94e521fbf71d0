// Runs an integrator: budget, signals, progress, pictures and the statistics file. Knows of no
// method.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "checkpoint_keeper.hpp"
#include "image.hpp"
#include "integrator.hpp"
#include "layers.hpp"
#include "log.hpp"
#include "progress.hpp"
#include "tev.hpp"

namespace ppm::render {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP (its terminal went away) is only noted; a
/// second SIGINT or SIGTERM ends the program at once. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  bool requested() const;
};

/// When a rendering is complete: as soon as either is spent, or the method has all it can take.
/// What was done before a checkpoint counts.
struct Budget {
  std::optional<std::uint64_t> passes;  ///< nothing: any number
  /// From the call of `drive` on. The pass in hand then is finished. Nothing: any time.
  std::optional<double> seconds;
};

/// Where the results go.
struct Outputs {
  std::vector<std::filesystem::path> pictures;
  image::Encoding encoding;
  std::vector<LayerKind> layers;     ///< in pictures that take them
  std::filesystem::path statistics;  ///< JSON; empty: none
  Keeping keeping;
  std::filesystem::path preview;  ///< a picture, too; empty: none
  double preview_seconds = 5.0;   ///< at least, between two of them
  /// Folder for what cannot be written where it should at the end; empty: none.
  std::filesystem::path fallback;
  std::optional<display::TevAddress> display;  ///< viewer of the picture so far
  ProgressStyle progress = ProgressStyle::text;
};

/// What the driver reports about and cannot know. The frame is that of `settings.camera`.
struct Circumstances {
  std::string program;  ///< "ppm-vk 0.1.0"
  std::string device, driver;
  std::filesystem::path scene;
  scene::Frame frame;
  std::vector<image::Attribute> load_attributes;  ///< how the scene was read
  double load_seconds = 0.0;
  double seconds_before = 0.0;  ///< from the program's start to the call of drive
  std::function<std::uint64_t()> device_memory_bytes;  ///< most that was allocated
};

enum class Outcome { complete, interrupted };

/// Throws Failure unless every file of `outputs` could be written, layers' own ones included.
void check_outputs(const Outputs& outputs);

/// Prepares `integrator`, or restores it from a checkpoint, and advances it until the budget is
/// spent or `interruption` is requested; then writes the checkpoint, the picture so far and the
/// statistics. Calls check_outputs first. When one file cannot be written the others are all the
/// same, and then the Failure is thrown; checkpoints and previews on the way are only warned of.
/// `resumed` may be null; its state is let go of once it is restored.
Outcome drive(Integrator& integrator, const Settings& settings, const Budget& budget,
              const Outputs& outputs, const Circumstances& circumstances,
              const Interruption& interruption, Log& log, Checkpoint* resumed = nullptr);

}  // namespace ppm::render
