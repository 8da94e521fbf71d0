// All figures of a comparison as CSV files.
#pragma once

#include <string>
#include <vector>

#include "analysis.hpp"
#include "figures.hpp"

namespace ppm::compare {

/// Each with a heading line; lines end as RFC 4180 wants them.

/// A line for each method, as the paper's Table 1: effort, time, errors and their ratio to
/// `against` (the RMSE of ppm; 0: no ratio).
std::string table_csv(const std::vector<MethodResult>& results, double against);
/// A line for each picture of each run: what the curves show.
std::string errors_csv(const std::vector<MethodResult>& results);
/// N, R and L of each probe after each pass.
std::string figure4_csv(const Figures& figures);
/// What was rendered for the pictures of Figure 5.
std::string figure5_csv(const Figures& figures);

/// RMSE of the first method that is ppm and has runs; 0 where there is none.
double rmse_of_ppm(const std::vector<MethodResult>& results);

}  // namespace ppm::compare
