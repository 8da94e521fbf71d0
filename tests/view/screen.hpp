// A screen in memory, and somebody who sits before it.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ppm::test {

/// What a window shows: 3 bytes a pixel, row by row from the top.
struct Shot {
  unsigned width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// An Xvfb of its own and the one window on it. It ends with this object, and with the test.
class Screen {
 public:
  /// Throws std::runtime_error where there can be none.
  Screen();
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  std::string display() const;  ///< for DISPLAY
  /// Waits until a window is there, and puts the mouse on it; false when none comes.
  bool find_window();
  /// Waits until the window's title has this.
  bool wait_for_title(std::string_view part);
  std::string title();
  Shot shot();  ///< empty while the window is not shown

  void key(const char* keysym);  ///< of the unshifted key, as X names it
  void move(glm::ivec2 to);      ///< in the window
  void press(unsigned button);
  void release(unsigned button);
  void drag(unsigned button, glm::ivec2 from, glm::ivec2 to);
  void click(glm::ivec2 at);
  void resize(unsigned width, unsigned height);
  void close();  ///< as a window manager does

 private:
  struct Connection;
  void start_server();

  pid_t server_ = -1;
  int number_ = -1;
  std::unique_ptr<Connection> connection_;
};

void pause_a_little();  ///< 20 ms

/// Asks `is_so` until it says so, for two minutes at most.
template <class Condition>
bool eventually(Condition is_so) {
  constexpr int kTries = 6000;
  for (int i = 0; i < kTries; ++i) {
    if (is_so()) return true;
    pause_a_little();
  }
  return false;
}

}  // namespace ppm::test
