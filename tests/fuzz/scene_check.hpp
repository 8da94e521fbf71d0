// What every scene promises that a loader yields, whatever the file was.
#pragma once

#include <string_view>

#include "scene.hpp"

namespace ppm::fuzz {

/// Ends the process, saying why: this is what a fuzzer takes for a finding.
[[noreturn]] void broken(std::string_view promise, std::string_view detail);

/// Ends the process unless indices are in range, numbers finite and within the ranges that
/// scene.hpp states.
void check_scene(const scene::Scene& scene);

}  // namespace ppm::fuzz
