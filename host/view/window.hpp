// A window that shows 8-bit pictures and tells of keys and mouse. All of one thread, the program's
// first; wake alone may be called from any.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "controls.hpp"
#include "glm/glm.hpp"

namespace ppm::view {

/// The connection to where windows are shown. One at a time.
class Desktop {
 public:
  /// Throws Failure where there is none, or where the program was built without windows.
  Desktop();
  ~Desktop();
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  /// Makes Window::wait return.
  static void wake();
};

/// What people do to it. Points are in pixels of the frame, from its top left.
struct KeyPress {
  std::string key;  ///< as Key::name; a key that is held comes again and again
};
struct ButtonPress {
  Button button;
  glm::dvec2 at;
  bool shift;
};
struct ButtonRelease {
  glm::dvec2 at;
};
struct MouseMove {
  glm::dvec2 to;
};
struct Scroll {
  double up;  ///< notches
};
using Event = std::variant<KeyPress, ButtonPress, ButtonRelease, MouseMove, Scroll>;

class Window {
 public:
  /// Of this many pixels, or fewer where the screen has not as many; the picture's shape stays.
  /// Throws Failure where none can be opened.
  Window(const Desktop& desktop, const std::string& title, glm::uvec2 size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Events since the last call, once there are any or `seconds` have passed.
  std::vector<Event> wait(double seconds);
  bool closing() const;
  bool stale() const;        ///< resized or uncovered since the last `show`
  glm::uvec2 frame() const;  ///< pixels that it has; 0 while it is an icon
  /// Of as many pixels as `frame` says, 3 bytes each, row by row from the bottom.
  void show(std::span<const std::uint8_t> rgb, glm::uvec2 frame);
  void set_title(const std::string& title);

  struct Implementation;

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace ppm::view
