// The page: whole, self-contained, and safe whatever names are in it.
#include "page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "false_colour.hpp"
#include "page_text.hpp"

namespace ppm::compare {
namespace {

constexpr const char* kHostile = "<script>alert(\"1\")</script>&'{{title}}";

PageContent some_content() {
  PageContent content;
  content.title = "lamp.glb";
  content.summary = {"What was done."};
  content.failures = {"mlt failed: no light"};
  content.width = 32;
  content.height = 24;
  content.columns = {
      {"ppm", {{"png one", "1 s"}, {"png two", "2 s"}}, {{"e one", "1 s"}, {"e two", "2 s"}}},
      {"reference", {{"png three", "by pt"}}, {}}};
  content.crops = {{4, 8, 16, 8}};
  content.curves = {{"RMSE",
                     "s",
                     "RMSE",
                     true,
                     true,
                     {{"ppm", "(slope -0.33)", 0, false, {{1.0, 0.1}, {2.0, 0.05}}}},
                     {}}};
  content.table_heading = {"", "Samples"};
  content.table = {{"ppm", "1650"}};
  content.figure4 = content.curves;
  content.figure5 = {{"png five", "16 passes"}};
  content.facts = {{"device", "llvmpipe"}};
  content.parameters = {{"ppm", {{"alpha", "0.7"}}}};
  content.files = {{"table.csv", "effort"}};
  return content;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(ComparePage, HoldsAllThatItIsGiven) {
  const std::string html = page_html(some_content());
  for (const char* part :
       {"<!DOCTYPE html>", "What was done.", "mlt failed: no light", "slope -0.33", "1650",
        "llvmpipe", "Parameters of ppm", "table.csv", "16 passes", "</html>", "16 &times; 8"}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
  // Each picture once, however often it is shown.
  for (const char* picture : {"png one", "png two", "e one", "e two", "png three", "png five"}) {
    EXPECT_EQ(count_of(html, "base64," + base64(picture) + ")"), 1u) << picture;
  }
  EXPECT_EQ(html.find("{{"), std::string::npos);
  // Tags that are opened are closed.
  for (const char* tag : {"div", "figure", "table", "tr", "td", "th", "dl", "dt", "dd", "svg",
                          "details", "style", "script", "span", "p", "h2", "figcaption"}) {
    const std::string open = std::string("<") + tag;
    EXPECT_EQ(count_of(html, open + ">") + count_of(html, open + " "),
              count_of(html, std::string("</") + tag + ">"))
        << tag;
  }
}

TEST(ComparePage, NeedsNoNetworkAndNoOtherFile) {
  const std::string html = page_html(some_content());
  for (const char* word : {"http:", "https:", "src=", "@import", "<link", "//cdn", "fetch("}) {
    EXPECT_EQ(html.find(word), std::string::npos) << word;
  }
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(count_of(html, "url("), count_of(html, "url(data:image/png;base64,"));
}

TEST(ComparePage, NamesAreText) {
  const std::size_t scripts = count_of(page_html(some_content()), "<script");
  PageContent content = some_content();
  content.title = kHostile;
  content.summary = {kHostile};
  content.failures = {kHostile};
  for (PageColumn& column : content.columns) {
    column.title = kHostile;
    for (PagePicture& picture : column.pictures) picture.caption = kHostile;
    for (PagePicture& picture : column.errors) picture.caption = kHostile;
  }
  for (Plot& plot : content.curves) {
    plot.title = plot.x_label = plot.y_label = kHostile;
    for (Curve& curve : plot.curves) curve.name = curve.note = kHostile;
    plot.levels = {{kHostile, 0.07}};
  }
  content.table_heading = content.table[0] = content.table_notes = {kHostile};
  content.figure5[0].caption = kHostile;
  content.facts = {{kHostile, kHostile}};
  content.parameters = {{kHostile, content.facts}};
  content.files = {{kHostile, kHostile}};
  const std::string html = page_html(content);
  EXPECT_EQ(count_of(html, "<script"), scripts);
  EXPECT_EQ(html.find("alert(\""), std::string::npos);
  EXPECT_NE(html.find("&lt;script&gt;alert(&quot;1&quot;)"), std::string::npos);
  EXPECT_NE(html.find("{{title}}"), std::string::npos);  // not filled a second time
}

TEST(ComparePage, AComparisonInWhichAllFailedIsAPageToo) {
  PageContent content;
  content.width = content.height = 1;
  EXPECT_NE(page_html(content).find("</html>"), std::string::npos);
}

TEST(ComparePage, Base64) {
  // RFC 4648, section 10.
  const std::pair<const char*, const char*> kVectors[] = {{"", ""},
                                                          {"f", "Zg=="},
                                                          {"fo", "Zm8="},
                                                          {"foo", "Zm9v"},
                                                          {"foob", "Zm9vYg=="},
                                                          {"fooba", "Zm9vYmE="},
                                                          {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : kVectors) EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(ComparePage, FalseColoursGrowBrighterWithTheError) {
  double last = -1.0;
  for (double error = 0.5 * kLeastError; error < 2.0 * kMostError; error *= 1.3) {
    const Srgb colour = error_colour(error);
    const double brightness = 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2];
    EXPECT_GE(brightness, last) << error;
    last = brightness;
  }
  EXPECT_EQ(error_colour(0.0), error_colour(kLeastError));
  EXPECT_EQ(error_colour(INFINITY), error_colour(kMostError));
  EXPECT_EQ(error_colour(NAN), (Srgb{128, 128, 128}));
}

/// Numbers between quotes after `name`.
std::vector<double> numbers_of(const std::string& svg, const std::string& name) {
  std::vector<double> numbers;
  for (std::size_t at = svg.find(name + "=\""); at != std::string::npos;
       at = svg.find(name + "=\"", at + 1)) {
    numbers.push_back(std::stod(svg.substr(at + name.size() + 2)));
  }
  return numbers;
}

TEST(ComparePage, PowerLawsAreStraightOnLogarithmicAxes) {
  Plot plot;
  plot.curves = {{"a", "", 0, false, {}}};
  for (double x = 1.0; x <= 64.0; x *= 2.0) plot.curves[0].points.push_back({x, 1.0 / x});
  plot.curves[0].points.push_back({0.0, 1.0});
  plot.curves[0].points.push_back({3.0, NAN});
  const std::string svg = svg_plot(plot);
  const std::vector<double> x = numbers_of(svg, "cx"), y = numbers_of(svg, "cy");
  ASSERT_EQ(x.size(), 7u);
  for (std::size_t i = 1; i < x.size(); ++i) {
    EXPECT_NEAR(x[i] - x[i - 1], x[1] - x[0], 0.11);
    EXPECT_NEAR(y[i] - y[i - 1], y[1] - y[0], 0.11);
    EXPECT_GT(y[i], y[i - 1]);  // down the screen
  }
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(ComparePage, PlotsOfNothingAndOfOnePointAreDrawn) {
  for (const bool logarithmic : {false, true}) {
    for (const std::vector<Sample>& points :
         {std::vector<Sample>{}, {{2.0, 0.0}}, {{2.0, 3.0}}, {{1.0, 5.0}, {2.0, 5.0}}}) {
      Plot plot{"t", "x", "y", logarithmic, logarithmic, {{"a", "", 0, false, points}}, {}};
      const std::string svg = svg_plot(plot);
      EXPECT_EQ(svg.find("nan"), std::string::npos) << svg;
      EXPECT_EQ(svg.find("inf"), std::string::npos) << svg;
      EXPECT_LT(svg.size(), 20000u);
    }
  }
}

}  // namespace
}  // namespace ppm::compare
