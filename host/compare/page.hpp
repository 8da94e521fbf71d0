// The page of a comparison: one file that needs no other and no network.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "plan.hpp"
#include "svg_plot.hpp"

namespace ppm::compare {

/// A picture as the page shows it.
struct PagePicture {
  std::string png;      ///< a whole file
  std::string caption;  ///< "7.5 s, 12 passes"
};

/// What a method has to show: a column.
struct PageColumn {
  std::string title;
  std::vector<PagePicture> pictures;  ///< in the order of time, the last is the result
  std::vector<PagePicture> errors;    ///< as many, or none
};

using Facts = std::vector<std::pair<std::string, std::string>>;

/// Plain text throughout; the page sees to escaping.
struct PageContent {
  std::string title;
  std::vector<std::string> summary;  ///< paragraphs
  std::vector<std::string> failures;
  std::uint32_t width = 0, height = 0;  ///< of the pictures
  std::vector<PageColumn> columns;
  std::vector<Crop> crops;
  std::vector<Plot> curves;
  std::vector<std::string> table_heading;
  std::vector<std::vector<std::string>> table;
  std::vector<std::string> table_notes;
  std::vector<Plot> figure4;
  std::vector<PagePicture> figure5;
  Facts facts;                                             ///< machine, device, scene ...
  std::vector<std::pair<std::string, Facts>> parameters;   ///< by method
  std::vector<std::pair<std::string, std::string>> files;  ///< relative link, what it is
};

std::string page_html(const PageContent& content);

}  // namespace ppm::compare
