#include "declarer.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <utility>

namespace ppm::cli {

namespace {

struct HelpFormatter : CLI::Formatter {
  explicit HelpFormatter(std::string usage) : usage_(std::move(usage)) { column_width(36); }
  std::string make_usage(const CLI::App* /*app*/, std::string /*name*/) const override {
    return usage_;
  }

 private:
  std::string usage_;
};

}  // namespace

void refuse(const char* option, const std::string& value, const std::string& wanted) {
  throw CLI::ValidationError(option, fmt::format("'{}' is not {}", value, wanted));
}

void set_usage(CLI::App& app, std::string lines) {
  app.formatter(std::make_shared<HelpFormatter>(std::move(lines)));
}

void Declarer::text(const char* name, const char* value_name, const std::string& help,
                    std::function<void(const std::string&)> store) {
  app_.add_option_function<std::string>(name, std::move(store), help)
      ->type_name(value_name)
      ->group(group_);
}

void Declarer::flag(const char* name, const std::string& help, std::function<void()> act) {
  app_.add_flag_callback(name, std::move(act), help)->group(group_)->disable_flag_override();
}

std::optional<double> parse_finite(std::string_view text) {
  const std::optional<double> value = parse_number<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<glm::dvec3> parse_vector(std::string_view text) {
  glm::dvec3 vector{};
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i == 2)) return std::nullopt;
    const std::optional<double> value = parse_finite(text.substr(0, comma));
    if (!value) return std::nullopt;
    vector[i] = *value;
    text.remove_prefix(i == 2 ? text.size() : comma + 1);
  }
  return vector;
}

std::optional<double> parse_duration(std::string_view text) {
  double unit = 1.0;
  if (text.ends_with('s') || text.ends_with('m') || text.ends_with('h')) {
    unit = text.back() == 's' ? 1.0 : text.back() == 'm' ? 60.0 : 3600.0;
    text.remove_suffix(1);
  }
  const std::optional<double> value = parse_finite(text);
  if (!value || *value <= 0.0 || *value * unit > 1e8) return std::nullopt;
  return *value * unit;
}

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  return a.lexically_normal() == b.lexically_normal() || std::filesystem::equivalent(a, b, ignored);
}

}  // namespace ppm::cli
