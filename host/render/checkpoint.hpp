// A rendering between two passes as a file: all that it takes to go on as if it had never stopped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fingerprint.hpp"
#include "integrator.hpp"

namespace ppm::render {

struct Checkpoint {
  std::string program;         ///< "ppm-vk 0.1.0"
  std::string device, driver;  ///< bits are the same on one of each
  std::string scene;           ///< file, for people
  std::string integrator;
  std::uint32_t width = 0, height = 0;
  /// The command line's words after the verb, in the form `--name=value`, paths absolute. None has
  /// a zero byte.
  std::vector<std::string> words;
  std::vector<PartHash> parts;  ///< of the scene as it was rendered
  double seconds = 0.0;         ///< of rendering
  Statistics statistics;
  SavedState state;
};

/// Whole or not at all, flushed to the disk; throws Failure.
void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint);

/// Throws Failure, which says why, unless the file is a checkpoint of this version and sound to the
/// last byte.
Checkpoint read_checkpoint(const std::filesystem::path& file);

/// Throws Failure, which names what differs, unless the rendering of this scene on this device by
/// this program can go on from the checkpoint that `file` held.
void check_continues(const std::filesystem::path& file, const Checkpoint& checkpoint,
                     const std::string& program, const std::vector<PartHash>& parts);
void check_device(const std::filesystem::path& file, const Checkpoint& checkpoint,
                  const std::string& device, const std::string& driver);

}  // namespace ppm::render
