// --display: a viewer that shows the picture as it becomes.
#pragma once

#include <optional>
#include <string_view>

#include "declarer.hpp"
#include "options.hpp"

namespace ppm::cli {

/// "tev", "tev:HOST", "tev:PORT" or "tev:HOST:PORT", a host with colons in brackets.
std::optional<display::TevAddress> parse_display(std::string_view text);

void declare_display(Declarer& declare, RenderOptions& options);

}  // namespace ppm::cli
