// What pictures and reports say of how a rendering came about.
#pragma once

#include "device.hpp"
#include "driver.hpp"
#include "load_gltf.hpp"
#include "scene.hpp"

namespace ppm::cli {

/// `device` must outlive them. Times are left to the caller.
render::Circumstances circumstances_for(const scene::Scene& scene, const scene::LoadOptions& load,
                                        const gpu::Device& device);

/// Throws Failure where --validate found fault.
void check_validation(const gpu::Device& device);

}  // namespace ppm::cli
