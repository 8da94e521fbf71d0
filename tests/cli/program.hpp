// Runs the real ppm-vk and looks at it from outside.
#pragma once

#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ppm::test {

/// How the program ended and what it said.
struct Result {
  std::optional<int> exit_code;  ///< nothing where a signal ended it
  int signal = 0;
  std::string out, err;
};

/// A running ppm-vk. It is killed where it outlives its limit of two minutes or this object.
class Program {
 public:
  /// `in_child` runs in the new process before the program does.
  explicit Program(
      const std::vector<std::string>& arguments, const std::function<void()>& in_child = [] {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Waits until stderr has `text`; false when the program ends or the limit passes before.
  bool wait_for(std::string_view text);
  /// The next line of stdout, without its end; nothing when the program ends or the limit passes
  /// before there is one.
  std::optional<std::string> next_line();
  void send(int signal) const;
  pid_t id() const { return process_; }
  /// Waits for the end.
  Result finish();

 private:
  bool read_more();

  pid_t process_ = -1;
  int out_ = -1, err_ = -1;
  std::size_t lines_taken_ = 0;  // bytes of result_.out
  Result result_;
};

inline Result run(const std::vector<std::string>& arguments) {
  return Program(arguments).finish();
}

/// The program ended with this and one error, its last line, which has `named` in it.
void expect_one_error(const Result& result, int exit_code, const std::string& named);

}  // namespace ppm::test
