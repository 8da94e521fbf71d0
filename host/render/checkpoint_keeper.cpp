#include "checkpoint_keeper.hpp"

#include <fmt/format.h>

#include <utility>

#include "stopwatch.hpp"

namespace ppm::render {

CheckpointKeeper::CheckpointKeeper(const Keeping& keeping, Checkpoint facts, Log& log)
    : file_(keeping.file),
      every_seconds_(keeping.every_seconds),
      checkpoint_(std::move(facts)),
      log_(log),
      last_(clock_seconds()) {
  checkpoint_.words = keeping.words;
  checkpoint_.parts = keeping.parts;
}

void CheckpointKeeper::begin(Integrator& integrator, const Statistics& statistics, double seconds) {
  if (file_.empty()) return;
  write(file_, integrator, statistics, seconds);
  last_ = clock_seconds();
}

bool CheckpointKeeper::due() const {
  return !file_.empty() && clock_seconds() - last_ >= every_seconds_;
}

void CheckpointKeeper::keep(Integrator& integrator, const Statistics& statistics, double seconds) {
  last_ = clock_seconds();
  write(file_, integrator, statistics, seconds);
  last_ = clock_seconds();
}

void CheckpointKeeper::finish(Integrator& integrator, const Statistics& statistics, double seconds,
                              Elsewhere& elsewhere) {
  if (file_.empty() || written_ == statistics.passes) return;
  elsewhere.write(file_, [&](const std::filesystem::path& file) {
    write(file, integrator, statistics, seconds);
  });
}

void CheckpointKeeper::write(const std::filesystem::path& file, Integrator& integrator,
                             const Statistics& statistics, double seconds) {
  checkpoint_.state = integrator.save_state();
  checkpoint_.statistics = statistics;
  checkpoint_.seconds = seconds;
  write_checkpoint(file, checkpoint_);
  written_ = statistics.passes;
  checkpoint_.state = {};  // as large as a picture; the next one is another
  log_.note(fmt::format("wrote {} after pass {}", file.string(), statistics.passes));
}

}  // namespace ppm::render
