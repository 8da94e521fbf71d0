// page.html, as it is built into the program (cmake/EmbedText.cmake).
#pragma once

#include <string_view>

namespace ppm::compare {

/// HTML with places like {{title}} that page_html fills.
extern const std::string_view kPageTemplate;

}  // namespace ppm::compare
