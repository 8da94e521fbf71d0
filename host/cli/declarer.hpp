// Options of a verb, declared so that all refusals read alike. For those who know CLI11.
#pragma once

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "glm/glm.hpp"

namespace CLI {
class App;
}

namespace ppm::cli {

/// Throws the CLI::ValidationError of a value that an option does not take, which says what it
/// would take.
[[noreturn]] void refuse(const char* option, const std::string& value, const std::string& wanted);

/// The help of `app` begins with `lines`.
void set_usage(CLI::App& app, std::string lines);

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

/// Declares options whose values are checked here.
class Declarer {
 public:
  explicit Declarer(CLI::App& app) : app_(app) {}

  void group(const char* name) { group_ = name; }

  void text(const char* name, const char* value_name, const std::string& help,
            std::function<void(const std::string&)> store);

  template <class T, class Target>
  void whole(const char* name, Target& target, T least, T most, const std::string& help) {
    text(name, "N", help, [=, &target](const std::string& value) {
      const std::optional<T> number = parse_number<T>(value);
      if (!number || *number < least || *number > most) {
        refuse(name, value, fmt::format("a whole number from {} to {}", least, most));
      }
      target = *number;
    });
  }

  template <class Target>
  void real(const char* name, const char* value_name, Target& target, const char* wanted,
            const std::string& help, std::function<bool(double)> allowed) {
    text(name, value_name, help, [=, &target](const std::string& value) {
      const std::optional<double> number = parse_finite(value);
      if (!number || !allowed(*number)) refuse(name, value, wanted);
      target = *number;
    });
  }

  void vector(const char* name, std::optional<glm::dvec3>& target, const std::string& help) {
    text(name, "X,Y,Z", help, [=, &target](const std::string& value) {
      target = parse_vector(value);
      if (!target) refuse(name, value, "three finite numbers X,Y,Z without spaces");
    });
  }

  void flag(const char* name, const std::string& help, std::function<void()> act);

 private:
  CLI::App& app_;
  std::string group_ = "Options";
};

}  // namespace ppm::cli
