// Comparisons with planted differences.
#include "comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ppm::bench {
namespace {

/// A pass of 100 ms at 1000 rays a second in 1000 bytes, and a kernel in it.
Results baseline() {
  Results results;
  results.context = {{"device", "A"}, {"date", "yesterday"}};
  results.rows.push_back({"room/pass", 1, {0.1}, {}, {}});
  results.rows.back().counters = {{"photon_rays_per_second", {1000.0}},
                                  {"device_memory_bytes", {1000.0}},
                                  {"hit_points", {5.0}}};
  results.rows.push_back({"room/kernel:gather", 1, {0.05}, {}, {{"share", {0.5}}}});
  return results;
}

Verdict verdict_on(const Comparison& comparison, const std::string& name) {
  const auto found =
      std::find_if(comparison.differences.begin(), comparison.differences.end(),
                   [&](const Difference& difference) { return difference.after.name == name; });
  EXPECT_NE(found, comparison.differences.end()) << name;
  return found == comparison.differences.end() ? Verdict::alike : found->verdict;
}

Verdict verdict_on_time(double ratio, double tolerance) {
  Results after = baseline();
  after.rows[0].seconds[0] *= ratio;
  return verdict_on(compare(baseline(), after, tolerance), "room/pass");
}

Verdict verdict_on_counter(const char* counter, double value) {
  Results after = baseline();
  after.rows[0].counters[counter] = {value};
  return verdict_on(compare(baseline(), after, 0.1), std::string("room/pass ") + counter);
}

TEST(Comparison, TheSameIsAlike) {
  const Comparison comparison = compare(baseline(), baseline(), 0.0);
  ASSERT_EQ(comparison.differences.size(), 4u);  // two times, a rate, memory; not the hit points
  for (const Difference& difference : comparison.differences) {
    EXPECT_EQ(difference.verdict, Verdict::alike) << difference.after.name;
    EXPECT_EQ(difference.ratio, 1.0);
  }
  EXPECT_TRUE(comparison.only_before.empty());
  EXPECT_TRUE(comparison.only_after.empty());
  EXPECT_TRUE(comparison.different_context.empty());
}

TEST(Comparison, MoreTimeIsWorse) {
  EXPECT_EQ(verdict_on_time(1.09, 0.1), Verdict::alike);
  EXPECT_EQ(verdict_on_time(1.11, 0.1), Verdict::worse);
  EXPECT_EQ(verdict_on_time(0.92, 0.1), Verdict::alike);  // 1 / 1.1 = 0.909
  EXPECT_EQ(verdict_on_time(0.90, 0.1), Verdict::better);
}

TEST(Comparison, ToleranceItselfIsTolerated) {
  EXPECT_EQ(verdict_on_time(1.5, 0.5), Verdict::alike);  // exact in binary
  EXPECT_EQ(verdict_on_time(std::nextafter(1.5, 2.0) + 1e-15, 0.5), Verdict::worse);
  EXPECT_EQ(verdict_on_time(1.0 + 1e-9, 0.0), Verdict::worse);
}

TEST(Comparison, LessRateIsWorse) {
  EXPECT_EQ(verdict_on_counter("photon_rays_per_second", 1200.0), Verdict::better);
  EXPECT_EQ(verdict_on_counter("photon_rays_per_second", 920.0), Verdict::alike);
  EXPECT_EQ(verdict_on_counter("photon_rays_per_second", 900.0), Verdict::worse);
}

TEST(Comparison, MoreMemoryIsWorse) {
  EXPECT_EQ(verdict_on_counter("device_memory_bytes", 1200.0), Verdict::worse);
  EXPECT_EQ(verdict_on_counter("device_memory_bytes", 1050.0), Verdict::alike);
  EXPECT_EQ(verdict_on_counter("device_memory_bytes", 800.0), Verdict::better);
}

TEST(Comparison, MediansAreCompared) {
  Results before = baseline(), after = baseline();
  before.rows[0].seconds = {0.1, 0.1, 0.1};
  after.rows[0].seconds = {0.1, 9.0, 0.1};
  EXPECT_EQ(verdict_on(compare(before, after, 0.1), "room/pass"), Verdict::alike);
}

TEST(Comparison, PartsThatTakeHardlyAnythingAreNotJudged) {
  Results before = baseline(), after = baseline();
  after.rows[1].seconds[0] *= 10.0;
  EXPECT_EQ(verdict_on(compare(before, after, 0.1), "room/kernel:gather"), Verdict::worse);
  before.rows[1].counters["share"] = after.rows[1].counters["share"] = {0.9 * kLeastShare};
  EXPECT_EQ(verdict_on(compare(before, after, 0.1), "room/kernel:gather"), Verdict::too_small);
  // But one that has grown out of it is.
  after.rows[1].counters["share"] = {0.09};
  EXPECT_EQ(verdict_on(compare(before, after, 0.1), "room/kernel:gather"), Verdict::worse);
}

TEST(Comparison, WhatOnlyOneHasIsNamed) {
  Results before = baseline(), after = baseline();
  before.rows[1].name = "room/kernel:old";
  after.rows[1].name = "room/kernel:new";
  after.rows[0].counters.erase("device_memory_bytes");
  const Comparison comparison = compare(before, after, 0.1);
  EXPECT_EQ(comparison.only_before,
            (std::vector<std::string>{"room/kernel:old", "room/pass device_memory_bytes"}));
  EXPECT_EQ(comparison.only_after, (std::vector<std::string>{"room/kernel:new"}));
  EXPECT_EQ(comparison.differences.size(), 2u);
}

TEST(Comparison, FromNothingToSomethingIsWorse) {
  Results before = baseline();
  before.rows[0].seconds[0] = 0.0;
  const Comparison comparison = compare(before, baseline(), 0.1);
  EXPECT_EQ(verdict_on(comparison, "room/pass"), Verdict::worse);
  EXPECT_TRUE(std::isinf(comparison.differences[0].ratio));
}

TEST(Comparison, AnotherDeviceIsToldOf) {
  Results after = baseline();
  after.context["device"] = "B";
  after.context["date"] = "today";
  after.context["host_threads"] = "2";  // which the other does not tell
  const Comparison comparison = compare(baseline(), after, 0.1);
  ASSERT_EQ(comparison.different_context.size(), 1u);
  EXPECT_EQ(comparison.different_context[0], "device: was A, is B");
}

TEST(Comparison, TheTableNamesEveryFigureAndVerdict) {
  Results after = baseline();
  after.rows[0].seconds[0] = 0.2;
  const std::string table = comparison_table(compare(baseline(), after, 0.1));
  EXPECT_NE(table.find("room/pass "), std::string::npos) << table;
  EXPECT_NE(table.find("100.0 ms"), std::string::npos) << table;
  EXPECT_NE(table.find("200.0 ms"), std::string::npos) << table;
  EXPECT_NE(table.find("2.000 WORSE"), std::string::npos) << table;
  EXPECT_NE(table.find("room/kernel:gather"), std::string::npos) << table;
}

}  // namespace
}  // namespace ppm::bench
