// A whole comparison: renderings, reference, figures and the report.
#pragma once

#include <filesystem>

#include "log.hpp"
#include "page.hpp"
#include "plan.hpp"
#include "timed_run.hpp"

namespace ppm::compare {

enum class Outcome { complete, method_failed, interrupted };

/// Goes on with what the folder has and writes the report once all is there. A method that fails is
/// told to the log and in the report, and the others go on. `identity` is what the folder must have
/// been made for, `machine` what the report says of where it was made. Throws Failure where the
/// folder, the plan or the reference will not do.
Outcome compare(Stage& stage, const Plan& plan, const std::filesystem::path& path,
                const Options& identity, const Facts& machine, Log& log);

}  // namespace ppm::compare
