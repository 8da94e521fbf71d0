// Lines for people on stderr: warnings once each, notes when asked for.
#pragma once

#include <string>
#include <vector>

namespace ppm {

enum class Verbosity { quiet, normal, verbose };

/// Collects and prints messages. Warnings are printed (and kept) once per distinct text.
/// `quiet` prints only errors; the list of warnings is kept all the same.
class Log {
 public:
  explicit Log(Verbosity verbosity = Verbosity::normal) : verbosity_(verbosity) {}

  /// `ppm-vk: warning: TEXT`, the first time this text is seen.
  void warn(const std::string& text);
  /// `ppm-vk: TEXT`, unless quiet: what people want to know, though nothing is wrong.
  void tell(const std::string& text) const;
  /// `ppm-vk: TEXT`, in verbose mode only.
  void note(const std::string& text) const;

  Verbosity verbosity() const { return verbosity_; }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  Verbosity verbosity_;
  std::vector<std::string> warnings_;
};

}  // namespace ppm
