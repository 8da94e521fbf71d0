// Text as HTML takes it, and numbers as people read them.
#pragma once

#include <string>
#include <string_view>

namespace ppm::compare {

/// Safe between tags and in quoted attributes, whatever `text` is.
std::string escape_html(std::string_view text);

std::string base64(std::string_view bytes);

/// A field of a CSV file (RFC 4180), in quotes where it needs them.
std::string csv_field(std::string_view text);

/// Three significant digits: "0.0123", "4.57", "1.2e-07".
std::string short_number(double value);
/// The shortest text that reads back as the same number: for CSV files.
std::string whole_number(double value);

}  // namespace ppm::compare
