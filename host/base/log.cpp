#include "log.hpp"

#include <algorithm>
#include <cstdio>

namespace ppm {

void Log::warn(const std::string& text) {
  if (std::find(warnings_.begin(), warnings_.end(), text) != warnings_.end()) return;
  warnings_.push_back(text);
  if (verbosity_ != Verbosity::quiet) std::fprintf(stderr, "ppm-vk: warning: %s\n", text.c_str());
}

void Log::tell(const std::string& text) const {
  if (verbosity_ != Verbosity::quiet) std::fprintf(stderr, "ppm-vk: %s\n", text.c_str());
}

void Log::note(const std::string& text) const {
  if (verbosity_ == Verbosity::verbose) std::fprintf(stderr, "ppm-vk: %s\n", text.c_str());
}

}  // namespace ppm
