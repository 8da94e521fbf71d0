// The report: index.html, and beside it every figure as CSV, every picture as EXR and PNG.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis.hpp"
#include "figures.hpp"
#include "page.hpp"
#include "plan.hpp"
#include "reference.hpp"
#include "report_folder.hpp"

namespace ppm::compare {

/// `failures` by what failed. Throws Failure where a file cannot be written.
void write_report(const ReportFolder& folder, const Plan& plan,
                  const std::vector<MethodResult>& results, const Reference& reference,
                  const std::optional<Figures>& figures, const Facts& machine,
                  const std::map<std::string, std::string>& failures);

}  // namespace ppm::compare
