// Options of a verb, declared so that all refusals read alike. For those who know CLI11.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "glm/glm.hpp"

namespace ppm::cli {

/// A value that an option does not take; the message says what it would take.
CLI::ValidationError refusal(const char* option, const std::string& value,
                             const std::string& wanted);

template <class T>
std::optional<T> parse_number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> parse_finite(std::string_view text);
std::optional<glm::dvec3> parse_vector(std::string_view text);
/// "30", "30s", "1.5m", "2h" as seconds.
std::optional<double> parse_duration(std::string_view text);

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

struct HelpFormatter : CLI::Formatter {
  /// `usage` is the first line of the help, with its end.
  explicit HelpFormatter(std::string usage) : usage_(std::move(usage)) { column_width(36); }
  std::string make_usage(const CLI::App* /*app*/, std::string /*name*/) const override {
    return usage_;
  }

 private:
  std::string usage_;
};

/// Declares options whose values are checked here.
class Declarer {
 public:
  explicit Declarer(CLI::App& app) : app_(app) {}

  void group(const char* name) { group_ = name; }

  CLI::Option* text(const char* name, const char* value_name, const std::string& help,
                    std::function<void(const std::string&)> store) {
    return app_.add_option_function<std::string>(name, std::move(store), help)
        ->type_name(value_name)
        ->group(group_);
  }

  template <class T, class Target>
  void whole(const char* name, Target& target, T least, T most, const std::string& help) {
    text(name, "N", help, [=, &target](const std::string& value) {
      const std::optional<T> number = parse_number<T>(value);
      if (!number || *number < least || *number > most) {
        throw refusal(name, value, fmt::format("a whole number from {} to {}", least, most));
      }
      target = *number;
    });
  }

  template <class Target>
  void real(const char* name, const char* value_name, Target& target, const char* wanted,
            const std::string& help, std::function<bool(double)> allowed) {
    text(name, value_name, help, [=, &target](const std::string& value) {
      const std::optional<double> number = parse_finite(value);
      if (!number || !allowed(*number)) throw refusal(name, value, wanted);
      target = *number;
    });
  }

  void vector(const char* name, std::optional<glm::dvec3>& target, const std::string& help) {
    text(name, "X,Y,Z", help, [=, &target](const std::string& value) {
      target = parse_vector(value);
      if (!target) throw refusal(name, value, "three finite numbers X,Y,Z without spaces");
    });
  }

  void flag(const char* name, const std::string& help, std::function<void()> act) {
    app_.add_flag_callback(name, std::move(act), help)->group(group_)->disable_flag_override();
  }

 private:
  CLI::App& app_;
  std::string group_ = "Options";
};

}  // namespace ppm::cli
