// Results as Google Benchmark writes its own, so that its tools can read them.
#pragma once

#include <filesystem>
#include <string>

#include "machine.hpp"
#include "results.hpp"

namespace ppm::bench {

/// "context" tells of the machine as Google Benchmark does, and of everything in results.context;
/// "benchmarks" has an entry for every repetition of every row and then its mean, median, standard
/// deviation, coefficient of variation and median absolute deviation. Times are microseconds;
/// "cpu_time" is "real_time" where only the device's clock saw a row.
std::string results_json(const Results& results, const Machine& machine);

/// Reads what results_json wrote: all repetitions, and of the context what is text. Throws Failure
/// when the file cannot be read, is no JSON, or not of this program.
Results read_results(const std::filesystem::path& file);

/// The same from the file's text; `file` is what a Failure names.
Results parse_results(const std::string& text, const std::string& file);

}  // namespace ppm::bench
