// Materials of solids that nest.
#pragma once

#include "gltf_writer.hpp"

namespace ppm::test {

/// Where solids overlap the one of the highest priority counts.
inline nlohmann::json with_priority(nlohmann::json material, int priority) {
  material["extras"]["priority"] = priority;
  return material;
}

}  // namespace ppm::test
