#include "failure.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace ppm {
namespace {

std::string join(std::initializer_list<std::string_view> parts) {
  std::string line;
  for (std::string_view part : parts) {
    if (part.empty()) continue;
    if (!line.empty()) line += ": ";
    line += part;
  }
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return line;
}

}  // namespace

Failure::Failure(std::string_view file, std::string_view where, std::string_view what_is_wrong,
                 std::string_view remedy)
    : std::runtime_error(join({file, where, what_is_wrong, remedy})) {}

void assertion_failed(const char* condition, const std::string& message, const char* file,
                      int line) {
  std::fprintf(stderr, "ppm-vk: internal error: %s:%d: %s: %s\n", file, line, condition,
               message.c_str());
  std::abort();
}

}  // namespace ppm
