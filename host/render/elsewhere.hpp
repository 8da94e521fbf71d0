// Another place for files that cannot be written where they should.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>

#include "log.hpp"

namespace ppm::render {

class Elsewhere {
 public:
  /// An empty folder: there is no other place.
  Elsewhere(std::filesystem::path folder, Log& log) : folder_(std::move(folder)), log_(log) {}

  /// Calls `write(file)`. Where that throws Failure, warns of it and calls `write` for a file of
  /// the same name in the folder; a name that is taken by an earlier call gets a number. Throws
  /// Failure where there is no folder or that failed, too.
  void write(const std::filesystem::path& file,
             const std::function<void(const std::filesystem::path&)>& write);

 private:
  std::filesystem::path folder_;
  Log& log_;
  std::set<std::string> taken_;
};

}  // namespace ppm::render
