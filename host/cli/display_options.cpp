#include "display_options.hpp"

namespace ppm::cli {

std::optional<display::TevAddress> parse_display(std::string_view text) {
  display::TevAddress address;
  if (text == "tev") return address;
  if (!text.starts_with("tev:")) return std::nullopt;
  text.remove_prefix(4);
  std::string_view host = text, port;
  const std::size_t colon = text.rfind(':');
  const bool has_port = colon != std::string_view::npos && !text.ends_with(']');
  if (has_port) {
    host = text.substr(0, colon);
    port = text.substr(colon + 1);
  } else if (parse_number<std::uint32_t>(text)) {
    host = address.host;
    port = text;
  }
  if (has_port || !port.empty()) {
    const auto number = parse_number<std::uint16_t>(port);
    if (!number || *number == 0) return std::nullopt;
    address.port = *number;
  }
  const bool bracketed = host.starts_with('[') && host.ends_with(']');
  if (bracketed) host = host.substr(1, host.size() - 2);
  if (host.empty() || (!bracketed && host.find(':') != std::string_view::npos)) return std::nullopt;
  address.host = host;
  return address;
}

void declare_display(Declarer& declare, RenderOptions& options) {
  declare.text("--display", "tev[:HOST:PORT]",
               "show the picture as it becomes in the tev viewer (127.0.0.1:14158)",
               [&](const std::string& value) {
                 options.display = parse_display(value);
                 if (!options.display) {
                   refuse("--display", value, "tev, tev:PORT or tev:HOST:PORT");
                 }
               });
}

}  // namespace ppm::cli
