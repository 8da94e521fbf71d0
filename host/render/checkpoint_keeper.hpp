// When a rendering's checkpoint is written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "checkpoint.hpp"
#include "elsewhere.hpp"
#include "log.hpp"

namespace ppm::render {

/// What keeps a rendering so that it can go on another time.
struct Keeping {
  std::filesystem::path file;      ///< empty: nothing is kept
  double every_seconds = 60.0;     ///< at least, between two of them
  std::vector<std::string> words;  ///< as Checkpoint has them
  std::vector<PartHash> parts;
};

class CheckpointKeeper {
 public:
  /// `facts`: all that stays as it is. Where `keeping` names no file nothing is ever done.
  CheckpointKeeper(const Keeping& keeping, Checkpoint facts, Log& log);

  /// Writes the first one, before the first pass; throws Failure where the method's state cannot be
  /// kept or the disk does not take it.
  void begin(Integrator& integrator, const Statistics& statistics, double seconds);
  /// Whether enough time has passed since the last one.
  bool due() const;
  /// Writes it; throws Failure. The next one is due after the usual time in any case.
  void keep(Integrator& integrator, const Statistics& statistics, double seconds);
  /// Writes the last one, unless that was just done, elsewhere if need be; throws Failure.
  void finish(Integrator& integrator, const Statistics& statistics, double seconds,
              Elsewhere& elsewhere);

 private:
  void write(const std::filesystem::path& file, Integrator& integrator,
             const Statistics& statistics, double seconds);

  std::filesystem::path file_;
  double every_seconds_;
  Checkpoint checkpoint_;
  Log& log_;
  double last_;                           // reading of the clock
  std::optional<std::uint64_t> written_;  // passes of the one that is on the disk
};

}  // namespace ppm::render
