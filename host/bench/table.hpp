// Results for people.
#pragma once

#include <string>

#include "results.hpp"

namespace ppm::bench {

/// A figure with its unit, some eight characters: "271.3 ms", "3.15M/s", "412 MiB".
std::string value_text(const Figure& figure);

/// Where and how, then the rows: median, least, most, median absolute deviation, share, and the
/// rates and memory beside it; without parts that take hardly anything. Ends with a line break.
std::string results_table(const Results& results);

}  // namespace ppm::bench
