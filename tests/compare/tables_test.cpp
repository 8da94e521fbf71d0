// CSV files as programs read them.
#include "tables.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "page_text.hpp"

namespace ppm::compare {
namespace {

/// Lines and fields, by RFC 4180.
std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
  std::vector<std::vector<std::string>> lines(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      lines.back().back() += text[i++];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      lines.back().emplace_back();
    } else if (!quoted && c == '\r') {
      EXPECT_EQ(text[i + 1], '\n');
    } else if (!quoted && c == '\n') {
      lines.push_back({""});
    } else {
      lines.back().back() += c;
    }
  }
  lines.pop_back();
  return lines;
}

TEST(CompareTables, EveryLineHasAllFieldsAndNumbersReadBack) {
  MethodResult good, failed;
  good.label = "ppm:alpha=0.8,\"x\"";
  good.integrator = "ppm";
  SeedResult seed;
  seed.run = "ppm-0";
  seed.record.pictures = {{"1.exr", 0.1, 0.01, 1, 2, 3, 4, 5, 6},
                          {"2.exr", 1.0 / 3.0, 0.02, 7, 8, 9, 10, 11, 12}};
  seed.errors.resize(2);
  seed.errors[1].rmse = 0.1;
  good.seeds = {seed};
  good.rmse = 0.1;
  good.rmse_slope = -1.0 / 3.0;
  failed.label = "pt";
  failed.failure = "a, b\nc";
  const std::vector<MethodResult> results = {good, failed};
  EXPECT_EQ(rmse_of_ppm(results), 0.1);

  const auto table = parse_csv(table_csv(results, 0.05));
  ASSERT_EQ(table.size(), 3u);
  for (const auto& line : table) EXPECT_EQ(line.size(), table[0].size());
  EXPECT_EQ(table[1][0], good.label);
  EXPECT_EQ(table[1][2], "7");
  EXPECT_EQ(std::stod(table[1][8]), 1.0 / 3.0);
  EXPECT_EQ(std::stod(table[1][12]), 2.0);
  EXPECT_EQ(std::stod(table[1][13]), -1.0 / 3.0);
  EXPECT_EQ(table[2].back(), "a, b\nc");

  const auto errors = parse_csv(errors_csv(results));
  ASSERT_EQ(errors.size(), 3u);
  for (const auto& line : errors) EXPECT_EQ(line.size(), errors[0].size());
  EXPECT_EQ(errors[2][10], "0.1");
  EXPECT_EQ(errors[2].back(), "runs/ppm-0/2.exr");
}

TEST(CompareTables, FiguresHaveALineForEachPass) {
  Figures figures;
  figures.run = "figures-2";
  figures.probes = {{{3, 4}, {{1, {2.1, 0.5, {1.0, 2.0, 3.0}}}, {2, {4.2, 0.4, {1.5, 2.5, 3.5}}}}},
                    {{5, 6}, {}}};
  figures.record.pictures = {{"00000001.exr", 0.5, 0.1, 1, 0, 0, 100, 90, 0}};
  const auto lines = parse_csv(figure4_csv(figures));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[2], (std::vector<std::string>{"3", "4", "2", "4.2", "0.4", "1.5", "2.5", "3.5"}));
  EXPECT_EQ(parse_csv(figure5_csv(figures))[1],
            (std::vector<std::string>{"1", "100", "0.5", "runs/figures-2/00000001.exr"}));
}

TEST(CompareTables, FieldsAreQuotedWhereTheyMustBe) {
  EXPECT_EQ(csv_field("plain text"), "plain text");
  EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_field("a \"b\""), "\"a \"\"b\"\"\"");
}

}  // namespace
}  // namespace ppm::compare
