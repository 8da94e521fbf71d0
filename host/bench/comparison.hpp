// Two benchmarks beside each other.
#pragma once

#include <string>
#include <vector>

#include "results.hpp"

namespace ppm::bench {

/// Rows below this share of their whole are shown, but what they take is too little to judge by.
inline constexpr double kLeastShare = 0.02;

enum class Verdict { alike, better, worse, too_small };

struct Difference {
  Figure before, after;  ///< of the same name
  double ratio = 1.0;    ///< after / before; infinite where only `before` is 0
  Verdict verdict = Verdict::alike;
};

struct Comparison {
  std::vector<Difference> differences;               ///< in the order of `after`
  std::vector<std::string> only_before, only_after;  ///< figures that the other lacks
  std::vector<std::string> different_context;        ///< "device: A, now B"
};

/// A figure is worse when its time or memory is more than (1 + tolerance) times what it was, or its
/// rate less than 1 / (1 + tolerance) of it; better the other way round.
Comparison compare(const Results& before, const Results& after, double tolerance);

/// A line a figure: old, new, ratio, verdict. Ends with a line break.
std::string comparison_table(const Comparison& comparison);

}  // namespace ppm::bench
