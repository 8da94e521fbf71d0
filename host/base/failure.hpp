// How the program fails: one exception for what users can mend, one macro for what only programmers
// can.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace ppm {

/// A scene, file or device that cannot serve. Caught once, in main, which prints
/// `ppm-vk: error: FILE: where: what is wrong: what would mend it` and exits with 1.
/// Empty parts are left out. Line breaks inside a part are printed as spaces.
class Failure : public std::runtime_error {
 public:
  Failure(std::string_view file, std::string_view where, std::string_view what_is_wrong,
          std::string_view remedy);
};

/// Prints both the condition and the message, then aborts. For programmers' mistakes only.
[[noreturn]] void assertion_failed(const char* condition, const std::string& message,
                                   const char* file, int line);

}  // namespace ppm

/// A condition that only a programming error can break; `message` shows the values involved.
#define PPM_ASSERT(condition, message)                                                  \
  do {                                                                                  \
    if (!(condition)) ::ppm::assertion_failed(#condition, message, __FILE__, __LINE__); \
  } while (false)
