// A rendering of the comparison that is there already, or is made now.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "report_folder.hpp"
#include "timed_run.hpp"

namespace ppm::compare {

/// The run `name` of the folder; where it is missing the method's pipelines are made and warmed up
/// (two passes of a tiny picture, thrown away, once for each method), a line is told and it is
/// rendered. `finish` may add files to its folder. Nothing when interrupted. Throws Failure where
/// the method fails or the folder's run is another.
std::optional<RunRecord> rendering(
    Stage& stage, const ReportFolder& folder, const std::string& name, const Method& method,
    std::uint32_t seed, const Schedule& schedule,
    const std::function<void(const std::filesystem::path&)>& finish = {});

/// "ppm-0": where a run of the comparison itself is.
std::string run_name(const Method& method, std::uint32_t seed);

}  // namespace ppm::compare
