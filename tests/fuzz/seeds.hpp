// Small sound files from which fuzzing starts.
#pragma once

#include <string>
#include <vector>

#include "made_document.hpp"

namespace ppm::fuzz {

struct Seed {
  std::string name;  ///< with the extension that the file should have
  test::Bytes bytes;
};

/// A file for each group of features that the loader reads; a few KB each.
std::vector<Seed> seeds();

}  // namespace ppm::fuzz
