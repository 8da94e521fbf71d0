// What the page says: words, tables and curves from results.
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

namespace ppm::compare {

std::vector<std::string> summary_of(const Plan& plan, const std::vector<MethodResult>& results,
                                    const Reference& reference);

/// As the paper's Table 1, with errors: heading, lines and notes of `content`.
void add_table(PageContent& content, const std::vector<MethodResult>& results);

/// RMSE and relative MSE against time.
std::vector<Plot> error_curves(const std::vector<MethodResult>& results,
                               const Reference& reference);

/// N, R and L against passes [HOJ08 Figure 4]; R alone on logarithmic axes, as there.
std::vector<Plot> figure4_plots(const Figures& figures);

/// What the method was told and how it went.
Facts parameters_of(const MethodResult& result);

}  // namespace ppm::compare
