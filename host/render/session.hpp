// The passes of one call of drive, and what is kept, shown and told between them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>

#include "checkpoint_keeper.hpp"
#include "driver.hpp"
#include "elsewhere.hpp"
#include "live_display.hpp"
#include "picture_change.hpp"
#include "preview.hpp"
#include "progress.hpp"
#include "resumed_statistics.hpp"

namespace ppm::render {

class Session {
 public:
  /// What is passed by reference must outlive it. `resumed`: as for drive.
  Session(Integrator& integrator, const Settings& settings, const Budget& budget,
          const Outputs& outputs, const Circumstances& circumstances,
          std::function<bool()> interrupted, Log& log, Checkpoint* resumed);

  /// Prepares or restores, then advances. Returns whether the budget was spent, or the method is
  /// complete; false: it was interrupted.
  bool advance_all();

  /// Of the rendering, and not of this session alone.
  Statistics statistics();
  /// Throws Failure where the last checkpoint cannot be written anywhere.
  void keep_last(Elsewhere& elsewhere);
  /// The preview once more, and the viewer's picture.
  void show_last(const Picture& picture);
  /// As the outputs ask for it, with the attributes of the passes so far. `layers`: where the file
  /// takes any.
  void write_picture(const std::filesystem::path& file, const Picture& picture,
                     std::span<const image::Layer> layers = {});

 private:
  bool begin();
  bool make_passes();
  void restore();
  void look_at_picture();
  void keep();
  /// Does `deed`; of a Failure no more comes than a warning that ends with `consequence`, unless
  /// the device is lost.
  void attempt(const std::function<void()>& deed, const char* consequence);
  std::uint64_t passes() { return integrator_.statistics().passes; }
  double seconds() const;
  std::optional<double> seconds_left() const;
  bool spent();
  std::uint64_t passes_at_a_time(std::uint64_t made, double since) const;

  Integrator& integrator_;
  const Settings& settings_;
  const Budget& budget_;
  const Outputs& outputs_;
  const Circumstances& circumstances_;
  std::function<bool()> interrupted_;
  Log& log_;
  Checkpoint* resumed_;
  double start_;  // of the time that the budget is of, by the clock
  CheckpointKeeper keeper_;
  Preview preview_;
  LiveDisplay display_;
  Progress progress_;
  bool measures_change_;
  ChangeMeter change_;
  std::optional<ResumedStatistics> before_;
  bool prepared_ = false;
};

}  // namespace ppm::render
